// Stand-in for the course framework's common/common.h: the standard headers, glm and the constants
// that the two handed-in files rely on.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cfloat>
#include <climits>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <stdint.h>
#include <string>
#include <unordered_map>
#include <vector>

// glm 0.9.7, which the framework uses, sets every vector to zero. Newer versions ask for this.
#ifndef GLM_FORCE_CTOR_INIT
#define GLM_FORCE_CTOR_INIT
#endif
#ifndef GLM_ENABLE_EXPERIMENTAL
#define GLM_ENABLE_EXPERIMENTAL
#endif
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/gtx/quaternion.hpp>
#include <glm/gtx/string_cast.hpp>

// A variable, so that a student may still define a PI of their own.
#ifndef PI
static const float PI = 3.14159265358979f;
#endif
#define LARGE_EPSILON 1e-5f
#define SMALL_EPSILON 1e-7f

#if __cplusplus < 201402L
template <class T, class... Arguments>
std::unique_ptr<T> make_unique(Arguments&&... arguments) {
    return std::unique_ptr<T>(new T(std::forward<Arguments>(arguments)...));
}
#else
using std::make_unique;
#endif
