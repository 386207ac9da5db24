#include "core/image/part_light.h"

#include "core/base/random.h"

namespace fluxwalk::image {

namespace {

/// A pixel sees several cells of several leaves, and these themselves only reflect.
constexpr GatherRays kRays{64, 64, 64};
static_assert(kCells % PixelGather::kPoints == 0);

constexpr transport::Path cellPath(std::size_t cell) {
    return surface::childPath(surface::childPath(surface::kRootPath, static_cast<unsigned>(cell / 4)),
                              static_cast<unsigned>(cell % 4));
}

base::Vec2d middleOf(const surface::Region& region) {
    base::Vec2d sum(0.0);
    for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
        sum += region.corners[i];
    }
    return sum / static_cast<double>(region.cornerCount);
}

// What is dark where a solid stands on it tells nothing of the sliver beside the solid. Its light is known to
// no more than the noise.
constexpr float kDark = 0.1f;
bool isInside(const rays::RayScene& rays, const PixelPoint& point) {
    const auto hit = rays.closest(rays.halfLine(point.position, point.normal, point.normal));
    return hit && hit->back;
}

Rgb withoutNoise(const std::array<PixelLight, kCells>& lights, const std::array<bool, kCells>& isHidden,
                 std::size_t i) {
    Rgb correction(0.0f);
    float weights = 0.0f;
    for (std::size_t j = 0; j < kCells; ++j) {
        if (!isHidden[j]) {
            const float weight = likeness(lights[i], lights[j]);
            correction += weight * lights[j].correction;
            weights += weight;
        }
    }
    return glm::max(lights[i].steady + correction / weights, Rgb(0.0f));
}

}  // namespace

PartLight::PartLight(const solve::Problem& problem, SourcePoints& points)
    : problem_(problem),
      points_(points),
      finder_(problem, points, NearLight::solved),
      gather_(problem, kRays) {}

const CellLight& PartLight::of(NodeId leaf) {
    return points_.light(leaf, [&] { return gather(leaf); });
}

std::unique_ptr<CellLight> PartLight::gather(NodeId leaf) {
    const hierarchy::Hierarchy& h = problem_.hierarchy;
    const hierarchy::ElementName name = h.name(leaf);
    const hierarchy::Light& mean = h.light(leaf);
    const LeafSources sources = finder_.find(leaf);
    std::array<PixelPoint, kCells> points;
    std::array<PixelLight, kCells> found{};
    for (std::size_t i = 0; i < kCells; ++i) {
        const surface::SurfacePoint at = h.surfaceOf(leaf).evaluate(
            name.patch, middleOf(transport::partRegion(h.region(leaf), cellPath(i))));
        points[i].position = at.position;
        points[i].normal = points[i].shading = name.back ? -at.normal : at.normal;
        points[i].key = base::combine(h.key(leaf), i);
        points[i].phase = (static_cast<double>(i) + 0.5) / kCells;
    }
    for (std::size_t first = 0; first < kCells; first += PixelGather::kPoints) {
        gather_.gather(sources, std::span(points).subspan(first, PixelGather::kPoints),
                       std::span(found).subspan(first, PixelGather::kPoints));
    }
    std::array<bool, kCells> isHidden{};
    for (std::size_t i = 0; i < kCells; ++i) {
        isHidden[i] = base::channelMean(found[i].sum()) <= kDark * base::channelMean(mean.irradiance) &&
                      isInside(problem_.rays, points[i]);
    }
    auto light = std::make_unique<CellLight>();
    Rgb sum(0.0f);
    float count = 0.0f;
    for (std::size_t i = 0; i < kCells; ++i) {
        if (!isHidden[i]) {
            (*light)[i] = mean.emission + mean.reflectance * withoutNoise(found, isHidden, i);
            sum += (*light)[i];
            count += 1.0f;
        }
    }
    for (std::size_t i = 0; i < kCells; ++i) {
        if (isHidden[i]) {
            (*light)[i] = count > 0.0f ? sum / count : mean.radiosity;
        }
    }
    return light;
}

}  // namespace fluxwalk::image
