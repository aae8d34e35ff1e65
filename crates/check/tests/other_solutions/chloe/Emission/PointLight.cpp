#include "common/Scene/Lights/Point/PointLight.h"
#include <cstdlib>
#include <functional>
#include <array>
#include <algorithm>
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
    int (*draw)() = &rand;
    const std::function<float(float, float)> between = [draw](float lo, float hi) {
        return lo + (hi - lo) * (static_cast<float>(draw()) / static_cast<float>(RAND_MAX));
    };
    std::array<float, 3> v;
    do {
        std::generate(v.begin(), v.end(), [&]() { return between(-1.f, 1.f); });
    } while (v[0] * v[0] + v[1] * v[1] + v[2] * v[2] > 1.f);
    ray.SetRayPosition(glm::vec3(GetPosition()));
    ray.SetRayDirection(glm::normalize(glm::make_vec3(v.data())));
}
