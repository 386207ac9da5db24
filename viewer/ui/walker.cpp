#include "viewer/ui/walker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/photometry.h"

namespace fluxwalk::ui {
namespace {

using base::Vec3d;

/// Just short of straight up and down, where "ahead" loses its meaning.
constexpr double kSteepest = 0.499 * base::kPi;
/// Seconds in which the eye follows steps of the floor.
constexpr double kStepTime = 0.12;
/// Metres above the floor between which somebody who begins to walk keeps the height of the eyes.
constexpr double kLowestEyes = 0.05;
constexpr double kHighestEyes = 2.5;

}  // namespace

Walker::Walker(scene::Camera camera, const base::Box& bounds) : camera_(std::move(camera)) {
    const double diagonal = bounds.diagonal();
    if (diagonal > 0.0) {
        // A person's pace in a building; small models and landscapes are crossed in about ten seconds.
        speed = std::clamp(1.5, diagonal / 12.0, diagonal / 4.0);
    }
    takeAngles();
}

void Walker::jumpTo(const scene::Camera& camera) {
    camera_ = camera;
    takeAngles();
}

void Walker::takeAngles() {
    const Vec3d& f = camera_.forward;
    pitch_ = std::asin(std::clamp(f.y, -1.0, 1.0));
    // Looking straight down or up, the top of the picture tells which way is ahead.
    const Vec3d ahead = std::abs(f.y) < 0.9999 ? f : camera_.up * (f.y > 0.0 ? -1.0 : 1.0);
    yaw_ = std::atan2(-ahead.x, -ahead.z);
    pitch_ = std::clamp(pitch_, -kSteepest, kSteepest);
}

bool Walker::update(const WalkInput& input, double seconds, const FindFloor& findFloor) {
    const bool turns = input.turn != 0.0 || input.tilt != 0.0;
    const bool moves = input.ahead != 0.0 || input.right != 0.0 || input.up != 0.0;
    if (turns) {
        yaw_ -= input.turn;
        pitch_ = std::clamp(pitch_ + input.tilt, -kSteepest, kSteepest);
        camera_.forward =
            Vec3d(-std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_), -std::cos(yaw_) * std::cos(pitch_));
        camera_.up = Vec3d(0.0, 1.0, 0.0);
    }
    bool changed = turns;
    if (moves) {
        const bool walks = movement == Movement::walk;
        const Vec3d level(-std::sin(yaw_), 0.0, -std::cos(yaw_));
        const Vec3d right(std::cos(yaw_), 0.0, -std::sin(yaw_));
        Vec3d direction = (walks ? level : camera_.forward) * input.ahead + right * input.right;
        if (const double length = glm::length(direction); length > 1.0) {
            direction /= length;
        }
        const double pace = speed * (input.fast ? 3.0 : 1.0) * (input.slow ? 0.25 : 1.0) * seconds;
        camera_.position += direction * pace;
        if (walks) {
            eyeHeight = std::max(kLowestEyes, eyeHeight + input.up * pace);
        } else {
            camera_.position.y += input.up * pace;
        }
        changed = true;
    }
    if (movement == Movement::fly) {
        isOnFeet_ = false;
    } else {
        if (const auto floor = findFloor ? findFloor(camera_.position) : std::nullopt) {
            const double present = camera_.position.y - *floor;
            if (!isOnFeet_ && present > kLowestEyes && present < kHighestEyes) {
                eyeHeight = present;
            }
            isOnFeet_ = true;
            const double wanted = *floor + eyeHeight;
            const double missing = wanted - camera_.position.y;
            if (std::abs(missing) > 1e-4) {
                camera_.position.y += missing * (1.0 - std::exp(-seconds / kStepTime));
                changed = true;
            }
        }
    }
    return changed;
}

}  // namespace fluxwalk::ui
