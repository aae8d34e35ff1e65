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
    void Rotate(const glm::vec3& axis, float radians);
    void MultScale(float by) { scale *= by; }

    glm::mat4 GetObjectToWorldMatrix() const;
    glm::mat4 GetWorldToObjectMatrix() const;
    glm::vec4 GetForwardDirection() const;
    glm::vec4 GetUpDirection() const;
    glm::vec4 GetRightDirection() const;

protected:
    glm::vec4 position;
    glm::quat rotation;
    float scale;
};
