// Stand-in: a light.
#pragma once

#include "common/Scene/Geometry/Ray/Ray.h"
#include "common/Scene/SceneObject.h"

class Light : public SceneObject {
public:
    Light() : lightColor(0.f) {}

    virtual void ComputeSampleRays(std::vector<Ray>& output, glm::vec3 origin,
                                   glm::vec3 normal) const = 0;
    virtual float ComputeLightAttenuation(glm::vec3 origin) const = 0;
    virtual void GenerateRandomPhotonRay(Ray& ray) const = 0;

    glm::vec3 GetLightColor() const { return lightColor; }
    void SetLightColor(glm::vec3 color) { lightColor = color; }

protected:
    glm::vec3 lightColor;
};
