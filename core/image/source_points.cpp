#include "core/image/source_points.h"

#include <algorithm>

#include "core/transport/form_factor.h"

namespace fluxwalk::image {

using base::kLanes;
using base::Lanes;
using base::Lanes3;

namespace {

/// Sources farther away from all points than this many times their radius are integrated by their cubature
/// points: relative error below 1e-3.
constexpr double kFar = 5.0;

// By the source's cubature points, for points that are far from it.
FLUXWALK_INLINE Lanes farFactors(const Lanes3& x, const Lanes3& normal,
                                 const transport::ElementPoints& source) {
    constexpr int kCubaturePoints = 4;
    Lanes sum = base::splat(0.0);
    for (int j = 0; j < kCubaturePoints; ++j) {
        const Lanes3 to = {source.position.x[j] - x.x, source.position.y[j] - x.y,
                           source.position.z[j] - x.z};
        const Lanes r2 = base::dot(to, to);
        const Lanes here = base::maxLanes(base::dot(normal, to), base::splat(0.0));
        const Lanes there = base::maxLanes(
            -(source.normal.x[j] * to.x + source.normal.y[j] * to.y + source.normal.z[j] * to.z),
            base::splat(0.0));
        sum += source.weight[j] * here * there / (base::kPi * r2 * r2);
    }
    return source.area * sum;
}

[[gnu::target("avx2")]] Lanes farFactorsAvx2(const Lanes3& x, const Lanes3& normal,
                                             const transport::ElementPoints& source) {
    return farFactors(x, normal, source);
}

Lanes farFactorsBaseline(const Lanes3& x, const Lanes3& normal, const transport::ElementPoints& source) {
    return farFactors(x, normal, source);
}

bool hasAvx2() {
    static const bool kHas = __builtin_cpu_supports("avx2") != 0;
    return kHas;
}

bool isFar(const Lanes3& x, const transport::ElementPoints& source) {
    const double far = kFar * source.radius;
    for (int i = 0; i < kLanes; ++i) {
        const Vec3d d = Vec3d(x.x[i], x.y[i], x.z[i]) - source.center;
        if (!(glm::dot(d, d) > far * far)) {
            return false;
        }
    }
    return true;
}

}  // namespace

Lanes computeFactors(const Lanes3& x, const Lanes3& normal, const transport::ElementPoints& source) {
    if (!isFar(x, source)) {
        return transport::computePointFactors(x, normal, source);
    }
    return hasAvx2() ? farFactorsAvx2(x, normal, source) : farFactorsBaseline(x, normal, source);
}

namespace {

// Makes the polygon of its corners of it. From a point beside a curved part its contour cannot be told, and
// the cubature misses what is nearest; the facet's error is the part's rise over it.
void makeFacet(transport::ElementPoints& points) {
    points.isPlanar = points.isFlat = true;
    std::copy(points.corners.begin(), points.corners.end(), points.contour.begin());
    points.contourCount = points.cornerCount;
}

}  // namespace

/// The four quarters of an element or of one of its quarters.
struct SourcePoints::Quarters {
    std::array<SourcePart, 4> parts;
    std::array<std::atomic<Quarters*>, 4> below{};

    ~Quarters() {
        for (const auto& quarters : below) {
            delete quarters.load();
        }
    }
};

SourcePoints::SourcePoints(const hierarchy::Hierarchy& hierarchy)
    : hierarchy_(hierarchy),
      points_(hierarchy.nodeCount()),
      quarters_(hierarchy.nodeCount()),
      light_(hierarchy.nodeCount()) {}

SourcePoints::~SourcePoints() {
    for (const auto& points : points_) {
        delete points.load();
    }
    forgetParts();
    for (const auto& light : light_) {
        delete light.load();
    }
}

void SourcePoints::forgetParts() {
    for (auto& quarters : quarters_) {
        delete quarters.exchange(nullptr);
    }
    partBytes_ = 0;
}

const transport::ElementPoints& SourcePoints::of(NodeId element) {
    return findOrMake(points_[base::index(element)], [&] {
        return std::make_unique<const transport::ElementPoints>(
            transport::makeElementPoints(hierarchy_, element));
    });
}

const SourcePart& SourcePoints::of(NodeId element, transport::Path part) {
    std::atomic<Quarters*>* place = &quarters_[base::index(element)];
    const unsigned levels = surface::pathLevel(part);
    for (unsigned level = 0;; ++level) {
        Quarters& quarters = findOrMake(*place, [&] {
            auto made = std::make_unique<Quarters>();
            partBytes_.fetch_add(sizeof(Quarters), std::memory_order_relaxed);
            const transport::Path whole = part >> (2 * (levels - level));
            for (unsigned k = 0; k < 4; ++k) {
                SourcePart& quarter = made->parts[k];
                quarter.region =
                    transport::partRegion(hierarchy_.region(element), surface::childPath(whole, k));
                quarter.points = transport::makeRegionPoints(hierarchy_, element, quarter.region);
                if (level + 1 == transport::kMaxPartLevel) {
                    makeFacet(quarter.points);
                }
            }
            return made;
        });
        const unsigned step = surface::pathStep(part, level);
        if (level + 1 == levels) {
            return quarters.parts[step];
        }
        place = &quarters.below[step];
    }
}

}  // namespace fluxwalk::image
