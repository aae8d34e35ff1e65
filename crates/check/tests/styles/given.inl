// What is given with the assignment; TracePhoton and GenerateRandomPhotonRay are the student's.
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
    for (size_t i = 0; i < storedScene->GetTotalLights(); ++i) {
        const Light* light = storedScene->GetLightObject(i);
        for (int j = 0; j < totalPhotons; ++j) {
            Ray photonRay;
            std::vector<char> path(1, 'L');
            light->GenerateRandomPhotonRay(photonRay);
            TracePhoton(photonMap, &photonRay, light->GetLightColor() / static_cast<float>(totalPhotons), path, 1.f, maxPhotonBounces);
        }
    }
}

glm::vec3 PhotonMappingRenderer::ComputeSampleColor(const struct IntersectionState& intersection, const class Ray& fromCameraRay) const
{
    return BackwardRenderer::ComputeSampleColor(intersection, fromCameraRay);
}

void PhotonMappingRenderer::SetNumberOfDiffusePhotons(int diffuse)
{
    diffusePhotonNumber = diffuse;
}
