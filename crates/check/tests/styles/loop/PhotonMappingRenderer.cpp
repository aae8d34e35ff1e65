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


// Double arithmetic, lambdas, std::rand through a pointer, a loop in place of the recursion.
void PhotonMappingRenderer::TracePhoton(PhotonKdtree& photonMap, Ray* photonRay, glm::vec3 lightIntensity, std::vector<char>& path, float currentIOR, int remainingBounces)
{
    int (*draw)() = &std::rand;
    const auto uniform = [draw]() -> double { return draw() / (static_cast<double>(RAND_MAX) + 1.0); };
    Ray current = *photonRay;
    const int last = mistake() == bounce_off_by_one ? 1 : 0;
    for (int left = remainingBounces; left >= last; --left) {
        IntersectionState state(0, 0);
        state.currentIOR = currentIOR;
        if (!storedScene->Trace(&current, &state)) {
            return;
        }
        const glm::dvec3 where(state.intersectionRay.GetRayPosition(state.intersectionT));
        if (path.size() != 1 || mistake() == direct_stored) {
            Photon stored;
            stored.position = glm::vec3(where);
            stored.intensity = lightIntensity;
            stored.toLightRay.SetRayPosition(stored.position);
            stored.toLightRay.SetRayDirection(-current.GetRayDirection());
            photonMap.insert(stored);
        }
        const glm::dvec3 d(state.intersectedPrimitive->GetParentMeshObject()->GetMaterial()->GetBaseDiffuseReflection());
        double chance = std::max({d.x, d.y, d.z});
        if (mistake() == mean_roulette || mistake() == octant_and_mean) chance = (d.x + d.y + d.z) / 3;
        if (mistake() == red_roulette) chance = d.x;
        if (mistake() == no_roulette) chance = 1;
        const double number = uniform();
        if (mistake() == inverted_roulette ? number < chance : !(number < chance)) {
            return;
        }
        if (mistake() == first_bounce_only && path.size() > 1) {
            return;
        }
        double u1 = uniform();
        const double u2 = uniform();
        const glm::dvec3 local = [u1, u2] {
            double r = std::sqrt(u1), z = std::sqrt(1 - u1);
            if (mistake() == no_square_root) r = u1;
            if (mistake() == uniform_hemisphere) { z = u1; r = std::sqrt(1 - u1 * u1); }
            const double theta = mistake() == degrees ? 360 * u2 : 2 * 3.14159265358979323846 * u2;
            return glm::normalize(glm::dvec3(r * std::cos(theta), r * std::sin(theta), z));
        }();
        const glm::dvec3 n = (mistake() == flipped_normal ? -1.0 : 1.0) * glm::dvec3(state.ComputeNormal());
        const auto close = [&n](double x) { return mistake() == nan_frame ? x > 0.95 : std::abs(x) > 0.95; };
        glm::dvec3 t = glm::cross(n, close(n.x) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0));
        if (mistake() != literal) t = glm::normalize(t);
        glm::dvec3 b = glm::cross(n, t);
        if (mistake() == exchanged) std::swap(t, b);
        glm::dmat3 toWorld(t, b, n);
        if (mistake() == transposed_frame) toWorld = glm::transpose(toWorld);
        glm::dvec3 out = glm::normalize(toWorld * local);
        if (mistake() == along_normal) out = n;
        const double offset = mistake() == long_offset ? 2e-3 : mistake() == no_offset ? 0 : 1e-4;
        current = Ray(glm::vec3(where + offset * n), glm::vec3(out));
        if (mistake() == start_not_moved) current.SetRayPosition(glm::vec3(photonRay->GetPosition()));
        path.push_back('D');
    }
}
