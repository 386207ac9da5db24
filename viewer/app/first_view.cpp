#include "viewer/app/first_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/photometry.h"
#include "core/surface/polygon_mesh.h"
#include "viewer/render/camera.h"

namespace fluxwalk::app {
namespace {

using base::kPi;
using base::Vec3d;

constexpr double kEyeHeight = 1.65;
/// Part of all directions that must meet something for a place to count as indoors, and its mean over all
/// places under a roof: a box with an open side is a stage to look into, however closed it is at its back.
constexpr double kClosed = 0.9;
constexpr double kClosedOnAverage = 0.85;
constexpr double kInsideFov = 65.0;
constexpr double kOutsideFov = 40.0;
constexpr int kDirections = 256;

/// Distance to the first thing met, or nothing.
std::optional<double> distanceAlong(const rays::RayScene& rays, const Vec3d& from, const Vec3d& direction) {
    const auto hit =
        rays.closest({base::Vec3(from), 0.0f, base::Vec3(direction), std::numeric_limits<float>::max()});
    return hit ? std::optional(static_cast<double>(hit->t)) : std::nullopt;
}

/// What the surroundings of a place look like.
struct Surroundings {
    double closedness = 0.0;  ///< part of the directions that meet something
    double roominess = 0.0;   ///< mean free distance over those
    double frontness = 0.0;   ///< part of those that meet it from the front of its surface
    Vec3d opening{0.0};       ///< mean of the directions that meet nothing
};

Surroundings lookAround(const rays::RayScene& rays, const Vec3d& from) {
    Surroundings result;
    int met = 0;
    for (int i = 0; i < kDirections; ++i) {
        // Even points on the sphere: a spiral by the golden angle.
        const double y = 1.0 - (2.0 * i + 1.0) / kDirections;
        const double angle = i * kPi * (3.0 - std::sqrt(5.0));
        const double r = std::sqrt(1.0 - y * y);
        const Vec3d direction(r * std::cos(angle), y, r * std::sin(angle));
        const auto hit =
            rays.closest({base::Vec3(from), 0.0f, base::Vec3(direction), std::numeric_limits<float>::max()});
        if (hit) {
            ++met;
            result.roominess += static_cast<double>(hit->t);
            result.frontness += hit->back ? 0.0 : 1.0;
        } else {
            result.opening += direction;
        }
    }
    result.closedness = static_cast<double>(met) / kDirections;
    result.roominess /= std::max(met, 1);
    result.frontness /= std::max(met, 1);
    result.opening /= std::max(kDirections - met, 1);
    return result;
}

/// Roomiest of a grid of places at eye height that are indoors. Hollows behind surfaces count half: below a
/// floor there may be a closed space too.
std::optional<Vec3d> findIndoors(const rays::RayScene& rays, const base::Box& bounds) {
    const Vec3d size = bounds.size();
    constexpr int kGrid = 5;
    std::optional<Vec3d> best;
    double bestRoominess = 0.0;
    double closedness = 0.0;
    int roofed = 0;
    // Two heights, neither of which is likely to be that of a floor.
    constexpr std::array<double, 2> kHeights{0.31, 0.57};
    for (int x = 0; x < kGrid; ++x) {
        for (int k = 0; k < 2 * kGrid; ++k) {
            const int z = k / 2;
            const double y = kHeights[static_cast<std::size_t>(k % 2)];
            Vec3d place = bounds.lower + size * Vec3d((x + 0.5) / kGrid, y, (z + 0.5) / kGrid);
            const auto floor = distanceAlong(rays, place, {0.0, -1.0, 0.0});
            const auto ceiling = distanceAlong(rays, place, {0.0, 1.0, 0.0});
            if (!floor || !ceiling) {
                continue;
            }
            const double height = *floor + *ceiling;
            place.y += -*floor + std::min(kEyeHeight, 0.55 * height);
            const Surroundings seen = lookAround(rays, place);
            closedness += seen.closedness;
            ++roofed;
            const double roominess = seen.roominess * (0.5 + 0.5 * seen.frontness);
            if (seen.closedness >= kClosed && roominess > bestRoominess) {
                best = place;
                bestRoominess = roominess;
            }
        }
    }
    return closedness >= kClosedOnAverage * roofed ? best : std::nullopt;
}

scene::Camera insideView(const rays::RayScene& rays, const Vec3d& place) {
    constexpr int kHeadings = 48;
    Vec3d bestDirection(0.0, 0.0, -1.0);
    double bestAhead = 0.0;
    double bestBehind = 0.0;
    for (int i = 0; i < kHeadings; ++i) {
        const double angle = 2.0 * kPi * i / kHeadings;
        const Vec3d direction(std::cos(angle), 0.0, std::sin(angle));
        const double ahead = distanceAlong(rays, place, direction).value_or(0.0);
        const double behind = distanceAlong(rays, place, -direction).value_or(0.0);
        if (ahead + behind > bestAhead + bestBehind) {
            bestDirection = direction;
            bestAhead = ahead;
            bestBehind = behind;
        }
    }
    const Vec3d eye = place - bestDirection * (0.85 * bestBehind);
    // Slightly down: floors and what stands on them say more than ceilings.
    return render::lookAt(eye, eye + bestDirection - Vec3d(0.0, 0.08, 0.0), kInsideFov);
}

/// From `direction` of the box's centre, so far that all of the box is in a square picture.
scene::Camera outsideView(const base::Box& bounds, const Vec3d& direction) {
    const double radius = 0.5 * std::max(bounds.diagonal(), 1e-6);
    const double distance = radius / std::sin(0.5 * kOutsideFov * kPi / 180.0);
    return render::lookAt(bounds.center() + direction * distance, bounds.center(), kOutsideFov);
}

}  // namespace

scene::Camera chooseFirstView(const rays::RayScene& rays, const base::Box& bounds) {
    if (bounds.isEmpty()) {
        return render::lookAt(Vec3d(0.0, 0.0, 1.0), Vec3d(0.0), kOutsideFov);
    }
    if (const auto place = findIndoors(rays, bounds)) {
        return insideView(rays, *place);
    }
    const Surroundings center = lookAround(rays, bounds.center());
    const double concentration = glm::length(center.opening);
    const bool hasOpening =
        center.closedness > 0.5 && concentration > 0.6 && std::abs(center.opening.y) < 0.5 * concentration;
    return outsideView(bounds,
                       hasOpening ? center.opening / concentration : glm::normalize(Vec3d(0.62, 0.48, 0.78)));
}

scene::Scene sceneOfMeshes(const scene::LitMeshes& meshes) {
    scene::Scene result;
    result.materials.emplace_back();
    for (const auto& mesh : meshes) {
        surface::TriangleSoup soup;
        soup.positions = mesh->positions;
        for (std::size_t t = 0; t + 2 < mesh->triangles.size(); t += 3) {
            soup.triangles.push_back({mesh->triangles[t], mesh->triangles[t + 1], mesh->triangles[t + 2]});
        }
        result.objects.push_back({"", std::make_shared<surface::PolygonMesh>(std::move(soup)), 0});
    }
    return result;
}

}  // namespace fluxwalk::app
