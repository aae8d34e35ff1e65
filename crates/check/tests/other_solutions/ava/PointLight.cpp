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
    // keep drawing points in the cube until one is inside the ball
    glm::vec3 p(0.f);
    float len2;
    for (;;) {
        for (int axis = 0; axis < 3; axis++)
            p[axis] = -1.f + static_cast<float>(rand()) / (static_cast<float>(RAND_MAX) / 2.f);
        len2 = glm::dot(p, p);
        if (len2 <= 1.f && len2 > 0.f) break;
    }
    ray.SetRayPosition(glm::vec3(GetPosition().x, GetPosition().y, GetPosition().z));
    ray.SetRayDirection(p / sqrtf(len2));
}
