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
/// Lowest eyes in metres.
constexpr double kLowestEyes = 0.05;
/// Heights above the floor, for each metre of the height of the eyes, which somebody who begins to walk
/// keeps.
constexpr double kLeastKept = 0.7;
constexpr double kMostKept = 1.25;
/// A scene of a smaller diagonal in metres is a model; its visitors' eyes are at this part of its height.
constexpr double kModelSize = 2.5;
constexpr double kModelEyes = 0.45;

}  // namespace

Walker::Walker(scene::Camera camera, const base::Box& bounds) : camera_(std::move(camera)) {
    const double diagonal = bounds.diagonal();
    if (diagonal > 0.0) {
        // A person's pace in a building; small models and landscapes are crossed in about ten seconds.
        speed = std::clamp(1.5, diagonal / 12.0, diagonal / 4.0);
        if (diagonal < kModelSize) {
            eyeHeight = std::clamp(kModelEyes * bounds.size().y, kLowestEyes, eyeHeight);
        }
    }
    takeAngles();
}

void Walker::jumpTo(const scene::Camera& camera) {
    camera_ = camera;
    body_.lift();
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

bool Walker::update(const WalkInput& input, double seconds, const Walls* walls) {
    const bool turns = input.turn != 0.0 || input.tilt != 0.0;
    const bool moves = input.ahead != 0.0 || input.right != 0.0 || input.up != 0.0;
    if (turns) {
        yaw_ -= input.turn;
        pitch_ = std::clamp(pitch_ + input.tilt, -kSteepest, kSteepest);
        camera_.forward =
            Vec3d(-std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_), -std::cos(yaw_) * std::cos(pitch_));
        camera_.up = Vec3d(0.0, 1.0, 0.0);
    }
    const bool walks = movement == Movement::walk;
    Vec3d step(0.0);
    if (moves) {
        const Vec3d level(-std::sin(yaw_), 0.0, -std::cos(yaw_));
        const Vec3d right(std::cos(yaw_), 0.0, -std::sin(yaw_));
        Vec3d direction = (walks ? level : camera_.forward) * input.ahead + right * input.right;
        if (const double length = glm::length(direction); length > 1.0) {
            direction /= length;
        }
        const double pace = speed * (input.fast ? 3.0 : 1.0) * (input.slow ? 0.25 : 1.0) * seconds;
        step = direction * pace;
        if (walks) {
            eyeHeight = std::max(kLowestEyes, eyeHeight + input.up * pace);
        } else {
            step.y += input.up * pace;
        }
    }
    if (walks) {
        return walk(step, seconds, walls) || turns;
    }
    body_.lift();
    camera_.position += step;
    return turns || moves;
}

bool Walker::walk(const Vec3d& step, double seconds, const Walls* walls) {
    if (walls == nullptr) {
        camera_.position += step;
        return step != Vec3d(0.0);
    }
    if (!body_.isOnGround()) {
        const auto ground = Body::findGround(*walls, camera_.position);
        const double present = camera_.position.y - ground.value_or(camera_.position.y);
        if (present > kLeastKept * eyeHeight && present < kMostKept * eyeHeight) {
            eyeHeight = present;
        }
    }
    return body_.move(*walls, camera_.position, step, seconds, eyeHeight);
}

}  // namespace fluxwalk::ui
