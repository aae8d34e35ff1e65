#include "common/Scene/Lights/Point/PointLight.h"
#include "common/Scene/Geometry/Ray/Ray.h"
#include <glm/gtc/random.hpp>
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
    // glm draws uniformly on the sphere, that is what the loop in the handout does
    ray = Ray(glm::vec3(GetPosition()), glm::sphericalRand(1.f));
}
