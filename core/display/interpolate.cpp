#include "core/display/interpolate.h"

#include <algorithm>
#include <limits>

#include "core/display/cell_regions.h"

namespace fluxwalk::display {

namespace {

// Barycentric coordinates of the foot of `p` in the triangle's plane; of the first corner where the triangle
// has no area.
Vec3d barycentric(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p) {
    const Vec3d n = glm::cross(b - a, c - a);
    const double squared = glm::dot(n, n);
    if (!(squared > 0.0)) {
        return {1.0, 0.0, 0.0};
    }
    const double v = glm::dot(n, glm::cross(p - a, c - a)) / squared;
    const double w = glm::dot(n, glm::cross(b - a, p - a)) / squared;
    return {1.0 - v - w, v, w};
}

// Which half of a region that was cut along `axis` holds the parameter.
unsigned halfAt(const surface::Region& first, Axis axis, const Vec2d& uv) {
    // The cut is the side of the first half that lies in the axis' direction, its corners counter-clockwise.
    const Vec2d& from = first.corners[axis == Axis::x ? 1 : 2];
    const Vec2d& to = first.corners[axis == Axis::x ? 2 : 3];
    const Vec2d along = to - from;
    const Vec2d towards = uv - from;
    return along.x * towards.y - along.y * towards.x >= 0.0 ? 0 : 1;
}

std::uint32_t findCell(const surface::Surface& surface, const CellTable& table, std::uint32_t patch,
                       const Vec2d& uv) {
    auto first = table.places.begin() + table.firstCell[patch];
    auto last = table.places.begin() + table.firstCell[patch + 1];
    surface::Region region = surface::wholePatch(surface.domain(patch));
    // Keeps those whose step is the wanted one; steps come in order.
    const auto narrow = [&](const auto& stepOf, unsigned wanted) {
        first =
            std::partition_point(first, last, [&](const CellPlace& place) { return stepOf(place) < wanted; });
        last = std::partition_point(first, last,
                                    [&](const CellPlace& place) { return stepOf(place) == wanted; });
    };
    for (unsigned level = 0; last - first > 1 && surface::pathLevel(first->path) > level; ++level) {
        const surface::Split split = surface::splitAt(surface, patch, level);
        const unsigned child = surface::childAt(surface, patch, region, split, uv);
        region = surface::childRegion(surface, patch, region, split, child);
        narrow([level](const CellPlace& place) { return surface::pathStep(place.path, level); }, child);
    }
    for (unsigned level = 0; last - first > 1; ++level) {
        const Axis axis = axisOfStep(surface::pathStep(first->cuts, level));
        const std::array<surface::Region, 2> halves = halfRegions(surface, patch, region, axis);
        const unsigned half = halfAt(halves[0], axis, uv);
        region = halves[half];
        narrow([level](const CellPlace& place) { return surface::pathStep(place.cuts, level); },
               cutStep(axis, half));
    }
    return static_cast<std::uint32_t>(first - table.places.begin());
}

}  // namespace

std::optional<Rgb> DisplayLookup::irradiance(std::uint32_t patch, bool back, const Vec2d& uv) const {
    for (std::size_t m = 0; m < meshes_.meshes.size(); ++m) {
        const scene::LitMesh& mesh = *meshes_.meshes[m];
        const CellTable& table = meshes_.tables[m];
        if (mesh.back != back || table.firstCell[patch] == table.firstCell[patch + 1]) {
            continue;
        }
        const std::uint32_t cell = findCell(surface_, table, patch, uv);
        const Vec3d p = surface_.evaluate(patch, uv).position;
        Rgb result(0.0f);
        double deepest = -std::numeric_limits<double>::infinity();
        for (std::uint32_t t = table.firstTriangle[cell]; t < table.firstTriangle[cell + 1]; ++t) {
            const std::uint32_t* i = mesh.triangles.data() + 3 * static_cast<std::size_t>(t);
            Vec3d b = barycentric(Vec3d(mesh.positions[i[0]]), Vec3d(mesh.positions[i[1]]),
                                  Vec3d(mesh.positions[i[2]]), p);
            const double depth = std::min({b.x, b.y, b.z});
            if (depth > deepest) {
                deepest = depth;
                // Points that rounding or curvature puts outside take the nearest value.
                b = glm::max(b, Vec3d(0.0));
                b /= b.x + b.y + b.z;
                result = Rgb(b.x * Vec3d(mesh.irradiance[i[0]]) + b.y * Vec3d(mesh.irradiance[i[1]]) +
                             b.z * Vec3d(mesh.irradiance[i[2]]));
            }
        }
        return result;
    }
    return std::nullopt;
}

}  // namespace fluxwalk::display
