// Stand-in: anything with a place in the scene.
#pragma once

#include "common/common.h"

class SceneObject : public std::enable_shared_from_this<SceneObject> {
public:
    SceneObject() : position(0.f, 0.f, 0.f, 1.f), rotation(1.f, 0.f, 0.f, 0.f), scale(1.f) {}
    virtual ~SceneObject() {}

    virtual glm::vec4 GetPosition() const { return position; }
    void SetPosition(glm::vec3 place) { position = glm::vec4(place, 1.f); }
    void Translate(const glm::vec3& by) { position += glm::vec4(by, 0.f); }
    void Rotate(const glm::vec3& axis, float radians) {
        rotation = glm::angleAxis(radians, glm::normalize(axis)) * rotation;
    }
    void MultScale(float by) { scale *= by; }

    glm::mat4 GetObjectToWorldMatrix() const {
        return glm::translate(glm::mat4(1.f), glm::vec3(position)) * glm::mat4_cast(rotation) *
               glm::scale(glm::mat4(1.f), glm::vec3(scale));
    }
    glm::mat4 GetWorldToObjectMatrix() const { return glm::inverse(GetObjectToWorldMatrix()); }
    glm::vec4 GetForwardDirection() const { return Turned(0.f, 0.f, -1.f); }
    glm::vec4 GetUpDirection() const { return Turned(0.f, 1.f, 0.f); }
    glm::vec4 GetRightDirection() const { return Turned(1.f, 0.f, 0.f); }

protected:
    glm::vec4 position;
    glm::quat rotation;
    float scale;

private:
    glm::vec4 Turned(float x, float y, float z) const {
        return glm::vec4(rotation * glm::vec3(x, y, z), 0.f);
    }
};
