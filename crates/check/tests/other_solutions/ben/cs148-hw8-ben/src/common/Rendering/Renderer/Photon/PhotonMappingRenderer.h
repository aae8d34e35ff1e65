#pragma once

#include "common/Rendering/Renderer/Backward/BackwardRenderer.h"
#include "common/Rendering/Renderer/Photon/Photon.h"
#include "kdtree++/kdtree.hpp"
#include <random>

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

    // my own generator: rand() only has 15 bits on my laptop
    std::mt19937 generator{20191125u};
    std::uniform_real_distribution<double> unit{0.0, 1.0};
    double Next() { return unit(generator); }
    static glm::dvec3 CosineDirection(double u1, double u2);
    static glm::dmat3 Basis(const glm::dvec3& n);

    void GenericPhotonMapGeneration(PhotonKdtree& photonMap, int totalPhotons);
    void TracePhoton(PhotonKdtree& photonMap, class Ray* photonRay, glm::vec3 lightIntensity, std::vector<char>& path, float currentIOR, int remainingBounces);
};
