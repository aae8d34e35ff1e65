#include "common/Scene/Lights/Point/PointLight.h"

void PointLight::ComputeSampleRays(std::vector<Ray>& output, glm::vec3 origin, glm::vec3 normal) const
{
    origin += LARGE_EPSILON * normal;
    const glm::vec3 me = glm::vec3(GetPosition());
    output.emplace_back(origin, me - origin, glm::length(me - origin));
}

float PointLight::ComputeLightAttenuation(glm::vec3 origin) const
{
    return 1.f;
}

void PointLight::GenerateRandomPhotonRay(Ray& ray) const
{
    float x, y, z, sum;
    do {
        x = 2.f * ((float)rand() / RAND_MAX) - 1.f;
        y = 2.f * ((float)rand() / RAND_MAX) - 1.f;
        z = 2.f * ((float)rand() / RAND_MAX) - 1.f;
        sum = x * x + y * y + z * z;
    } while (sum > 1.f || sum == 0.f);
    ray.SetRayPosition(glm::vec3(GetPosition()));
    ray.SetRayDirection(glm::normalize(glm::vec3(x, y, z)));
}
