#pragma once

#include "viewer/ui/body.h"

namespace fluxwalk::ui {

/// The part of a body that must not touch anything: an upright cylinder about the vertical through the eyes,
/// which is known to be free from `low` to the eyes.
struct Torso {
    base::Vec3d eye{0.0};
    double low = 0.0;  ///< height (y) of its lower end
    double radius = 0.0;
    double clearance = 0.0;  ///< from the eyes to its upper end
};

/// Distance in metres to the first thing met along a unit direction, nothing beyond `far`.
std::optional<double> distanceAlong(const Walls& walls, const base::Vec3d& from, const base::Vec3d& direction,
                                    double far);

/// How far a torso comes that wants to go by `step` (level, shorter than its radius): up to what is in the
/// way, and what remains of the step along that.
base::Vec3d slide(const Walls& walls, const Torso& torso, const base::Vec3d& step);

}  // namespace fluxwalk::ui
