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
    if (remainingBounces < 0) {
        return;
    }
    IntersectionState state(0, 0);
    state.currentIOR = currentIOR;
    if (!storedScene->Trace(photonRay, &state)) {
        return;
    }
    const glm::vec3 hit = state.intersectionRay.GetRayPosition(state.intersectionT);
    if (path.size() > 1) {
        Photon stored;
        stored.position = hit;
        stored.intensity = lightIntensity;
        stored.toLightRay.SetRayPosition(hit);
        stored.toLightRay.SetRayDirection(-photonRay->GetRayDirection());
        photonMap.insert(stored);
    }
    const MeshObject* hitMeshObject = state.intersectedPrimitive->GetParentMeshObject();
    const Material* hitMaterial = hitMeshObject->GetMaterial();
    const glm::dvec3 d(hitMaterial->GetBaseDiffuseReflection());
    if (!(Next() < std::max({d.r, d.g, d.b}))) {
        return;
    }
    const double u1 = Next();
    const double u2 = Next();
    const glm::dvec3 n(state.ComputeNormal());
    const glm::dvec3 out = Basis(n) * CosineDirection(u1, u2);
    Ray next(glm::vec3(glm::dvec3(hit) + 1e-5 * n), glm::vec3(out));
    path.push_back('D');
    TracePhoton(photonMap, &next, lightIntensity, path, currentIOR, remainingBounces - 1);
}

glm::dvec3 PhotonMappingRenderer::CosineDirection(double u1, double u2)
{
    const double r = std::sqrt(u1), theta = 2.0 * 3.14159265358979323846 * u2;
    return glm::dvec3(r * std::cos(theta), r * std::sin(theta), std::sqrt(1.0 - u1));
}

glm::dmat3 PhotonMappingRenderer::Basis(const glm::dvec3& n)
{
    // smallest component of n decides which axis is crossed
    glm::dvec3 a = glm::abs(n), axis(0.0);
    axis[a.x <= a.y && a.x <= a.z ? 0 : (a.y <= a.z ? 1 : 2)] = 1.0;
    const glm::dvec3 t = glm::normalize(glm::cross(n, axis));
    return glm::dmat3(t, glm::cross(n, t), n);
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
