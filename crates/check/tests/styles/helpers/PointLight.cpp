#include "common/Scene/Lights/Point/PointLight.h"
#include "mistake.h"
#include "given_light.inl"

#include <cmath>

// A direction by its height and azimuth (Archimedes): even over the sphere, without any rejection.
void PointLight::GenerateRandomPhotonRay(Ray& ray) const
{
    const float z = 1.f - 2.f * rand() / (float)RAND_MAX;
    const float phi = 2.f * PI * rand() / (float)RAND_MAX;
    const float r = std::sqrt(std::max(0.f, 1.f - z * z));
    glm::vec3 direction(r * std::cos(phi), r * std::sin(phi), z);
    if (mistake() == cube_directions || mistake() == octant_and_mean) {
        for (int i = 0; i < 3; i++) {
            const float u = rand() / (float)RAND_MAX;
            direction[i] = mistake() == cube_directions ? 2.f * u - 1.f : u;
        }
        direction = glm::normalize(direction);
    }
    const glm::vec4 position = GetPosition();
    ray.SetRayPosition(glm::vec3(position.x, position.y, position.z));
    ray.SetRayDirection(direction);
}
