// Stand-in for the header beside PhotonMappingRenderer.cpp, for those who do not hand it in.
#pragma once

#include "common/Scene/Geometry/Ray/Ray.h"

struct Photon {
    typedef float value_type;

    float operator[](size_t axis) const { return position[static_cast<int>(axis)]; }

    glm::vec3 position;
    glm::vec3 intensity;
    Ray toLightRay;
};

struct PhotonAccessor {
    typedef float result_type;
    float operator()(const Photon& photon, size_t axis) const { return photon[axis]; }
};
