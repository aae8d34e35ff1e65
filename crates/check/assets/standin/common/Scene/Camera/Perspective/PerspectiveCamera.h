// Stand-in: a camera. No picture is taken here.
#pragma once

#include "common/Scene/Camera/Camera.h"

class PerspectiveCamera : public Camera {};
