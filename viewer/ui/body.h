#pragma once

#include <optional>

#include "core/rays/ray_scene.h"

namespace fluxwalk::ui {

/// What a visitor stands on and bumps into. `rays` are those of `scene`.
struct Walls {
    const scene::Scene* scene = nullptr;
    const rays::RayScene* rays = nullptr;
};

/// What a person of a given height is able to do, in metres and seconds.
struct Build {
    double radius = 0.0;      ///< of the body, an upright cylinder
    double step = 0.0;        ///< highest step that is climbed or descended without a fall
    double clearance = 0.0;   ///< kept between the eyes and what is above
    double gravity = 0.0;     ///< m/s2
    double swiftestFall = 0;  ///< m/s
};

/// Sizes for eyes at this height: 24 cm of radius and steps of 26 cm for 1.6 m, less for smaller visitors.
Build buildFor(double eyeHeight);

/// The body below the eyes. It stops at walls and slides along them, climbs and descends steps, falls off
/// edges, and bends below low ceilings. All is found by rays around it, and every movement is cut into pieces
/// shorter than what the rays may miss, so that slow frames lead through nothing.
class Body {
  public:
    /// Forgets where the feet are: the ground is found anew by the next movement.
    void lift() {
        foot_.reset();
        fallSpeed_ = 0.0;
    }
    /// Whether the feet have found ground since the last lift().
    bool isOnGround() const { return foot_.has_value(); }

    /// Height (y) of what lies below a point, if anything does.
    static std::optional<double> findGround(const Walls& walls, const base::Vec3d& point);

    /// Moves `eye` by `step` (level, metres) as far as the way is free, and lets it follow the ground for
    /// `seconds`. Over nothing at all the height stays. Returns whether the eye moved.
    bool move(const Walls& walls, base::Vec3d& eye, const base::Vec3d& step, double seconds,
              double eyeHeight);

  private:
    void follow(const Walls& walls, const base::Vec3d& eye, const Build& build);

    /// Height of the feet.
    std::optional<double> foot_;
    /// Height of what is below them.
    std::optional<double> ground_;
    double fallSpeed_ = 0.0;
};

}  // namespace fluxwalk::ui
