#include "common/Scene/Lights/Point/PointLight.h"
void PointLight::ComputeSampleRays(std::vector<Ray>& output, glm::vec3 origin, glm::vec3 normal) const
{
    origin += normal * LARGE_EPSILON;
    const glm::vec3 lightPosition = glm::vec3(GetPosition());
    const glm::vec3 rayDirection = glm::normalize(lightPosition - origin);
    output.emplace_back(origin, rayDirection, glm::distance(origin, lightPosition));
}

float PointLight::ComputeLightAttenuation(glm::vec3 origin) const
{
    return 1.f;
}

void PointLight::GenerateRandomPhotonRay(Ray& ray) const
{
    auto r = []() { return (static_cast<float>(rand()) / RAND_MAX) * 2 - 1; };
    glm::vec3 dir = glm::vec3(r(), r(), r());
    while (glm::length(dir) > 1) dir = glm::vec3(r(), r(), r());
    ray.SetRayPosition(glm::vec3(GetPosition()));
    ray.SetRayDirection(glm::normalize(dir));
}
