#pragma once

#include "common/common.h"
#include <cstdlib>

namespace hw8 {

// [0, 1)
inline float unit() { float u; do { u = static_cast<float>(rand() / (1.0 + RAND_MAX)); } while (u >= 1.f); return u; }

// Shirley and Chiu's map from the square to the disk, lifted to the hemisphere
inline glm::vec3 concentricCosine(float u1, float u2)
{
    const float a = 2.f * u1 - 1.f, b = 2.f * u2 - 1.f;
    float r = 0.f, phi = 0.f;
    if (a * a > b * b) { r = a; phi = (PI / 4.f) * (b / a); }
    else if (b != 0.f) { r = b; phi = (PI / 2.f) - (PI / 4.f) * (a / b); }
    return glm::normalize(glm::vec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.f, 1.f - r * r))));
}

// Rodrigues' formula for the turn that takes +z to n
inline glm::vec3 rotateUpTo(const glm::vec3& n, const glm::vec3& v)
{
    const glm::vec3 z(0.f, 0.f, 1.f), k = glm::cross(z, n);
    const float c = n.z;
    if (c < -0.9999f) { return glm::vec3(v.x, -v.y, -v.z); }
    return glm::normalize(c * v + glm::cross(k, v) + k * (glm::dot(k, v) / (1.f + c)));
}

}
