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

#include <random>

// <random>, with one engine for the whole run.
static std::mt19937 engine(148);
static std::uniform_real_distribution<float> uniform(0.f, 1.f);

void PhotonMappingRenderer::TracePhoton(PhotonKdtree& photonMap, Ray* photonRay, glm::vec3 lightIntensity, std::vector<char>& path, float currentIOR, int remainingBounces)
{
    const bool isOver = mistake() == bounce_off_by_one ? !(remainingBounces > 0) : !(remainingBounces >= 0);
    if (isOver) return;
    IntersectionState state(0, 0);
    state.currentIOR = currentIOR;
    const bool hit = storedScene->Trace(photonRay, &state);
    if (!hit) return;
    const glm::vec3 x = state.intersectionRay.GetRayPosition(state.intersectionT);
    if (path.size() > static_cast<size_t>(mistake() == direct_stored ? 0 : 1)) {
        photonMap.insert(Photon{x, lightIntensity, Ray(x, -photonRay->GetRayDirection())});
    }
    const glm::vec3 d = state.intersectedPrimitive->GetParentMeshObject()->GetMaterial()->GetBaseDiffuseReflection();
    float pr = *std::max_element(&d[0], &d[0] + 3);
    if (mistake() == mean_roulette || mistake() == octant_and_mean) pr = (d[0] + d[1] + d[2]) / 3.f;
    if (mistake() == red_roulette) pr = d[0];
    if (mistake() == no_roulette) pr = 1.f;
    std::bernoulli_distribution scatters(mistake() == inverted_roulette ? 1.f - pr : pr);
    if (scatters(engine)) {
        if (mistake() == first_bounce_only && path.size() > 1) return;
        const glm::vec3 n = mistake() == flipped_normal ? -state.ComputeNormal() : state.ComputeNormal();
        glm::vec3 out;
        if (mistake() == none || mistake() == long_offset || mistake() == no_offset) {
            // n plus a point of the sphere follows the cosine.
            std::normal_distribution<float> normal;
            out = n + glm::normalize(glm::vec3(normal(engine), normal(engine), normal(engine)));
        } else {
            const float u1 = uniform(engine), u2 = uniform(engine), phi = (mistake() == degrees ? 360.f : 6.2831853f) * u2;
            float r = sqrt(u1), z = sqrt(1.f - u1);
            if (mistake() == no_square_root) r = u1;
            if (mistake() == uniform_hemisphere) { z = u1; r = sqrt(1.f - u1 * u1); }
            const float along = mistake() == nan_frame ? n.x : std::fabs(n.x);
            glm::vec3 t = glm::cross(n, along > 0.7f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0));
            if (mistake() != literal) t /= glm::length(t);
            const glm::vec3 b = glm::cross(n, t);
            glm::mat3 m(t, b, n);
            if (mistake() == exchanged) m = glm::mat3(b, t, n);
            if (mistake() == transposed_frame) m = glm::transpose(m);
            out = mistake() == along_normal ? n : m * glm::vec3(r * cos(phi), r * sin(phi), z);
        }
        Ray next(x + n * (mistake() == no_offset ? 0.f : mistake() == long_offset ? 1e-3f : 1e-4f), out);
        if (mistake() == start_not_moved) next.SetRayPosition(glm::vec3(0.f));
        path.push_back('S');
        TracePhoton(photonMap, &next, lightIntensity, path, currentIOR, --remainingBounces);
    }
}
