#pragma once

#include <kdtree++/kdtree.hpp>
#include "common/Rendering/Renderer/Backward/BackwardRenderer.h"
#include "common/Rendering/Renderer/Photon/Photon.h"

class PhotonMappingRenderer : public BackwardRenderer
{
public:
    PhotonMappingRenderer(std::shared_ptr<class Scene> scene, std::shared_ptr<class ColorSampler> sampler);

    void InitializeRenderer() override;
    glm::vec3 ComputeSampleColor(const struct IntersectionState& intersection, const class Ray& fromCameraRay) const override;
    void SetNumberOfDiffusePhotons(int diffuse);
private:
    using PhotonKdtree = KDTree::KDTree<3, Photon, PhotonAccessor>;

    void GenericPhotonMapGeneration(PhotonKdtree& photonMap, int totalPhotons);
    void TracePhoton(PhotonKdtree& photonMap, class Ray* photonRay, glm::vec3 lightIntensity, std::vector<char>& path, float currentIOR, int remainingBounces);

    // added
    static float Random();
    glm::vec3 CosineSample() const;
    glm::vec3 ToWorld(glm::vec3 local, glm::vec3 normal) const;
    void Store(PhotonKdtree& photonMap, const glm::vec3& position, const glm::vec3& intensity, const class Ray& from);
    bool Scatters(const class Material& material) const;
    long storedPhotons = 0;

    PhotonKdtree diffuseMap;
    int diffusePhotonNumber;
    int maxPhotonBounces;
};
