// Stand-in: a ray. The constructor normalizes the direction, SetRayDirection does not. So it is in
// the framework.
#pragma once

#include "common/Scene/SceneObject.h"

class Ray : public SceneObject {
public:
    Ray() : rayDirection(0.f, 0.f, -1.f), maxT(std::numeric_limits<float>::max()), rayMask(0) {}
    Ray(glm::vec3 from, glm::vec3 towards, float farthest = std::numeric_limits<float>::max())
        : rayDirection(glm::normalize(towards)), maxT(farthest), rayMask(0) {
        SetPosition(from);
    }

    void SetRayPosition(glm::vec3 from) { SetPosition(from); }
    void SetRayDirection(glm::vec3 towards) { rayDirection = towards; }

    glm::vec3 GetRayDirection() const { return rayDirection; }
    glm::vec4 GetForwardDirection() const { return glm::vec4(rayDirection, 0.f); }
    glm::vec3 GetRayPosition(float t) const { return glm::vec3(position) + t * rayDirection; }

    float GetMaxT() const { return maxT; }
    void SetMaxT(float farthest) { maxT = farthest; }
    void SetRayMask(uint64_t mask) { rayMask = mask; }
    bool IsObjectMasked(uint64_t object) const { return (object & rayMask) != 0; }

    // Bends `direction` at a surface by Snell's law; the direction is unchanged where all light is
    // reflected.
    glm::vec3 RefractRay(const glm::vec3& normal, float fromIOR, float& targetIOR) const;

private:
    glm::vec3 rayDirection;
    float maxT;
    uint64_t rayMask;
};
