#include "viewer/ui/body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "viewer/ui/body_sweep.h"

namespace fluxwalk::ui {
namespace {

using base::Vec3d;

constexpr double kAdultEyes = 1.6;
/// Seconds in which the eyes follow steps of the floor.
constexpr double kStepTime = 0.12;
/// Differences of height that nobody sees, metres.
constexpr double kLevel = 1e-4;
/// Longest piece of a movement, metres: handrails are wider.
constexpr double kLongestPiece = 0.06;
/// Pieces of one frame; what is faster is slowed down.
constexpr int kMostPieces = 100;
/// The foot stands on what is below this part of the body's radius.
constexpr double kSole = 0.5;

}  // namespace

Build buildFor(double eyeHeight) {
    Build build;
    build.radius = std::min(0.24, 0.15 * eyeHeight);
    build.step = std::min(0.26, 0.25 * eyeHeight);
    build.clearance = std::min(0.1, 0.06 * eyeHeight);
    const double scale = std::min(1.0, eyeHeight / kAdultEyes);
    build.gravity = 9.81 * scale;
    build.swiftestFall = 8.0 * scale;
    return build;
}

std::optional<double> Body::findGround(const Walls& walls, const Vec3d& point) {
    const auto distance = distanceAlong(walls, point, {0.0, -1.0, 0.0}, std::numeric_limits<float>::max());
    return distance ? std::optional(point.y - *distance) : std::nullopt;
}

// What the feet stand on after a piece of a movement: the highest thing below the sole that a step reaches.
void Body::follow(const Walls& walls, const Vec3d& eye, const Build& build) {
    ground_ = findGround(walls, eye);
    if (!foot_) {
        foot_ = ground_;
    }
    if (!foot_) {
        return;
    }
    const Vec3d knee(eye.x, std::min(eye.y, *foot_ + build.step), eye.z);
    const double reach = kSole * build.radius;
    constexpr std::array<std::array<double, 2>, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& [x, z] : kSides) {
        const Vec3d aside(x, 0.0, z);
        if (!distanceAlong(walls, knee, aside, reach)) {
            const auto below = findGround(walls, knee + reach * aside);
            if (below && (!ground_ || *below > *ground_)) {
                ground_ = below;
            }
        }
    }
    if (ground_ && *ground_ > *foot_ - build.step - kLevel) {
        foot_ = ground_;
        fallSpeed_ = 0.0;
    }
}

bool Body::move(const Walls& walls, Vec3d& eye, const Vec3d& step, double seconds, double eyeHeight) {
    const Build build = buildFor(eyeHeight);
    const Vec3d before = eye;
    if (!foot_) {
        follow(walls, eye, build);
    }
    const double length = glm::length(step);
    const double longest = std::min(kLongestPiece, 0.25 * build.radius);
    const int pieces = static_cast<int>(std::min<double>(kMostPieces, std::ceil(length / longest)));
    for (int i = 0; i < pieces; ++i) {
        const double low = std::min(eye.y, foot_.value_or(eye.y - eyeHeight) + 1.04 * build.step);
        eye += slide(walls, {eye, low, build.radius, build.clearance},
                     step * (std::min(length, pieces * longest) / (length * pieces)));
        follow(walls, eye, build);
    }
    if (pieces == 0) {
        follow(walls, eye, build);
    }
    if (!foot_) {
        return eye != before;
    }
    if (ground_ && *foot_ > *ground_) {
        fallSpeed_ = std::min(fallSpeed_ + build.gravity * seconds, build.swiftestFall);
        foot_ = std::max(*ground_, *foot_ - fallSpeed_ * seconds);
    }
    double wanted = *foot_ + eyeHeight;
    const double headroom = eyeHeight + build.clearance;
    if (const auto above = distanceAlong(walls, eye, {0.0, 1.0, 0.0}, headroom)) {
        const double ceiling = eye.y + *above;
        wanted = std::min(wanted, std::max(ceiling - build.clearance, 0.5 * (*foot_ + ceiling)));
    }
    const double missing = wanted - eye.y;
    if (std::abs(missing) > kLevel) {
        eye.y += missing * (1.0 - std::exp(-seconds / kStepTime));
    }
    return eye != before;
}

}  // namespace fluxwalk::ui
