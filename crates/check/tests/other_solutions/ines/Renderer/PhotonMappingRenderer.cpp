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

static float random01()
{
    return static_cast<float>(rand() / (static_cast<double>(RAND_MAX) + 1.0));
}

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

    const glm::vec3 hitPoint = state.intersectionRay.GetRayPosition(state.intersectionT);
    if (path.size() > 1) {
        Photon photon;
        photon.position = hitPoint;
        photon.intensity = lightIntensity;
        photon.toLightRay = Ray(hitPoint, -photonRay->GetRayDirection());
        photonMap.insert(photon);
    }

    const MeshObject* hitMeshObject = state.intersectedPrimitive->GetParentMeshObject();
    const Material* hitMaterial = hitMeshObject->GetMaterial();
    const glm::vec3 diffuse = hitMaterial->GetBaseDiffuseReflection();
    const float Pr = std::max(diffuse.r, std::max(diffuse.g, diffuse.b));
    if (random01() < Pr) {
        const float u1 = random01();
        const float u2 = random01();
        const float r = sqrt(u1);
        const float theta = 2.f * PI * u2;
        const glm::vec3 sample = glm::normalize(glm::vec3(r * cos(theta), r * sin(theta), sqrt(1.f - u1)));

        const glm::vec3 n = state.ComputeNormal();
        glm::vec3 up = fabs(n.x) > 0.99 ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        glm::vec3 t = glm::normalize(glm::cross(n, up));
        glm::vec3 b = glm::cross(n, t);
        // columns are t, b, n
        glm::mat3 tangentToWorld(t.x, b.x, n.x,
                                 t.y, b.y, n.y,
                                 t.z, b.z, n.z);
        glm::vec3 direction = tangentToWorld * sample;

        Ray diffuseRay;
        diffuseRay.SetRayPosition(hitPoint + LARGE_EPSILON * n);
        diffuseRay.SetRayDirection(direction);
        path.push_back('D');
        TracePhoton(photonMap, &diffuseRay, lightIntensity, path, currentIOR, remainingBounces - 1);
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
