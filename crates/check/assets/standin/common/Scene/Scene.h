// Stand-in: meshes and lights, and the question what a ray meets. Trace is in harness/scene.cpp.
#pragma once

#include "common/Intersection/IntersectionState.h"
#include "common/Scene/Geometry/Mesh/MeshObject.h"
#include "common/Scene/Lights/Light.h"

class Scene {
public:
    // Fills `state` with the closest hit; without a state, any hit will do.
    bool Trace(class Ray* ray, IntersectionState* state) const;

    size_t GetTotalLights() const { return lights.size(); }
    const Light* GetLightObject(size_t index) const { return lights.at(index).get(); }
    size_t GetTotalObjects() const { return objects.size(); }
    const SceneObject& GetSceneObject(size_t index) const { return *objects.at(index); }

    void PerformRaySpecularReflection(Ray& output, const Ray& input, const glm::vec3& point,
                                      float towardsNormal, const IntersectionState& state) const {
        const glm::vec3 normal = state.ComputeNormal();
        output.SetRayPosition(point + LARGE_EPSILON * normal);
        output.SetRayDirection(input.GetRayDirection() - 2.f * towardsNormal * normal);
    }
    void PerformRayRefraction(Ray& output, const Ray& input, const glm::vec3& point,
                              float towardsNormal, const IntersectionState& state,
                              float& targetIOR) const {
        const glm::vec3 normal = state.ComputeNormal();
        output.SetRayPosition(point + (towardsNormal < 0.f ? -LARGE_EPSILON : LARGE_EPSILON) * normal);
        output.SetRayDirection(input.RefractRay(normal, state.currentIOR, targetIOR));
    }

    // Not in the framework: how the harness fills the scene.
    MeshObject* AddObject(const std::string& name, glm::vec3 diffuse);
    void AddTriangle(const MeshObject* object, const glm::vec3 (&corners)[3], glm::vec3 normal);
    void AddLight(std::shared_ptr<Light> light) { lights.push_back(light); }

private:
    std::vector<std::shared_ptr<MeshObject>> objects;
    std::vector<Primitive<3>> triangles;
    std::vector<std::shared_ptr<Light>> lights;
};
