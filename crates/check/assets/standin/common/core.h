// Stand-in for the framework's header that includes most others.
#pragma once

#include "common/common.h"

#include "common/Intersection/IntersectionState.h"
#include "common/Rendering/Material/Material.h"
#include "common/Rendering/Renderer.h"
#include "common/Sampling/ColorSampler.h"
#include "common/Scene/Camera/Perspective/PerspectiveCamera.h"
#include "common/Scene/Geometry/Mesh/MeshObject.h"
#include "common/Scene/Geometry/Primitives/Primitive.h"
#include "common/Scene/Geometry/Ray/Ray.h"
#include "common/Scene/Lights/Light.h"
#include "common/Scene/Scene.h"
#include "common/Scene/SceneObject.h"
