// All of the harness in one unit: glm is read once.
#include "harness.cpp"

#include "around.cpp"
#include "guard.cpp"
#include "random.cpp"
#include "recorder.cpp"
#include "scene.cpp"
