#include "core/transport/element_points.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/transport/form_factor.h"
#include "tests/transport/polygon_pairs.h"

namespace fluxwalk {
namespace {

using base::kLanes;
using base::Lanes;
using base::NodeId;
using base::Vec3d;
using test::Built;
using transport::ElementPoints;
using transport::LinearFit;
using transport::makeElementPoints;

Vec3d laneOf(const base::Lanes3& v, int i) {
    return {v.x[i], v.y[i], v.z[i]};
}

// Quads, triangles, spheres and ellipsoids, inside and outside, fronts and backs, twice split.
const Built& zoo() {
    static Built built(test::randomScene(21, 2, 6, 6));
    if (built.tree.leafCount() == built.tree.patches().size()) {
        built.split(2);
    }
    return built;
}

template <class Check>
void forElements(const Built& built, const Check& check) {
    for (std::uint32_t n = 0; n < built.tree.nodeCount(); ++n) {
        if (built.tree.kind(NodeId{n}) == hierarchy::NodeKind::element) {
            check(NodeId{n}, makeElementPoints(built.tree, NodeId{n}));
        }
    }
}

// Kernels for wide instruction sets load whole vectors from objects that other files made.
TEST(ElementPoints, areAlignedForTheWidestKernel) {
    EXPECT_EQ(alignof(ElementPoints), 64u);
    EXPECT_EQ(alignof(transport::DensePoints), 64u);
    std::vector<ElementPoints> many(3);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(many.data()) % 64, 0u);
}

TEST(ElementPoints, lieOnTheSurfaceWithItsNormals) {
    int curvedBacks = 0;
    forElements(zoo(), [&](NodeId id, const ElementPoints& e) {
        const hierarchy::ElementName name = zoo().tree.name(id);
        const surface::Surface& surface = zoo().tree.surfaceOf(id);
        curvedBacks += name.back && !e.isPlanar ? 1 : 0;
        double sum = 0.0;
        for (int i = 0; i < kLanes; ++i) {
            const Vec3d x = laneOf(e.position, i);
            const surface::SurfacePoint p = surface.evaluate(name.patch, surface.locate(name.patch, x));
            EXPECT_LT(glm::distance(p.position, x), 1e-6);
            EXPECT_LT(glm::distance(name.back ? -p.normal : p.normal, laneOf(e.normal, i)), 1e-5);
            sum += e.weight[i];
        }
        EXPECT_NEAR(sum, 1.0, 1e-12);
        for (int i = 4; i < kLanes; ++i) {
            EXPECT_EQ(e.weight[i], 0.0);
        }
    });
    EXPECT_GT(curvedBacks, 0);
}

// Lanes after the cubature points are the corners in the shape's order, on both sides: gradients rely on it.
TEST(ElementPoints, cornersStandInTheOrderOfTheShape) {
    forElements(zoo(), [&](NodeId id, const ElementPoints& e) {
        for (std::uint32_t i = 0; i < e.cornerCount; ++i) {
            const int lane = static_cast<int>(4 + i);
            EXPECT_LT(glm::distance(laneOf(e.position, lane), e.corners[i]), 1e-6)
                << "back " << zoo().tree.name(id).back << ", planar " << e.isPlanar << ", corner " << i;
        }
    });
}

TEST(ElementPoints, localCoordinatesNameThePoints) {
    forElements(zoo(), [&](NodeId, const ElementPoints& e) {
        if (!e.isPlanar) {
            return;
        }
        const auto& local = transport::localPointCoordinates(e.cornerCount);
        for (std::size_t i = 0; i < local.size(); ++i) {
            const auto& c = e.corners;
            Vec3d x;
            if (e.cornerCount == 3) {
                const base::Vec2d uv = local[i] + base::Vec2d(1.0 / 3.0);
                x = (1.0 - uv.x - uv.y) * c[0] + uv.x * c[1] + uv.y * c[2];
            } else {
                const base::Vec2d st = 0.5 * (local[i] + 1.0);
                x = (1.0 - st.y) * ((1.0 - st.x) * c[0] + st.x * c[1]) +
                    st.y * ((1.0 - st.x) * c[3] + st.x * c[2]);
            }
            EXPECT_LT(glm::distance(laneOf(e.position, static_cast<int>(i)), x), 1e-12);
        }
    });
}

// 2 x 2 Gauss points take cubics in each direction, 4 x 4 septics, three points of a triangle quadratics.
TEST(ElementPoints, cubatureIsExactToItsDegree) {
    const auto integrate = [](const ElementPoints& e, const auto& f) {
        double sum = 0.0;
        for (int i = 0; i < kLanes; ++i) {
            sum += e.weight[i] * f(laneOf(e.position, i));
        }
        return sum;
    };
    const Built built(
        test::sceneOf({{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}}}));
    const ElementPoints quad = makeElementPoints(built.tree, built.tree.patchNode(0, 0, false));
    const ElementPoints triangle = makeElementPoints(built.tree, built.tree.patchNode(1, 0, false));
    ASSERT_EQ(quad.cornerCount, 4u);
    ASSERT_EQ(triangle.cornerCount, 3u);
    EXPECT_NEAR(integrate(quad, [](const Vec3d& p) { return p.x * p.x * p.x * p.y * p.y; }), 2.0 / 3.0,
                1e-12);
    EXPECT_NEAR(integrate(triangle, [](const Vec3d& p) { return p.x * p.y; }), 1.0 / 12.0, 1e-12);
    EXPECT_NEAR(integrate(triangle, [](const Vec3d& p) { return p.x * p.x; }), 1.0 / 6.0, 1e-12);
    for (const ElementPoints* e : {&quad, &triangle}) {
        const transport::DensePoints dense = makeDensePoints(*e);
        double sum = 0.0;
        double moment = 0.0;
        for (std::size_t block = 0; block < 2; ++block) {
            for (int i = 0; i < kLanes; ++i) {
                const Vec3d p = laneOf(dense.position[block], i);
                sum += dense.weight[block][i];
                moment += dense.weight[block][i] * std::pow(p.x, 5.0);
            }
        }
        EXPECT_NEAR(sum, 1.0, 1e-12);
        EXPECT_NEAR(moment, e->cornerCount == 4 ? 32.0 / 6.0 : 2.0 / 42.0, 1e-12);
    }
}

TEST(FitLinear, reproducesLinearFunctions) {
    base::RandomStream random(22);
    forElements(zoo(), [&](NodeId, const ElementPoints& e) {
        const auto& local = transport::localPointCoordinates(e.cornerCount);
        const base::Vec2d slope = 2.0 * random.next2() - 1.0;
        const double mean = 0.2 + 2.5 * random.next();
        std::array<double, base::kLanes> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = mean + glm::dot(slope, local[i]);
        }
        const LinearFit fit = transport::fitLinear(e, values, mean);
        EXPECT_EQ(fit.mean, mean);
        EXPECT_EQ(fit.largest, *std::max_element(values.begin(), values.end()));
        EXPECT_LT(glm::length(mean * fit.gradient - slope), 1e-12);
        EXPECT_LT(fit.deviation, 1e-12);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double fitted = mean * (1.0 + glm::dot(fit.gradient, local[i]));
            EXPECT_LE(std::abs(values[i] - fitted), fit.deviation + 1e-12);
        }
    });
}

TEST(AngleLanes, isAccurateEverywhere) {
    base::RandomStream random(23);
    double worst = 0.0;
    for (int trial = 0; trial < 50'000; ++trial) {
        Lanes sine;
        Lanes cosine;
        std::array<long double, base::kLanes> expected{};
        for (int i = 0; i < kLanes; ++i) {
            // Every second one near 0 or pi, and of any size.
            const double small = std::exp2(-60.0 * random.next());
            const double angle =
                i % 2 == 0 ? base::kPi * random.next() : (i % 4 == 1 ? small : base::kPi - small);
            const double size = std::exp2(80.0 * random.next() - 40.0);
            sine.set(i, size * std::abs(std::sin(angle)));
            cosine.set(i, size * std::cos(angle));
            expected[static_cast<std::size_t>(i)] =
                std::atan2(static_cast<long double>(sine[i]), static_cast<long double>(cosine[i]));
        }
        const Lanes angle = base::angleLanes(sine, cosine);
        for (int i = 0; i < kLanes; ++i) {
            const long double truth = expected[static_cast<std::size_t>(i)];
            if (truth > 0.0L) {
                worst = std::max(worst, std::abs(static_cast<double>(angle[i] / truth - 1.0L)));
            }
        }
    }
    EXPECT_LT(worst, 1e-11);
    const Lanes zero = base::angleLanes(base::splat(0.0), base::splat(0.0));
    const Lanes straight = base::angleLanes(base::splat(0.0), base::splat(-2.0));
    const Lanes right = base::angleLanes(base::splat(3.0), base::splat(0.0));
    EXPECT_EQ(zero[0], 0.0);
    EXPECT_EQ(straight[3], base::kPi);
    EXPECT_NEAR(right[7], 0.5 * base::kPi, 1e-15);
}

}  // namespace
}  // namespace fluxwalk
