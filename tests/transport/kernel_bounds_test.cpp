#include "core/transport/kernel_bounds.h"

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/scene/builders.h"
#include "core/transport/element_sampler.h"
#include "core/transport/form_factor.h"
#include "tests/support/built.h"
#include "tests/support/curved_room.h"
#include "tests/support/statistics.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec3d;
using hierarchy::Shape;

// Form factor from a point to an element: exact for planar ones, else by points in n x n strata.
double pointFactor(const hierarchy::Hierarchy& h, const transport::SurfaceSample& x, NodeId source,
                   unsigned n) {
    const Shape& shape = h.shape(source);
    if (shape.isPlanar) {
        return transport::computePointFactor(x.position, x.normal, transport::makeElementPoints(h, source));
    }
    const transport::ElementSampler sampler(h, source);
    double sum = 0.0;
    double measure = 0.0;
    for (unsigned i = 0; i < n * n; ++i) {
        const unsigned row = i / n;
        const transport::SurfaceSample y = sampler.at({(i % n + 0.5) / n, (row + 0.5) / n});
        const Vec3d d = y.position - x.position;
        const double r2 = std::max(glm::dot(d, d), 1e-300);
        sum += y.measure * std::max(0.0, glm::dot(d, x.normal)) * std::max(0.0, -glm::dot(d, y.normal)) /
               (base::kPi * r2 * r2);
        measure += y.measure;
    }
    return static_cast<double>(shape.area) * sum / measure;
}

/// The sum over a polygon's edges, of terms up to 1, is off by this where it should be 0 or 1.
constexpr double kRoundingOfFactor = 1e-15;

struct Quality {
    int outside = 0;
    int bounded = 0;                ///< pairs that cannot touch
    std::vector<double> tightness;  ///< (upper - lower) / factor, of pairs at about four times their radii
};

// Random points of random pairs of elements, as many on each level of subdivision.
Quality inspect(scene::Scene scene, unsigned levels, int pairsOnEach) {
    test::Built built(std::move(scene));
    Quality quality;
    std::vector<NodeId> elements;
    for (unsigned level = 0; level <= levels; ++level) {
        elements.clear();
        for (const NodeId patch : built.tree.patches()) {
            const std::vector<NodeId> below = built.leavesOf(patch);
            elements.insert(elements.end(), below.begin(), below.end());
        }
        base::RandomStream random(70 + level);
        // Any pairs first, then four times as many draws of which only those at about four times their radii
        // are taken, so that the median is well known.
        for (int draw = 0; draw < 5 * pairsOnEach; ++draw) {
            const auto pick = [&] {
                return elements[static_cast<std::size_t>(random.next() *
                                                         static_cast<double>(elements.size()))];
            };
            const NodeId a = pick();
            const NodeId b = pick();
            const Shape& from = built.tree.shape(a);
            const Shape& to = built.tree.shape(b);
            const double distance =
                static_cast<double>(glm::distance(from.center, to.center) / (from.radius + to.radius));
            const bool isAtFour = distance > 3.5 && distance < 4.5;
            if (a == b || (draw >= pairsOnEach && !isAtFour)) {
                continue;
            }
            const transport::ElementSampler sampler(built.tree, a);
            const transport::SurfaceSample x = sampler.at(random.next2());
            const transport::FactorBounds bounds =
                transport::boundPointFactor(built.tree, a, transport::makeSourceParts(built.tree, b));
            const auto isOutside = [&bounds](double factor) {
                return factor < bounds.lower - kRoundingOfFactor || factor > bounds.upper + kRoundingOfFactor;
            };
            double factor = pointFactor(built.tree, x, b, distance < 2.0 ? 24 : 6);
            if (isOutside(factor)) {
                // Few points miss a sliver above a horizon.
                factor = pointFactor(built.tree, x, b, 200);
            }
            quality.outside += isOutside(factor) ? 1 : 0;
            quality.bounded += bounds.upper < 1.0 ? 1 : 0;
            if (isAtFour && factor > 0.0) {
                quality.tightness.push_back((bounds.upper - bounds.lower) / factor);
            }
        }
        if (level < levels) {
            built.split(1);
        }
    }
    return quality;
}

TEST(KernelBounds, tightlyHoldAllFactorsOfTheCornellBox) {
    const Quality quality = inspect(scene::buildCornellBox(base::Rgb(100.0f)), 4, 20000);
    EXPECT_EQ(quality.outside, 0);
    EXPECT_GT(quality.bounded, 50000);
    ASSERT_GT(quality.tightness.size(), 1000u);
    EXPECT_LT(test::quantile(quality.tightness, 0.5), 1.5);
}

TEST(KernelBounds, tightlyHoldAllFactorsOfCurvedObjects) {
    const Quality quality = inspect(test::buildCurvedRoom(), 4, 10000);
    EXPECT_EQ(quality.outside, 0);
    EXPECT_GT(quality.bounded, 40000);
    ASSERT_GT(quality.tightness.size(), 1000u);
    EXPECT_LT(test::quantile(quality.tightness, 0.5), 1.5);
}

}  // namespace
}  // namespace fluxwalk
