// All of the harness in one unit: glm is read once.
#include "harness.cpp"

#include "guard.cpp"
#include "random.cpp"
#include "recorder.cpp"
#include "scene.cpp"
