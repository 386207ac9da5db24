#include "core/hierarchy/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/photometry.h"

namespace fluxwalk::hierarchy {

namespace {

/// A gap is narrow if it is less wide than this part of a cell; in the cell at its rim, a tenth of the light
/// outside is left, in the next a hundredth.
constexpr double kNarrow = 0.25;
/// Directions that a gap is judged by, and how many of them may lead out of it.
constexpr unsigned kDirections = 16;
constexpr unsigned kMostOut = 1;
/// Beside its middle, where a cell is looked at, in parts of it: all must be hidden before it counts as
/// hidden. A cell that is wrongly taken for hidden loses light, one that is wrongly taken for exposed only
/// costs rays, which find it in the dark.
constexpr std::size_t kPlacesOfCell = Shape::kPlaces / 16;
constexpr std::array<base::Vec2d, kPlacesOfCell - 1> kCornersOfCell{
    {{-0.4, -0.4}, {0.4, 0.4}, {0.4, -0.4}, {-0.4, 0.4}}};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The same cosine-distributed directions for all cells, so that none is by chance darker than another.
std::array<Vec3d, kDirections> directionsAbout(const Vec3d& n) {
    const Vec3d side = glm::normalize(glm::cross(n, std::abs(n.y) < 0.7 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1)));
    const Vec3d other = glm::cross(n, side);
    std::array<Vec3d, kDirections> directions{};
    for (unsigned k = 0; k < kDirections; ++k) {
        const double sine = std::sqrt((k + 0.5) / kDirections);
        const double angle = 2.0 * base::kPi * 0.618033988749895 * k;
        directions[k] =
            sine * (std::cos(angle) * side + std::sin(angle) * other) + std::sqrt(1.0 - sine * sine) * n;
    }
    return directions;
}

/// One side of a patch, and what stands before it.
struct Side {
    const rays::RayScene& rays;
    const ReachedSides& reached;
    const surface::Surface& surface;
    std::uint32_t patch = 0;
    bool back = false;
    const std::function<bool(base::ObjectId)>& mayEmit;
};

struct Place {
    Vec3d position{};
    Vec3d normal{};
    double clearance = 0.0;  ///< along the normal, m; 0 in a solid, infinite before what may emit
};

Place placeAt(const Side& side, const surface::Region& region, const base::Vec2d& at) {
    const surface::SurfacePoint p = side.surface.evaluate(side.patch, surface::mapToRegion(region, at).uv);
    Place place{p.position, side.back ? -p.normal : p.normal, kInfinity};
    const auto hit = side.rays.closest(side.rays.halfLine(place.position, place.normal, place.normal));
    if (hit && !side.reached.isReached(base::index(hit->object), hit->back)) {
        place.clearance = 0.0;
    } else if (hit && !side.mayEmit(hit->object)) {
        place.clearance = static_cast<double>(hit->t);
    }
    return place;
}

// Of all directions, how many lead farther than each of two lengths.
std::array<unsigned, 2> countOut(const Side& side, const Place& place, const std::array<double, 2>& lengths) {
    std::array<unsigned, 2> out{};
    for (const Vec3d& direction : directionsAbout(place.normal)) {
        const auto hit = side.rays.closest(side.rays.halfLine(place.position, place.normal, direction));
        const double t = hit && !side.mayEmit(hit->object) ? static_cast<double>(hit->t) : kInfinity;
        for (unsigned i = 0; i < 2; ++i) {
            out[i] += t > lengths[i] ? 1u : 0u;
        }
    }
    return out;
}

}  // namespace

Exposure findExposure(const rays::RayScene& rays, const ReachedSides& reached,
                      const surface::Surface& surface, std::uint32_t patch, bool back,
                      const surface::Region& region, const std::array<double, 2>& cellSizes,
                      const std::function<bool(base::ObjectId)>& mayEmit, bool doesEmit) {
    const Side side{rays, reached, surface, patch, back, mayEmit};
    const auto isClear = [&](const Place& place) { return place.clearance >= kNarrow * cellSizes[1]; };
    const auto middleOf = [](unsigned cell) {
        const unsigned row = cell / 4;
        return base::Vec2d(0.125 + 0.25 * (cell % 4), 0.125 + 0.25 * row);
    };
    std::array<Place, 16> middles;
    for (unsigned cell = 0; cell < 16; ++cell) {
        middles[cell] = placeAt(side, region, middleOf(cell));
    }
    if (std::all_of(middles.begin(), middles.end(), isClear)) {
        return {};
    }
    Exposure exposure{.cells = 0, .places = 0, .placesOfParent = 0};
    for (unsigned cell = 0; cell < 16; ++cell) {
        std::array<Place, kPlacesOfCell> places;
        for (std::size_t i = 0; i < kPlacesOfCell; ++i) {
            places[i] =
                i == 0 ? middles[cell] : placeAt(side, region, middleOf(cell) + 0.25 * kCornersOfCell[i - 1]);
        }
        const Place& widest =
            *std::max_element(places.begin(), places.end(),
                              [](const Place& a, const Place& b) { return a.clearance < b.clearance; });
        std::array<bool, 2> isGap{};
        if (widest.clearance > 0.0 && !isClear(widest) && !doesEmit) {
            const std::array<unsigned, 2> out = countOut(side, widest, cellSizes);
            for (unsigned i = 0; i < 2; ++i) {
                isGap[i] = widest.clearance < kNarrow * cellSizes[i] && out[i] <= kMostOut;
            }
        }
        exposure.isCovered |= isGap[0];
        if (isGap[0] || widest.clearance <= 0.0) {
            continue;
        }
        exposure.cells = static_cast<std::uint16_t>(exposure.cells | (1u << cell));
        for (const Place& place : places) {
            const bool isOutside = place.clearance > 0.0;
            exposure.places = static_cast<std::uint8_t>(exposure.places + (isOutside ? 1 : 0));
            exposure.placesOfParent =
                static_cast<std::uint8_t>(exposure.placesOfParent + (isOutside && !isGap[1] ? 1 : 0));
        }
    }
    return exposure;
}

}  // namespace fluxwalk::hierarchy
