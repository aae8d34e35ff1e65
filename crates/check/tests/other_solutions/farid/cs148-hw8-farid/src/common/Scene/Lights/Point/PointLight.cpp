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
    float x, y, z;
    do {
        x = 2.f * ((float)rand() / (float)RAND_MAX) - 1.f;
        y = 2.f * ((float)rand() / (float)RAND_MAX) - 1.f;
        z = 2.f * ((float)rand() / (float)RAND_MAX) - 1.f;
    } while (x * x + y * y + z * z > 1.f);
    ray.SetRayPosition(glm::vec3(GetPosition()));
    ray.SetRayDirection(glm::normalize(glm::vec3(x, y, z)));
}
