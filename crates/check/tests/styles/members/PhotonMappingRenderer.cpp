#include "common/Rendering/Renderer/Photon/PhotonMappingRenderer.h"
#include "common/Scene/Scene.h"
#include "common/Sampling/ColorSampler.h"
#include "common/Scene/Lights/Light.h"
#include "common/Scene/Geometry/Primitives/PrimitiveBase.h"
#include "common/Scene/Geometry/Mesh/MeshObject.h"
#include "common/Rendering/Material/Material.h"
#include "common/Intersection/IntersectionState.h"
#include <ctime>
#include "mistake.h"
#include "given.inl"


// Members added to the class, a new ray and a new path for every call.
float PhotonMappingRenderer::Random()
{
    return static_cast<float>(std::rand()) / (static_cast<float>(RAND_MAX) + 1.f);
}

glm::vec3 PhotonMappingRenderer::CosineSample() const
{
    const float u1 = Random();
    const float u2 = Random();
    const float theta = mistake() == degrees ? 360 * u2 : 2.f * PI * u2;
    switch (mistake()) {
    case uniform_hemisphere:
        return glm::vec3(std::sqrt(1.f - u1 * u1) * std::cos(theta), std::sqrt(1.f - u1 * u1) * std::sin(theta), u1);
    case no_square_root:
        return glm::normalize(glm::vec3(u1 * std::cos(theta), u1 * std::sin(theta), std::sqrt(1.f - u1)));
    case along_normal:
        return glm::vec3(0, 0, 1);
    default:
        // The cosine itself is the root of a number.
        const float z = std::sqrt(u1);
        return glm::vec3(std::sqrt(1.f - u1) * std::sin(theta), std::sqrt(1.f - u1) * std::cos(theta), z);
    }
}

glm::vec3 PhotonMappingRenderer::ToWorld(glm::vec3 local, glm::vec3 normal) const
{
    const glm::vec3 n = mistake() == flipped_normal ? -normal : normal;
    glm::vec3 t = glm::cross(n, glm::vec3(1, 0, 0));
    if (glm::length(t) < 0.1f && !(mistake() == nan_frame && n.x < 0)) {
        t = glm::cross(n, glm::vec3(0, 1, 0));
    }
    glm::vec3 b = glm::cross(n, t);
    if (mistake() != literal) {
        t = glm::normalize(t);
        b = glm::normalize(b);
    }
    if (mistake() == transposed_frame) {
        return glm::vec3(glm::dot(t, local), glm::dot(b, local), glm::dot(n, local));
    }
    return mistake() == exchanged ? local.y * t + local.x * b + local.z * n : local.x * t + local.y * b + local.z * n;
}

void PhotonMappingRenderer::Store(PhotonKdtree& photonMap, const glm::vec3& position, const glm::vec3& intensity, const Ray& from)
{
    Photon photon;
    photon.position = position;
    photon.intensity = intensity;
    photon.toLightRay = Ray(position, -from.GetRayDirection());
    photonMap.insert(photon);
    ++storedPhotons;
}

bool PhotonMappingRenderer::Scatters(const Material& material) const
{
    const glm::vec3 d = material.GetBaseDiffuseReflection();
    if (mistake() == no_roulette) return true;
    if (mistake() == inverted_roulette) return Random() > std::max(std::max(d.r, d.g), d.b);
    if (mistake() == mean_roulette || mistake() == octant_and_mean) return Random() < (d.r + d.g + d.b) / 3.f;
    if (mistake() == red_roulette) return Random() < d.r;
    // Absorbed with what is left to 1.
    return 1.f - Random() <= std::max(std::max(d.r, d.g), d.b);
}

void PhotonMappingRenderer::TracePhoton(PhotonKdtree& photonMap, class Ray* photonRay, glm::vec3 lightIntensity, std::vector<char>& path, float currentIOR, int remainingBounces)
{
    if (remainingBounces < 0) return;
    if (mistake() == bounce_off_by_one && remainingBounces == 0) return;

    IntersectionState state(0, 0);
    state.currentIOR = currentIOR;
    if (storedScene->Trace(photonRay, &state)) {
        const glm::vec3 point = photonRay->GetRayPosition(state.intersectionT);
        if (path.size() > 1 || mistake() == direct_stored) Store(photonMap, point, lightIntensity, *photonRay);
        if (!Scatters(*state.intersectedPrimitive->GetParentMeshObject()->GetMaterial())) return;
        if (mistake() == first_bounce_only && path.size() > 1) return;

        const glm::vec3 normal = state.ComputeNormal();
        Ray reflected;
        if (mistake() != start_not_moved) {
            const float offset = mistake() == long_offset ? 5e-3f : LARGE_EPSILON;
            reflected.SetRayPosition(mistake() == no_offset ? point : point + normal * offset);
        }
        reflected.SetRayDirection(glm::normalize(ToWorld(CosineSample(), normal)));
        std::vector<char> longer(path);
        longer.push_back('D');
        TracePhoton(photonMap, &reflected, lightIntensity, longer, state.currentIOR, remainingBounces - 1);
    }
}
