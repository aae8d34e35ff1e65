// Scene::Trace with the framework's choices: the triangle test of Moeller and Trumbore ("Fast,
// Minimum Storage Ray/Triangle Intersection", 1997), two-sided, one triangle after another.

#include "common/Scene/Scene.h"

#include "recorder.hpp"

namespace {

// Every question asks what is wrong, never what is right. A NaN then passes, as in the framework.
bool meets(const Primitive<3>& triangle, const glm::vec3& from, const glm::vec3& direction,
           float& t, float& u, float& v) {
    const glm::vec3 corner = triangle.GetVertexPosition(0);
    const glm::vec3 edge1 = triangle.GetVertexPosition(1) - corner;
    const glm::vec3 edge2 = triangle.GetVertexPosition(2) - corner;
    const glm::vec3 p = glm::cross(direction, edge2);
    const float determinant = glm::dot(edge1, p);
    if (std::abs(determinant) < SMALL_EPSILON) {
        return false;
    }
    const glm::vec3 s = from - corner;
    u = glm::dot(s, p) / determinant;
    if (u < 0.f || u > 1.f) {
        return false;
    }
    const glm::vec3 q = glm::cross(s, edge1);
    v = glm::dot(direction, q) / determinant;
    if (v < 0.f || u + v > 1.f) {
        return false;
    }
    t = glm::dot(edge2, q) / determinant;
    return true;
}

} // namespace

bool Scene::Trace(Ray* ray, IntersectionState* state) const {
    const glm::vec3 from = glm::vec3(ray->GetPosition());
    const glm::vec3 direction = ray->GetRayDirection();
    float closest = ray->GetMaxT();
    float weight1 = 0.f;
    float weight2 = 0.f;
    const Primitive<3>* met = nullptr;
    for (const Primitive<3>& triangle : triangles) {
        float t, u, v;
        if (!meets(triangle, from, direction, t, u, v) || t < -SMALL_EPSILON ||
            t > closest + SMALL_EPSILON) {
            continue;
        }
        met = &triangle;
        closest = t;
        weight1 = u;
        weight2 = v;
        if (state == nullptr) {
            break;
        }
    }
    if (state != nullptr) {
        state->intersectionRay = *ray;
        state->hasIntersection = met != nullptr;
        if (met != nullptr) {
            state->intersectionT = closest;
            state->intersectedPrimitive = met;
            state->primitiveParent = met->GetParentMeshObject();
            state->primitiveIntersectionWeights.assign({1.f - weight1 - weight2, weight1, weight2});
        }
    }
    const float told[6] = {from.x, from.y, from.z, direction.x, direction.y, direction.z};
    photon_check::on_trace(told, met != nullptr, state != nullptr, closest,
                           met == nullptr ? 0 : met->GetParentMeshObject()->NumberInModel(),
                           met == nullptr ? 0 : static_cast<int>(met - triangles.data()));
    return met != nullptr;
}

MeshObject* Scene::AddObject(const std::string& name, glm::vec3 diffuse) {
    const int number = static_cast<int>(objects.size());
    objects.push_back(
        std::make_shared<MeshObject>(name, std::make_shared<Material>(diffuse), number));
    return objects.back().get();
}

void Scene::AddTriangle(const MeshObject* object, const glm::vec3 (&corners)[3],
                        glm::vec3 normal) {
    Primitive<3> triangle(object);
    for (int i = 0; i < 3; ++i) {
        triangle.SetVertex(i, corners[i], normal);
    }
    triangles.push_back(triangle);
}

void Scene::PerformRaySpecularReflection(Ray& output, const Ray& input, const glm::vec3& point,
                                         float towardsNormal,
                                         const IntersectionState& state) const {
    const glm::vec3 normal = state.ComputeNormal();
    output.SetRayPosition(point + LARGE_EPSILON * normal);
    output.SetRayDirection(input.GetRayDirection() - 2.f * towardsNormal * normal);
}

void Scene::PerformRayRefraction(Ray& output, const Ray& input, const glm::vec3& point,
                                 float towardsNormal, const IntersectionState& state,
                                 float& targetIOR) const {
    const glm::vec3 normal = state.ComputeNormal();
    output.SetRayPosition(point + (towardsNormal < 0.f ? -LARGE_EPSILON : LARGE_EPSILON) * normal);
    output.SetRayDirection(input.RefractRay(normal, state.currentIOR, targetIOR));
}

glm::vec3 IntersectionState::ComputeNormal() const {
    glm::vec3 blended(0.f);
    for (size_t i = 0; i < primitiveIntersectionWeights.size(); ++i) {
        blended += primitiveIntersectionWeights[i] *
                   intersectedPrimitive->GetVertexNormal(static_cast<int>(i));
    }
    return glm::normalize(blended);
}

glm::vec3 Ray::RefractRay(const glm::vec3& normal, float fromIOR, float& targetIOR) const {
    const glm::vec3 direction = GetRayDirection();
    const bool leaves = glm::dot(direction, normal) > 0.f;
    if (leaves) {
        targetIOR = 1.f;
    }
    const glm::vec3 bent = glm::refract(direction, leaves ? -normal : normal, fromIOR / targetIOR);
    return glm::length(bent) > 0.f ? bent : direction;
}

void SceneObject::Rotate(const glm::vec3& axis, float radians) {
    rotation = glm::angleAxis(radians, glm::normalize(axis)) * rotation;
}

glm::mat4 SceneObject::GetObjectToWorldMatrix() const {
    return glm::translate(glm::mat4(1.f), glm::vec3(position)) * glm::mat4_cast(rotation) *
           glm::scale(glm::mat4(1.f), glm::vec3(scale));
}
glm::mat4 SceneObject::GetWorldToObjectMatrix() const {
    return glm::inverse(GetObjectToWorldMatrix());
}

namespace {

glm::vec4 turned(const glm::quat& rotation, float x, float y, float z) {
    return glm::vec4(rotation * glm::vec3(x, y, z), 0.f);
}

} // namespace

glm::vec4 SceneObject::GetForwardDirection() const { return turned(rotation, 0.f, 0.f, -1.f); }
glm::vec4 SceneObject::GetUpDirection() const { return turned(rotation, 0.f, 1.f, 0.f); }
glm::vec4 SceneObject::GetRightDirection() const { return turned(rotation, 1.f, 0.f, 0.f); }
