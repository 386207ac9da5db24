#pragma once

#include <functional>
#include <optional>

#include "core/base/bounds.h"
#include "core/scene/scene.h"

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

/// Height of the floor below a point in metres (its y), if there is one.
using FindFloor = std::function<std::optional<double>(const base::Vec3d&)>;

/// The visitor: a camera that walks or flies through the scene.
class Walker {
  public:
    /// Starts at `camera`. Speeds follow the scene's size.
    Walker(scene::Camera camera, const base::Box& bounds);

    void jumpTo(const scene::Camera& camera);
    /// Moves by `seconds` of input. Returns whether the camera changed.
    bool update(const WalkInput& input, double seconds, const FindFloor& findFloor);

    /// The view now; exactly the given camera until the visitor moves.
    const scene::Camera& camera() const { return camera_; }

    /// Radians.
    double verticalFov() const { return camera_.verticalFov; }
    void setVerticalFov(double radians) { camera_.verticalFov = radians; }

    Movement movement = Movement::fly;
    /// Metres above the floor when walking.
    double eyeHeight = 1.65;
    /// Metres a second.
    double speed = 1.5;

  private:
    void takeAngles();

    scene::Camera camera_;
    /// Whether the height of the eyes was taken since walking began.
    bool isOnFeet_ = false;
    double yaw_ = 0.0;    ///< radians about +y, 0 looks along -z
    double pitch_ = 0.0;  ///< radians above the horizon
};

}  // namespace fluxwalk::ui
