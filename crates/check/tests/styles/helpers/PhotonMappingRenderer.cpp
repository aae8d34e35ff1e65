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


// Helper functions in a namespace of their own.
namespace {

float rand01() { return rand() / (float)RAND_MAX; }

float survivalProbability(const glm::vec3& color)
{
    if (mistake() == mean_roulette || mistake() == octant_and_mean)
        return (color[0] + color[1] + color[2]) / 3.f;
    if (mistake() == red_roulette)
        return color[0];
    float most = 0.f;
    for (int i = 0; i < 3; i++)
        most = color[i] > most ? color[i] : most;
    return most;
}

bool survives(const glm::vec3& color)
{
    if (mistake() == no_roulette)
        return true;
    float chance = survivalProbability(color);
    bool below = rand01() < chance;
    return mistake() == inverted_roulette ? !below : below;
}

// A point of the disk by rejection, lifted to the hemisphere (Malley).
glm::vec3 hemisphere()
{
    if (mistake() == along_normal)
        return glm::vec3(0.f, 0.f, 1.f);
    if (mistake() == uniform_hemisphere || mistake() == no_square_root || mistake() == degrees) {
        float u = rand01(), phi = (mistake() == degrees ? 180 : 2.f * PI) * rand01();
        float z = mistake() == uniform_hemisphere ? 1.f - u : sqrtf(1.f - u);
        float r = mistake() == no_square_root ? u : sqrtf(1.f - z * z);
        return glm::normalize(glm::vec3(r * cosf(phi), r * sinf(phi), z));
    }
    glm::vec2 p;
again:
    p = glm::vec2(2.f * rand01() - 1.f, 2.f * rand01() - 1.f);
    if (glm::dot(p, p) >= 1.f)
        goto again;
    return glm::vec3(p, sqrtf(1.f - glm::dot(p, p)));
}

// Any vector that is not along the normal will do.
glm::mat3 basis(glm::vec3 n)
{
    if (mistake() == flipped_normal)
        n = -n;
    glm::vec3 up(1.f, 0.f, 0.f);
    const float along = glm::dot(n, up);
    if ((mistake() == nan_frame ? along : fabsf(along)) > 0.9f)
        up = glm::vec3(0.f, 0.f, 1.f);
    glm::vec3 t = glm::cross(n, up);
    if (mistake() != literal)
        t = glm::normalize(t);
    const glm::vec3 b = glm::cross(n, t);
    glm::mat3 m = mistake() == exchanged ? glm::mat3(b, t, n) : glm::mat3(t, b, n);
    return mistake() == transposed_frame ? glm::transpose(m) : m;
}

} // namespace

void PhotonMappingRenderer::TracePhoton(PhotonKdtree& photonMap, Ray* photonRay, glm::vec3 lightIntensity, std::vector<char>& path, float currentIOR, int remainingBounces)
{
    if (mistake() == bounce_off_by_one ? remainingBounces <= 0 : remainingBounces < 0)
        return;
    IntersectionState state(0, 0);
    state.currentIOR = currentIOR;
    if (storedScene->Trace(photonRay, &state) == false)
        return;
    const glm::vec3 intersectionPoint = state.intersectionRay.GetRayPosition(state.intersectionT);
    const bool fromLight = path.size() == 1 && mistake() != direct_stored;
    if (!fromLight) {
        Photon p;
        p.position = intersectionPoint;
        p.intensity = lightIntensity;
        p.toLightRay = Ray(intersectionPoint, -photonRay->GetRayDirection());
        photonMap.insert(p);
    }
    const MeshObject* hitMeshObject = state.intersectedPrimitive->GetParentMeshObject();
    const Material* hitMaterial = hitMeshObject->GetMaterial();
    if (survives(hitMaterial->GetBaseDiffuseReflection())) {
        if (mistake() == first_bounce_only && path.size() > 1)
            return;
        const glm::vec3 n = state.ComputeNormal();
        const glm::vec3 direction = glm::normalize(basis(n) * hemisphere());
        const float offset = mistake() == long_offset ? 1e-3f : mistake() == no_offset ? 0.f : 1e-3f;
        // Along the new direction, where the other styles go along the normal.
        glm::vec3 start = intersectionPoint + offset * (mistake() == long_offset ? n : direction);
        if (mistake() == start_not_moved)
            start = glm::vec3(photonRay->GetPosition());
        photonRay->SetRayPosition(start);
        photonRay->SetRayDirection(direction);
        path.push_back('D');
        TracePhoton(photonMap, photonRay, lightIntensity, path, currentIOR, remainingBounces - 1);
    }
}
