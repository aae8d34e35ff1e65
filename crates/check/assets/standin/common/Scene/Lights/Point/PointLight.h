// Stand-in for the header beside PointLight.cpp, for those who hand in the .cpp alone.
#pragma once

#include "common/Scene/Lights/Light.h"

class PointLight : public Light {
public:
    void ComputeSampleRays(std::vector<Ray>& output, glm::vec3 origin,
                           glm::vec3 normal) const override;
    float ComputeLightAttenuation(glm::vec3 origin) const override;
    void GenerateRandomPhotonRay(Ray& ray) const override;
};
