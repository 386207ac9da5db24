#pragma once

#include "core/base/vec.h"

namespace fluxwalk::rays {

/// Part of a line: origin + t * direction for t in (tNear, tFar). The direction need not have unit length.
struct Ray {
    base::Vec3 origin{};
    float tNear = 0.0f;
    base::Vec3 direction{};
    float tFar = 1.0f;
};

}  // namespace fluxwalk::rays
