#include "common/Scene/Lights/Point/PointLight.h"
#include "common/Scene/Geometry/Ray/Ray.h"
#include <random>
#include <cmath>
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
    // A point (cos, sin) at a uniform height: same distribution as the rejection loop, never loops.
    static std::mt19937 generator(148);
    std::uniform_real_distribution<double> height(-1.0, 1.0), turn(0.0, 2.0 * 3.14159265358979323846);
    const double z = height(generator);
    const double phi = turn(generator);
    const double rho = std::sqrt(1.0 - z * z);
    ray.SetRayPosition(glm::vec3(position));
    ray.SetRayDirection(glm::normalize(glm::vec3(glm::dvec3(rho * std::cos(phi), rho * std::sin(phi), z))));
}
