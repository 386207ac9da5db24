#pragma once

#include "core/base/vec.h"

namespace fluxwalk::scene {

/// A place where irradiance is asked for: a point with a unit normal, on a surface or in free space.
struct Sensor {
    base::Vec3d position{0.0};
    base::Vec3d normal{0.0, 1.0, 0.0};
};

}  // namespace fluxwalk::scene
