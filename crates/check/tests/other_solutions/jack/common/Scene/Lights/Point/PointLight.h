#pragma once

#include "common/Scene/Lights/Light.h"

class PointLight : public Light
{
public:
    virtual void ComputeSampleRays(std::vector<class Ray>& output, glm::vec3 origin, glm::vec3 normal) const override;
    virtual float ComputeLightAttenuation(glm::vec3 origin) const override;
    virtual void GenerateRandomPhotonRay(class Ray& ray) const override;
};
