#include "core/scene/camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "core/base/check.h"
#include "core/base/photometry.h"

namespace fluxwalk::scene {
namespace {

constexpr double kFarthest = 1e6;
constexpr double kLeastFov = 0.1 * base::kPi / 180.0;
constexpr double kLargestFov = 179.9 * base::kPi / 180.0;
/// Sine of the least angle between where a camera looks and what is up.
constexpr double kLeastTurn = 1e-6;

/// All of a camera that moves: place, orientation, field of view.
using Values = std::array<double, 8>;

bool isFinite(const Vec3d& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Values valuesOf(const Camera& camera) {
    const Vec3d right = glm::normalize(glm::cross(camera.forward, camera.up));
    const glm::dmat3 axes(right, glm::cross(right, camera.forward), -camera.forward);
    const glm::dquat q = glm::quat_cast(axes);
    return {camera.position.x, camera.position.y, camera.position.z, q.x, q.y, q.z, q.w, camera.verticalFov};
}

/// Of a rotation and its negative, which mean the same, the one nearer to another.
void alignTo(const Values& other, Values& values) {
    double dot = 0.0;
    for (std::size_t i = 3; i < 7; ++i) {
        dot += values[i] * other[i];
    }
    for (std::size_t i = 3; i < 7 && dot < 0.0; ++i) {
        values[i] = -values[i];
    }
}

/// Slope at the middle one of three values, from the slopes of the two stretches and their lengths: zero at a
/// turning point, else their weighted harmonic mean, which keeps the cubic monotone (Fritsch and Butland
/// 1984).
double slopeBetween(double before, double after, double lengthBefore, double lengthAfter) {
    if (before * after <= 0.0) {
        return 0.0;
    }
    const double a = 2.0 * lengthAfter + lengthBefore;
    const double b = lengthAfter + 2.0 * lengthBefore;
    return (a + b) / (a / before + b / after);
}

}  // namespace

std::optional<std::string> findFault(const Camera& camera) {
    if (!isFinite(camera.position) || !isFinite(camera.forward) || !isFinite(camera.up)) {
        return "has numbers that are not finite";
    }
    const Vec3d place = glm::abs(camera.position);
    if (std::max({place.x, place.y, place.z}) > kFarthest) {
        return "lies more than 1e6 m from the origin";
    }
    const double forward = glm::length(camera.forward);
    const double up = glm::length(camera.up);
    if (!(std::abs(forward - 1.0) < 1e-3)) {
        return "looks along a direction that has not unit length";
    }
    if (!(up > 0.0 && glm::length(glm::cross(camera.forward, camera.up)) > kLeastTurn * up)) {
        return "looks along what is up";
    }
    if (!(camera.verticalFov >= kLeastFov && camera.verticalFov <= kLargestFov)) {
        return "has a field of view outside .1 to 179.9 degrees";
    }
    return std::nullopt;
}

double durationOf(const CameraPath& path) {
    return path.empty() ? 0.0 : path.back().seconds - path.front().seconds;
}

Camera cameraAt(const CameraPath& path, double seconds) {
    FLUXWALK_CHECK(!path.empty());
    const double time = path.front().seconds + seconds;
    const auto after = std::upper_bound(path.begin(), path.end(), time,
                                        [](double t, const CameraKey& key) { return t < key.seconds; });
    if (after == path.begin()) {
        return path.front().camera;
    }
    if (after == path.end()) {
        return path.back().camera;
    }
    // Four keys: the two around the time and their neighbours; at the ends of the path these are doubled.
    const auto i = static_cast<std::ptrdiff_t>(after - path.begin());
    std::array<Values, 4> values{};
    std::array<double, 4> times{};
    for (std::ptrdiff_t k = 0; k < 4; ++k) {
        const auto key =
            std::clamp<std::ptrdiff_t>(i - 2 + k, 0, static_cast<std::ptrdiff_t>(path.size()) - 1);
        const CameraKey& from = path[static_cast<std::size_t>(key)];
        values[static_cast<std::size_t>(k)] = valuesOf(from.camera);
        times[static_cast<std::size_t>(k)] = from.seconds;
    }
    alignTo(values[1], values[0]);
    alignTo(values[1], values[2]);
    alignTo(values[2], values[3]);
    const double length = times[2] - times[1];
    const double t = (time - times[1]) / length;
    Values now{};
    for (std::size_t c = 0; c < now.size(); ++c) {
        const auto slope = [&](std::size_t k) {
            return times[k + 1] > times[k] ? (values[k + 1][c] - values[k][c]) / (times[k + 1] - times[k])
                                           : 0.0;
        };
        const double start = slopeBetween(slope(0), slope(1), times[1] - times[0], length) * length;
        const double end = slopeBetween(slope(1), slope(2), length, times[3] - times[2]) * length;
        const double a = values[1][c];
        const double b = values[2][c];
        now[c] =
            a + t * (start + t * (3.0 * (b - a) - 2.0 * start - end + t * (2.0 * (a - b) + start + end)));
    }
    Camera camera = path[static_cast<std::size_t>(i - 1)].camera;
    camera.position = {now[0], now[1], now[2]};
    const glm::dmat3 axes = glm::mat3_cast(glm::normalize(glm::dquat(now[6], now[3], now[4], now[5])));
    camera.forward = -axes[2];
    camera.up = axes[1];
    camera.verticalFov = now[7];
    return camera;
}

}  // namespace fluxwalk::scene
