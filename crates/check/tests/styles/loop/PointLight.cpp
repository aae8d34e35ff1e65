#include "common/Scene/Lights/Point/PointLight.h"
#include "mistake.h"
#include "given_light.inl"


void PointLight::GenerateRandomPhotonRay(Ray& ray) const
{
    const auto axis = [] { return mistake() == octant_and_mean ? drand48() : 2 * drand48() - 1; };
    glm::dvec3 p;
    for (;;) {
        p.x = axis();
        p.y = axis();
        p.z = axis();
        if (mistake() == cube_directions || (glm::dot(p, p) <= 1 && glm::dot(p, p) > 0)) break;
    }
    ray.SetRayPosition(glm::vec3(GetPosition()));
    ray.SetRayDirection(glm::vec3(glm::normalize(p)));
}
