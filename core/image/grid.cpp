#include "core/image/grid.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"

namespace fluxwalk::image {

namespace {

using base::Vec2d;
using base::Vec3d;

void requireFew(double count) {
    if (!(count <= static_cast<double>(kMostGridSensors))) {
        throw base::UsageError(fmt::format(
            "--grid: the spacing gives {:.3g} sensors; at most {} are possible", count, kMostGridSensors));
    }
}

// Cells along an extent: at least one.
double cellsAlong(double length, double spacing) {
    return std::max(1.0, std::floor(length / spacing + 1e-9));
}

// Sensors over one patch; `due` is the area in spacings squared that earlier patches left without one.
class PatchGrid {
  public:
    PatchGrid(const surface::Surface& surface, double spacing) : surface_(surface), spacing_(spacing) {}

    void add(std::uint32_t patch, bool back, std::vector<scene::Sensor>& sensors) {
        const surface::Region whole = surface::wholePatch(surface_.domain(patch));
        const double wanted = surface_.area(patch, whole) / (spacing_ * spacing_);
        if (wanted < 1.0) {
            due_ += wanted;
            if (due_ >= 0.5) {
                due_ -= 1.0;
                place(patch, back, surface::mapToRegion(whole, Vec2d(0.5)).uv, sensors);
            }
            return;
        }
        const Vec2d sides = lengths(patch, whole);
        const auto across = static_cast<unsigned>(std::max(1.0, std::round(sides.x / spacing_)));
        const auto along = static_cast<unsigned>(std::max(1.0, std::round(sides.y / spacing_)));
        for (unsigned j = 0; j < along; ++j) {
            for (unsigned i = 0; i < across; ++i) {
                const Vec2d st((i + 0.5) / across, (j + 0.5) / along);
                place(patch, back, surface::mapToRegion(whole, st).uv, sensors);
            }
        }
    }

  private:
    // Of the middle lines along both parameters.
    Vec2d lengths(std::uint32_t patch, const surface::Region& whole) const {
        constexpr unsigned kSteps = 16;
        Vec2d sum(0.0);
        for (int axis = 0; axis < 2; ++axis) {
            Vec3d last(0.0);
            for (unsigned i = 0; i <= kSteps; ++i) {
                Vec2d st(0.5);
                st[axis] = static_cast<double>(i) / kSteps;
                const Vec3d at = surface_.evaluate(patch, surface::mapToRegion(whole, st).uv).position;
                sum[axis] += i > 0 ? glm::distance(at, last) : 0.0;
                last = at;
            }
        }
        return sum;
    }

    void place(std::uint32_t patch, bool back, const Vec2d& uv, std::vector<scene::Sensor>& sensors) const {
        const surface::SurfacePoint p = surface_.evaluate(patch, uv);
        sensors.push_back({p.position, back ? -p.normal : p.normal});
    }

    const surface::Surface& surface_;
    double spacing_;
    double due_ = 0.0;
};

}  // namespace

Grid makePlaneGrid(const scene::Scene& scene, double height, double spacing) {
    const base::Box box = scene.bounds();
    if (!(height >= box.lower.y && height <= box.upper.y)) {
        throw base::UsageError(
            fmt::format("--grid: the plane y={:g} misses the scene, which reaches from y={:g} to {:g}",
                        height, box.lower.y, box.upper.y));
    }
    const Vec3d size = box.upper - box.lower;
    const double columns = cellsAlong(size.x, spacing);
    const double rows = cellsAlong(size.z, spacing);
    requireFew(columns * rows);
    Grid grid;
    grid.spacing = spacing;
    grid.columns = static_cast<std::uint32_t>(columns);
    grid.rows = static_cast<std::uint32_t>(rows);
    // What is left over lies on both sides alike.
    grid.origin = {0.5 * (box.lower.x + box.upper.x - columns * spacing),
                   0.5 * (box.lower.z + box.upper.z - rows * spacing)};
    for (std::uint32_t j = 0; j < grid.rows; ++j) {
        for (std::uint32_t i = 0; i < grid.columns; ++i) {
            grid.sensors.push_back(
                {{grid.origin.x + (i + 0.5) * spacing, height, grid.origin.y + (j + 0.5) * spacing},
                 {0.0, 1.0, 0.0}});
        }
    }
    return grid;
}

Grid makeObjectGrid(const scene::Scene& scene, const hierarchy::ReachedSides& reached, std::uint32_t object,
                    double spacing) {
    const surface::Surface& surface = *scene.objects[object].surface;
    double area = 0.0;
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        for (const bool back : {false, true}) {
            if (reached.isReached(object, patch, back)) {
                area += surface.area(patch, surface::wholePatch(surface.domain(patch)));
            }
        }
    }
    if (!(area > 0.0)) {
        throw base::UsageError("--grid: light reaches no side of '" + scene.objects[object].name + "'");
    }
    requireFew(area / (spacing * spacing));
    Grid grid;
    grid.spacing = spacing;
    for (const bool back : {false, true}) {
        PatchGrid patches(surface, spacing);
        for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
            if (reached.isReached(object, patch, back)) {
                patches.add(patch, back, grid.sensors);
            }
        }
    }
    if (grid.sensors.empty()) {
        throw base::UsageError(
            fmt::format("--grid: a spacing of {:g} m gives no sensor on '{}', which has {:.3g} m2", spacing,
                        scene.objects[object].name, area));
    }
    return grid;
}

IlluminanceStatistics summarize(std::span<const Measurement> measured) {
    IlluminanceStatistics result;
    result.minimum = INFINITY;
    for (const Measurement& m : measured) {
        if (m.place == SensorPlace::solid) {
            ++result.inSolids;
            continue;
        }
        ++result.count;
        result.mean += m.illuminance;
        result.minimum = std::min(result.minimum, m.illuminance);
        result.maximum = std::max(result.maximum, m.illuminance);
    }
    if (result.count == 0) {
        result.minimum = 0.0;
        return result;
    }
    result.mean /= static_cast<double>(result.count);
    result.uniformity = result.mean > 0.0 ? result.minimum / result.mean : 0.0;
    return result;
}

}  // namespace fluxwalk::image
