// Stand-in: a part of the model that has one material.
#pragma once

#include "common/Rendering/Material/Material.h"
#include "common/Scene/SceneObject.h"

class MeshObject : public SceneObject {
public:
    MeshObject() : number(0) {}
    MeshObject(const std::string& called, std::shared_ptr<Material> made_of, int place_in_model)
        : name(called), material(made_of), number(place_in_model) {}

    const Material* GetMaterial() const { return material.get(); }
    std::string GetName() const { return name; }

    // Not in the framework: the object's place in the model file, from 0.
    int NumberInModel() const { return number; }

private:
    std::string name;
    std::shared_ptr<Material> material;
    int number;
};
