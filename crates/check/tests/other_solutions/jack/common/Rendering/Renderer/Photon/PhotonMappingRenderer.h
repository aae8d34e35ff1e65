#pragma once

#include "common/Rendering/Renderer/Backward/BackwardRenderer.h"
#include "common/Rendering/Renderer/Photon/Photon.h"
#include "kdtree++/kdtree.hpp"

class PhotonMappingRenderer : public BackwardRenderer
{
public:
    PhotonMappingRenderer(std::shared_ptr<class Scene> scene, std::shared_ptr<class ColorSampler> sampler);
    virtual void InitializeRenderer() override;
    glm::vec3 ComputeSampleColor(const struct IntersectionState& intersection, const class Ray& fromCameraRay) const override;
    void SetNumberOfDiffusePhotons(int diffuse);
private:
    using PhotonKdtree = KDTree::KDTree<3, Photon, PhotonAccessor>;
    PhotonKdtree diffuseMap;
    int diffusePhotonNumber;
    int maxPhotonBounces;
    int photonsStored = 0;

    void GenericPhotonMapGeneration(PhotonKdtree& photonMap, int totalPhotons);
    void TracePhoton(PhotonKdtree& photonMap, class Ray* photonRay, glm::vec3 lightIntensity, std::vector<char>& path, float currentIOR, int remainingBounces);
};
