// Stand-in: photon maps need no sampler of pixels.
#pragma once

#include "common/common.h"

class ColorSampler : public std::enable_shared_from_this<ColorSampler> {
public:
    virtual ~ColorSampler() {}
};
