#pragma once

#include "core/base/bounds.h"
#include "core/scene/scene.h"
#include "viewer/ui/body.h"

namespace fluxwalk::ui {

enum class Movement : std::uint8_t {
    walk,  ///< on the floor, eyes at their height
    fly    ///< along the view
};

/// What the user asks for in one frame. Axes are in [-1, 1].
struct WalkInput {
    double ahead = 0.0;
    double right = 0.0;
    double up = 0.0;
    bool fast = false;
    bool slow = false;
    /// Turned by the mouse, radians: to the right and upwards.
    double turn = 0.0;
    double tilt = 0.0;
};

/// The visitor: a camera that walks or flies through the scene.
class Walker {
  public:
    /// Starts at `camera`. Speeds follow the scene's size, and the eyes of a visitor to a small model are
    /// low.
    Walker(scene::Camera camera, const base::Box& bounds);

    void jumpTo(const scene::Camera& camera);
    /// Moves by `seconds` of input. Who walks stands on `walls` and stops at them; null while they are not
    /// known: then nothing is in the way. Returns whether the camera changed.
    bool update(const WalkInput& input, double seconds, const Walls* walls);

    /// The view now; exactly the given camera until the visitor moves.
    const scene::Camera& camera() const { return camera_; }

    /// Radians.
    double verticalFov() const { return camera_.verticalFov; }
    void setVerticalFov(double radians) { camera_.verticalFov = radians; }

    Movement movement = Movement::fly;
    /// Metres above the floor when walking.
    double eyeHeight = 1.6;
    /// Metres a second.
    double speed = 1.5;

  private:
    void takeAngles();
    bool walk(const base::Vec3d& step, double seconds, const Walls* walls);

    scene::Camera camera_;
    Body body_;
    double yaw_ = 0.0;    ///< radians about +y, 0 looks along -z
    double pitch_ = 0.0;  ///< radians above the horizon
};

}  // namespace fluxwalk::ui
