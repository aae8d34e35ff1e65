// Stand-in: what a ray can meet.
#pragma once

#include "common/Scene/Geometry/Mesh/MeshObject.h"

class PrimitiveBase {
public:
    virtual ~PrimitiveBase() {}
    virtual const MeshObject* GetParentMeshObject() const = 0;
    virtual glm::vec3 GetPrimitiveNormal() const = 0;
    virtual int GetTotalVertices() const = 0;
    virtual glm::vec3 GetVertexPosition(int index) const = 0;
    virtual bool HasVertexNormals() const = 0;
    virtual glm::vec3 GetVertexNormal(int index) const = 0;
    virtual bool HasVertexUVs() const { return false; }
    virtual glm::vec2 GetVertexUV(int) const { return glm::vec2(0.f); }
};
