#include "common/Rendering/Renderer/Photon/PhotonMappingRenderer.h"
#include "common/Scene/Scene.h"
#include "common/Sampling/ColorSampler.h"
#include "common/Scene/Lights/Light.h"
#include "common/Scene/Geometry/Primitives/Primitive.h"
#include "common/Scene/Geometry/Mesh/MeshObject.h"
#include "common/Rendering/Material/Material.h"
#include "common/Intersection/IntersectionState.h"
#include <ctime>
#define VISUALIZE_PHOTON_MAPPING 1

PhotonMappingRenderer::PhotonMappingRenderer(std::shared_ptr<class Scene> scene, std::shared_ptr<class ColorSampler> sampler):
    BackwardRenderer(scene, sampler),
    diffusePhotonNumber(1000000),
    maxPhotonBounces(1000)
{
    srand(static_cast<unsigned int>(time(NULL)));
}

void PhotonMappingRenderer::InitializeRenderer()
{
    // Generate Photon Maps
    GenericPhotonMapGeneration(diffuseMap, diffusePhotonNumber);
    diffuseMap.optimise();
}

void PhotonMappingRenderer::GenericPhotonMapGeneration(PhotonKdtree& photonMap, int totalPhotons)
{
    float totalLightIntensity = 0.f;
    size_t totalLights = storedScene->GetTotalLights();
    for (size_t i = 0; i < totalLights; ++i) {
        const Light* currentLight = storedScene->GetLightObject(i);
        if (!currentLight) {
            continue;
        }
        totalLightIntensity += glm::length(currentLight->GetLightColor());
    }

    // Shoot photons -- number of photons for light is proportional to the light's intensity relative to the total light intensity of the scene.
    for (size_t i = 0; i < totalLights; ++i) {
        const Light* currentLight = storedScene->GetLightObject(i);
        if (!currentLight) {
            continue;
        }

        const float proportion = glm::length(currentLight->GetLightColor()) / totalLightIntensity;
        const int totalPhotonsForLight = static_cast<const int>(proportion * totalPhotons);
        const glm::vec3 photonIntensity = currentLight->GetLightColor() / static_cast<float>(totalPhotonsForLight);
        for (int j = 0; j < totalPhotonsForLight; ++j) {
            Ray photonRay;
            std::vector<char> path;
            path.push_back('L');
            currentLight->GenerateRandomPhotonRay(photonRay);
            TracePhoton(photonMap, &photonRay, photonIntensity, path, 1.f, maxPhotonBounces);
        }
    }
}

void PhotonMappingRenderer::TracePhoton(PhotonKdtree& photonMap, Ray* photonRay, glm::vec3 lightIntensity, std::vector<char>& path, float currentIOR, int remainingBounces)
{
    if (remainingBounces < 0) return;
    IntersectionState state(0, 0);
    state.currentIOR = currentIOR;
    if (!storedScene->Trace(photonRay, &state)) return;

    int (*const draw)() = std::rand;
    const auto canonical = [draw] { return std::min(draw() / static_cast<float>(RAND_MAX), 0.99999994f); };
    const auto point = state.intersectionRay.GetRayPosition(state.intersectionT);
    const auto normal = state.ComputeNormal();

    const auto store = [&] {
        Photon p;
        p.position = point;   // the rest is not needed for this assignment
        photonMap.insert(p);
    };
    const auto brightest = [](const glm::vec3& c) { return *std::max_element(&c[0], &c[0] + 3); };
    const auto sample = [&] {
        const float u1 = canonical(), u2 = canonical();
        return glm::vec3(std::sqrt(u1) * std::cos(2.f * PI * u2), std::sqrt(u1) * std::sin(2.f * PI * u2), std::sqrt(1.f - u1));
    };
    const auto toWorld = [&](const glm::vec3& v) {
        const bool parallel = std::abs(glm::dot(normal, glm::vec3(1.f, 0.f, 0.f))) > 0.95f;
        // t and b exactly as in the handout
        const glm::vec3 t = glm::cross(normal, parallel ? glm::vec3(0.f, 1.f, 0.f) : glm::vec3(1.f, 0.f, 0.f));
        const glm::vec3 b = glm::cross(normal, t);
        return glm::normalize(glm::mat3(t, b, normal) * v);
    };

    if (path.size() > 1) store();
    if (canonical() < brightest(state.intersectedPrimitive->GetParentMeshObject()->GetMaterial()->GetBaseDiffuseReflection())) {
        std::vector<char> longer(path);
        longer.emplace_back('D');
        const glm::vec3 direction = toWorld(sample());
        Ray bounced(point + direction * 1e-4f, direction);
        TracePhoton(photonMap, &bounced, lightIntensity, longer, currentIOR, remainingBounces - 1);
    }
}

glm::vec3 PhotonMappingRenderer::ComputeSampleColor(const struct IntersectionState& intersection, const class Ray& fromCameraRay) const
{
    glm::vec3 finalRenderColor = BackwardRenderer::ComputeSampleColor(intersection, fromCameraRay);
#if VISUALIZE_PHOTON_MAPPING
    Photon intersectionVirtualPhoton;
    intersectionVirtualPhoton.position = intersection.intersectionRay.GetRayPosition(intersection.intersectionT);

    std::vector<Photon> foundPhotons;
    diffuseMap.find_within_range(intersectionVirtualPhoton, 0.003f, std::back_inserter(foundPhotons));
    if (!foundPhotons.empty()) {
        finalRenderColor += glm::vec3(1.f, 0.f, 0.f);
    }
#endif
    return finalRenderColor;
}

void PhotonMappingRenderer::SetNumberOfDiffusePhotons(int diffuse)
{
    diffusePhotonNumber = diffuse;
}
