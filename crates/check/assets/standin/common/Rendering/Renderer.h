// Stand-in: the base of all renderers.
#pragma once

#include "common/Intersection/IntersectionState.h"
#include "common/Sampling/ColorSampler.h"
#include "common/Scene/Scene.h"

class Renderer : public std::enable_shared_from_this<Renderer> {
public:
    Renderer(std::shared_ptr<Scene> scene, std::shared_ptr<ColorSampler> sampler)
        : storedScene(scene), storedSampler(sampler) {}
    virtual ~Renderer() {}

    virtual void InitializeRenderer() = 0;
    virtual glm::vec3 ComputeSampleColor(const IntersectionState& intersection,
                                         const Ray& fromCameraRay) const = 0;

protected:
    std::shared_ptr<Scene> storedScene;
    std::shared_ptr<ColorSampler> storedSampler;
};
