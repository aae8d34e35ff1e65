// Stand-in: a camera. No picture is taken here.
#pragma once

#include "common/Scene/SceneObject.h"

class Camera : public SceneObject {};
