#include "common/Scene/Lights/Point/PointLight.h"
#include "mistake.h"
#include "given_light.inl"

#include <glm/gtc/random.hpp>

void PointLight::GenerateRandomPhotonRay(Ray& ray) const
{
    ray.SetRayPosition(glm::vec3(GetPosition()));
    if (mistake() == cube_directions || mistake() == octant_and_mean) {
        const float low = mistake() == cube_directions ? -1.f : 0.f;
        const float x = glm::linearRand(low, 1.f), y = glm::linearRand(low, 1.f), z = glm::linearRand(low, 1.f);
        ray.SetRayDirection(glm::normalize(glm::vec3(x, y, z)));
        return;
    }
    ray.SetRayDirection(glm::sphericalRand(1.f));
}
