// Stand-in: meshes and lights, and the question what a ray meets. Their functions are in harness/scene.cpp.
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
                                      float towardsNormal, const IntersectionState& state) const;
    void PerformRayRefraction(Ray& output, const Ray& input, const glm::vec3& point,
                              float towardsNormal, const IntersectionState& state,
                              float& targetIOR) const;

    // Not in the framework: how the harness fills the scene.
    MeshObject* AddObject(const std::string& name, glm::vec3 diffuse);
    void AddTriangle(const MeshObject* object, const glm::vec3 (&corners)[3], glm::vec3 normal);
    void AddLight(std::shared_ptr<Light> light) { lights.push_back(light); }

private:
    std::vector<std::shared_ptr<MeshObject>> objects;
    std::vector<Primitive<3>> triangles;
    std::vector<std::shared_ptr<Light>> lights;
};
