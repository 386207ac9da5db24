#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/display/display_mesh.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/sphere.h"

/// Surfaces, quadtrees and irradiances that tests and benchmarks of the display share.
namespace fluxwalk::display {

using Irradiance = std::function<double(const Vec3d&)>;

/// A horizontal square [0, size]^2 at y = 0, facing up, of n x n quad patches.
inline std::shared_ptr<const surface::PolygonMesh> makeFloor(unsigned n, float size) {
    surface::TriangleSoup soup;
    for (unsigned j = 0; j <= n; ++j) {
        for (unsigned i = 0; i <= n; ++i) {
            soup.positions.emplace_back(size * static_cast<float>(i) / static_cast<float>(n), 0.0f,
                                        size * static_cast<float>(j) / static_cast<float>(n));
        }
    }
    for (unsigned j = 0; j < n; ++j) {
        for (unsigned i = 0; i < n; ++i) {
            const unsigned a = j * (n + 1) + i;
            soup.triangles.push_back({a, a + n + 1, a + n + 2});
            soup.triangles.push_back({a, a + n + 2, a + 1});
        }
    }
    return std::make_shared<surface::PolygonMesh>(std::move(soup));
}

/// The same square as four triangles about a point off its middle.
inline std::shared_ptr<const surface::PolygonMesh> makeTriangleFloor(float size) {
    surface::TriangleSoup soup;
    soup.positions = {
        {0, 0, 0}, {size, 0, 0}, {size, 0, size}, {0, 0, size}, {0.47f * size, 0, 0.55f * size}};
    soup.triangles = {{1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}};
    return std::make_shared<surface::PolygonMesh>(std::move(soup));
}

/// A closed box with its faces outwards, from the origin to `size`: six quad patches.
inline std::shared_ptr<const surface::PolygonMesh> makeBox(const Vec3& size) {
    surface::TriangleSoup soup;
    for (unsigned i = 0; i < 8; ++i) {
        soup.positions.emplace_back((i & 1u) != 0 ? size.x : 0.0f, (i & 2u) != 0 ? size.y : 0.0f,
                                    (i & 4u) != 0 ? size.z : 0.0f);
    }
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& f : kFaces) {
        soup.triangles.push_back({f[0], f[1], f[2]});
        soup.triangles.push_back({f[0], f[2], f[3]});
    }
    return std::make_shared<surface::PolygonMesh>(std::move(soup));
}

/// Means over the leaves of the quadtree that splits where `shouldSplit(patch, path, region)` says.
template <class ShouldSplit>
void addLeaves(const surface::Surface& surface, std::uint32_t patch, surface::Path path,
               const surface::Region& region, const Irradiance& irradiance, const ShouldSplit& shouldSplit,
               std::vector<Leaf>& out, unsigned samples = 8) {
    if (shouldSplit(patch, path, region)) {
        const surface::Split split = surface::splitAt(surface, patch, surface::pathLevel(path));
        for (unsigned k = 0; k < 4; ++k) {
            addLeaves(surface, patch, surface::childPath(path, k),
                      surface::childRegion(surface, patch, region, split, k), irradiance, shouldSplit, out,
                      samples);
        }
        return;
    }
    double sum = 0.0;
    double weights = 0.0;
    for (unsigned i = 0; i < samples; ++i) {
        for (unsigned j = 0; j < samples; ++j) {
            const surface::RegionPoint at =
                surface::mapToRegion(region, {(i + 0.5) / samples, (j + 0.5) / samples});
            const surface::SurfacePoint point = surface.evaluate(patch, at.uv);
            const double weight = at.jacobian * point.jacobian;
            sum += weight * irradiance(point.position);
            weights += weight;
        }
    }
    const auto mean = static_cast<float>(sum / weights);
    out.push_back({patch, false, path, Rgb(mean, 0.5f * mean, 0.25f * mean)});
}

template <class ShouldSplit>
std::vector<Leaf> makeLeaves(const surface::Surface& surface, const Irradiance& irradiance,
                             const ShouldSplit& shouldSplit, unsigned samples = 8) {
    std::vector<Leaf> out;
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        addLeaves(surface, patch, surface::kRootPath, surface::wholePatch(surface.domain(patch)), irradiance,
                  shouldSplit, out, samples);
    }
    return out;
}

/// Splits everything to one level.
struct SplitUniformly {
    unsigned level = 3;
    bool operator()(std::uint32_t /*patch*/, surface::Path path, const surface::Region& /*region*/) const {
        return surface::pathLevel(path) < level;
    }
};

/// Splits at random: neighbours differ by many levels.
struct SplitRandomly {
    std::uint64_t seed = 1;
    unsigned maxLevel = 6;
    double probability = 0.55;
    bool operator()(std::uint32_t patch, surface::Path path, const surface::Region& /*region*/) const {
        const std::uint64_t key = base::combine(base::combine(seed, patch), path);
        return surface::pathLevel(path) < maxLevel && base::toUnit(base::mix(key)) < probability;
    }
};

/// Splits where the range of irradiance over 8 x 8 points, times the square root of the area, is above a
/// threshold: what a power oracle does.
struct SplitByRange {
    const surface::Surface& surface;
    const Irradiance& irradiance;
    double threshold = 0.01;
    unsigned maxLevel = 9;
    bool operator()(std::uint32_t patch, surface::Path path, const surface::Region& region) const {
        if (surface::pathLevel(path) >= maxLevel) {
            return false;
        }
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (unsigned i = 0; i < 8; ++i) {
            for (unsigned j = 0; j < 8; ++j) {
                const surface::RegionPoint at = surface::mapToRegion(region, {(i + 0.5) / 8, (j + 0.5) / 8});
                const double e = irradiance(surface.evaluate(patch, at.uv).position);
                low = std::min(low, e);
                high = std::max(high, e);
            }
        }
        return (high - low) * std::sqrt(surface.area(patch, region)) > threshold;
    }
};

/// Irradiance at the floor from a unit-exitance polygon above it: the vector form of Lambert's formula.
inline double irradianceFromPolygon(const Vec3d& p, const std::vector<Vec3d>& corners) {
    const Vec3d up(0, 1, 0);
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = glm::normalize(corners[i] - p);
        const Vec3d b = glm::normalize(corners[(i + 1) % corners.size()] - p);
        const Vec3d across = glm::cross(a, b);
        const double length = glm::length(across);
        if (length > 0.0) {
            sum += std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * glm::dot(across, up) / length;
        }
    }
    return std::abs(sum) / (2.0 * base::kPi);
}

/// A square metre of light 0.7 m above the floor.
inline double lampIrradiance(const Vec3d& p) {
    return irradianceFromPolygon(p, {{1.2, 0.7, 1.4}, {2.2, 0.7, 1.4}, {2.2, 0.7, 2.4}, {1.2, 0.7, 2.4}});
}

/// A bright patch of the wall x = 0 down to 5 cm above the floor, and some light from elsewhere.
inline double wallIrradiance(const Vec3d& p) {
    return 0.05 + irradianceFromPolygon(p, {{0, 0.05, 1}, {0, 1.2, 1}, {0, 1.2, 3}, {0, 0.05, 3}});
}

inline double smoothStep(double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// The lamp behind an oblique edge with 30 cm of penumbra.
inline double penumbraIrradiance(const Vec3d& p) {
    return lampIrradiance(p) * smoothStep((0.8 * p.x + 0.6 * p.z - 2.5) / 0.3 + 0.5);
}

}  // namespace fluxwalk::display
