#include "common/Rendering/Renderer/Photon/PhotonMappingRenderer.h"
#include "common/Scene/Scene.h"
#include "common/Sampling/ColorSampler.h"
#include "common/Scene/Lights/Light.h"
#include "common/Scene/Geometry/Primitives/PrimitiveBase.h"
#include "common/Scene/Geometry/Mesh/MeshObject.h"
#include "common/Rendering/Material/Material.h"
#include "common/Intersection/IntersectionState.h"
#include <ctime>

PhotonMappingRenderer::PhotonMappingRenderer(std::shared_ptr<class Scene> scene, std::shared_ptr<class ColorSampler> sampler):
    BackwardRenderer(scene, sampler), diffusePhotonNumber(1000000), maxPhotonBounces(1000)
{
    srand(static_cast<unsigned int>(time(NULL)));
}

void PhotonMappingRenderer::InitializeRenderer()
{
    GenericPhotonMapGeneration(diffuseMap, diffusePhotonNumber);
    diffuseMap.optimise();
}

void PhotonMappingRenderer::GenericPhotonMapGeneration(PhotonKdtree& photonMap, int totalPhotons)
{
    float brightness = 0.f;
    for (size_t i = 0; i < storedScene->GetTotalLights(); ++i) {
        brightness += glm::length(storedScene->GetLightObject(i)->GetLightColor());
    }
    for (size_t i = 0; i < storedScene->GetTotalLights(); ++i) {
        const Light* light = storedScene->GetLightObject(i);
        const int ofLight = static_cast<int>(glm::length(light->GetLightColor()) / brightness * totalPhotons);
        const glm::vec3 each = light->GetLightColor() / static_cast<float>(ofLight);
        for (int j = 0; j < ofLight; ++j) {
            Ray photonRay;
            std::vector<char> path;
            path.push_back('L');
            light->GenerateRandomPhotonRay(photonRay);
            TracePhoton(photonMap, &photonRay, each, path, 1.f, maxPhotonBounces);
        }
    }
}

void PhotonMappingRenderer::TracePhoton(PhotonKdtree& photonMap, Ray* photonRay, glm::vec3 lightIntensity, std::vector<char>& path, float currentIOR, int remainingBounces)
{
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
        Photon photon;
        photon.position = hit;
        photon.intensity = lightIntensity;
        photon.toLightRay = Ray(hit, -photonRay->GetRayDirection());
        photonMap.insert(photon);
    }

    const Material* material = state.intersectedPrimitive->GetParentMeshObject()->GetMaterial();
    const glm::vec3 d = material->GetBaseDiffuseReflection();
    const float pr = std::max(d.r, std::max(d.g, d.b));
    if ((float)rand() / RAND_MAX >= pr) {
        return;
    }

    const float u1 = (float)rand() / RAND_MAX;
    const float u2 = (float)rand() / RAND_MAX;
    const float r = std::sqrt(u1);
    const float theta = 2.f * 3.14159265f * u2;
    const glm::vec3 sample(r * std::cos(theta), r * std::sin(theta), std::sqrt(1.f - u1));

    const glm::vec3 n = state.ComputeNormal();
    glm::vec3 axis(1.f, 0.f, 0.f);
    if (std::abs(glm::dot(n, axis)) > 0.99f) {
        axis = glm::vec3(0.f, 1.f, 0.f);
    }
    const glm::vec3 t = glm::normalize(glm::cross(n, axis));
    const glm::vec3 b = glm::normalize(glm::cross(n, t));
    const glm::vec3 out = glm::normalize(glm::mat3(t, b, n) * sample);

    Ray scattered(hit + 1e-5f * n, out);
    path.push_back('D');
    TracePhoton(photonMap, &scattered, lightIntensity, path, currentIOR, remainingBounces - 1);
}

glm::vec3 PhotonMappingRenderer::ComputeSampleColor(const struct IntersectionState& intersection, const class Ray& fromCameraRay) const
{
    glm::vec3 color = BackwardRenderer::ComputeSampleColor(intersection, fromCameraRay);
    Photon here;
    here.position = intersection.intersectionRay.GetRayPosition(intersection.intersectionT);
    std::vector<Photon> found;
    diffuseMap.find_within_range(here, 0.003f, std::back_inserter(found));
    if (!found.empty()) {
        color += glm::vec3(1.f, 0.f, 0.f);
    }
    return color;
}

void PhotonMappingRenderer::SetNumberOfDiffusePhotons(int diffuse)
{
    diffusePhotonNumber = diffuse;
}
