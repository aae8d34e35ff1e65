// Stand-in: what Scene::Trace found.
#pragma once

#include "common/Scene/Geometry/Primitives/Primitive.h"
#include "common/Scene/Geometry/Primitives/PrimitiveBase.h"
#include "common/Scene/Geometry/Ray/Ray.h"

struct IntersectionState {
    IntersectionState() { Clear(0, 0); }
    IntersectionState(int reflectionBounces, int refractionBounces) {
        Clear(reflectionBounces, refractionBounces);
    }

    std::shared_ptr<IntersectionState> reflectionIntersection;
    std::shared_ptr<IntersectionState> refractionIntersection;
    int remainingReflectionBounces;
    int remainingRefractionBounces;

    const PrimitiveBase* intersectedPrimitive;
    const SceneObject* primitiveParent;
    Ray intersectionRay;
    float intersectionT;
    bool hasIntersection;
    float currentIOR;
    std::vector<float> primitiveIntersectionWeights;

    // The corners' normals, blended and normalized. It is never turned towards the ray.
    glm::vec3 ComputeNormal() const;
    glm::vec2 ComputeUV() const { return glm::vec2(0.f); }
    void TestAndCopyLimits(const IntersectionState*) {}

private:
    void Clear(int reflectionBounces, int refractionBounces) {
        remainingReflectionBounces = reflectionBounces;
        remainingRefractionBounces = refractionBounces;
        intersectedPrimitive = nullptr;
        primitiveParent = nullptr;
        intersectionT = std::numeric_limits<float>::max();
        hasIntersection = false;
        currentIOR = 1.f;
    }
};
