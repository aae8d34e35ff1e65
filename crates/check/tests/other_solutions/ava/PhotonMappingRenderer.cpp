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
    /*
     * Assignment 8: Trace the photon into the scene, store it and decide whether it is scattered.
     * Paths: L is light, D is diffuse.
     */
    assert(photonRay);
    Ray current = *photonRay;
    // loop instead of recursion, so that 1000 bounces do not pile up on the stack
    while (remainingBounces >= 0) {
        IntersectionState state(0, 0);
        state.currentIOR = currentIOR;
        if (!storedScene->Trace(&current, &state)) break;

        const glm::vec3 where = state.intersectionRay.GetRayPosition(state.intersectionT);
        if (path.size() != 1) {
            Photon ph;
            ph.position = where;
            ph.intensity = lightIntensity;
            ph.toLightRay = Ray(where, -1.f * current.GetRayDirection());
            photonMap.insert(ph);
        }

        const glm::vec3 d = state.intersectedPrimitive->GetParentMeshObject()->GetMaterial()->GetBaseDiffuseReflection();
        const float survive = std::max(std::max(d.x, d.y), d.z);
        const float dice = (float)(rand() / (RAND_MAX + 1.0));
        if (dice >= survive) break;

        const float u1 = (float)(rand() / (RAND_MAX + 1.0));
        const float u2 = (float)(rand() / (RAND_MAX + 1.0));
        const float r = sqrtf(u1), theta = 2.f * PI * u2;
        const glm::vec3 local(r * cosf(theta), r * sinf(theta), sqrtf(std::max(0.f, 1.f - u1)));

        const glm::vec3 n = state.ComputeNormal();
        const glm::vec3 helper = fabsf(n.x) > 0.9f ? glm::vec3(0.f, 1.f, 0.f) : glm::vec3(1.f, 0.f, 0.f);
        const glm::vec3 t = glm::normalize(glm::cross(n, helper));
        const glm::vec3 b = glm::normalize(glm::cross(n, t));
        const glm::vec3 world = local.x * t + local.y * b + local.z * n;

        current = Ray(where + 1e-4f * n, world);
        path.push_back('D');
        --remainingBounces;
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
