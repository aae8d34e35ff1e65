// Stand-in for the header beside PhotonMappingRenderer.cpp, for those who hand in the .cpp alone.
#pragma once

#include <kdtree++/kdtree.hpp>

#include "common/Rendering/Renderer/Backward/BackwardRenderer.h"
#include "common/Rendering/Renderer/Photon/Photon.h"

class PhotonMappingRenderer : public BackwardRenderer {
public:
    PhotonMappingRenderer(std::shared_ptr<class Scene> scene,
                          std::shared_ptr<class ColorSampler> sampler);

    void InitializeRenderer() override;
    glm::vec3 ComputeSampleColor(const struct IntersectionState& intersection,
                                 const class Ray& fromCameraRay) const override;
    void SetNumberOfDiffusePhotons(int diffuse);

private:
    using PhotonKdtree = KDTree::KDTree<3, Photon, PhotonAccessor>;

    void GenericPhotonMapGeneration(PhotonKdtree& photonMap, int totalPhotons);
    void TracePhoton(PhotonKdtree& photonMap, class Ray* photonRay, glm::vec3 lightIntensity,
                     std::vector<char>& path, float currentIOR, int remainingBounces);

    int diffusePhotonNumber;
    PhotonKdtree diffuseMap;
    int maxPhotonBounces;
};
