// What the harness is to do, read from a file.
//
// A plan has one item a line:
//
//   scene                                   begins the next scene, numbered from 0
//   object NAME r g b                       an object with its diffuse response
//   triangle 9 floats, 3 floats             corners and normal; belongs to the object before
//   light x y z r g b                       a point light: the student's PointLight
//   emit SCENE CALLS COUNT numbers          a step: asks light 0 for rays
//   trace SCENE CALLS PATH REMAINING RAYS 6 floats each COUNT numbers
//                                           a step: traces photons along these rays, in turn
//   around-light SCENE CALLS                a step: counts the directions of these rays
//   around SCENE CALLS PATH ... numbers     as trace, but counts the directions of second rays
//   whole SCENE PHOTONS                     a step: the whole run
//
// COUNT numbers, in units of 2^-24, are drawn before the reference's own.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/Scene/Scene.h"

namespace photon_check {

struct Step {
    enum Kind { emit, trace, around_light, around, whole } kind;
    std::size_t scene;
    std::uint64_t calls;
    std::size_t path;
    int remaining;
    std::vector<Ray> rays;
    std::vector<std::uint32_t> numbers;
};

struct LightData {
    glm::vec3 position, color;
};

struct Plan {
    std::vector<std::shared_ptr<Scene>> scenes;
    std::vector<std::vector<LightData>> lights;
    std::vector<Step> steps;
};

bool read_plan(const char* path, Plan& plan);

} // namespace photon_check
