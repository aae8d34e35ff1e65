// What no header of a student's changes, in one unit: glm is read once. The first begins with
// common.h, which may be precompiled.
#include "scene.cpp"

#include "around.cpp"
#include "guard.cpp"
#include "plan.cpp"
#include "random.cpp"
#include "recorder.cpp"
