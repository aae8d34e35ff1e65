#include "common/Scene/Lights/Point/PointLight.h"
#include "mistake.h"
#include "given_light.inl"

#include <random>

void PointLight::GenerateRandomPhotonRay(Ray& ray) const
{
    static std::default_random_engine engine{std::random_device{}()};
    static std::uniform_real_distribution<double> pick(-1.0, 1.0);
    ray.SetRayPosition(glm::vec3(GetPosition()));
    if (mistake() == cube_directions || mistake() == octant_and_mean) {
        glm::vec3 v(pick(engine), pick(engine), pick(engine));
        ray.SetRayDirection(glm::normalize(mistake() == cube_directions ? v : glm::abs(v)));
        return;
    }
    // Marsaglia's way to a point of the sphere.
    double a, b, s;
    do {
        a = pick(engine);
        b = pick(engine);
        s = a * a + b * b;
    } while (s >= 1.0);
    const double root = 2.0 * std::sqrt(1.0 - s);
    ray.SetRayDirection(glm::vec3(a * root, b * root, 1.0 - 2.0 * s));
}
