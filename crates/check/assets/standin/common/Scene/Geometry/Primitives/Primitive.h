// Stand-in: a primitive with N corners. The assignment's scene has triangles only.
#pragma once

#include "common/Scene/Geometry/Primitives/PrimitiveBase.h"

template <int N>
class Primitive : public PrimitiveBase {
public:
    explicit Primitive(const MeshObject* owner) : parent(owner) {}

    const MeshObject* GetParentMeshObject() const override { return parent; }
    int GetTotalVertices() const override { return N; }
    glm::vec3 GetVertexPosition(int index) const override { return positions[index]; }
    bool HasVertexNormals() const override { return true; }
    glm::vec3 GetVertexNormal(int index) const override { return normals[index]; }
    glm::vec3 GetPrimitiveNormal() const override {
        return glm::normalize(
            glm::cross(positions[1] - positions[0], positions[2] - positions[0]));
    }

    // Not in the framework.
    void SetVertex(int index, glm::vec3 position, glm::vec3 normal) {
        positions[index] = position;
        normals[index] = normal;
    }

protected:
    const MeshObject* parent;
    glm::vec3 positions[N];
    glm::vec3 normals[N];
};
