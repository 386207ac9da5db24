#include <bit>
#include <cstring>
#include <iostream>

#include <gtest/gtest.h>

#include "core/transport/exact_form_factor.h"
#include "core/transport/form_factor_builds.h"
#include "tests/support/statistics.h"
#include "tests/transport/polygon_pairs.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec3d;
using test::Built;
using test::Placement;
using test::Polygon;
using transport::ElementPoints;
using transport::makeElementPoints;
using transport::PairFactor;

constexpr std::array kPlacements{Placement::far,          Placement::middle,  Placement::near,
                                 Placement::sharedEdge,   Placement::sharedCorner,
                                 Placement::horizon,      Placement::tinyOverHuge};

// Patch nodes of `count` random pairs: elements 2 i and 2 i + 1 belong together.
struct Pairs {
    std::unique_ptr<Built> built;
    std::vector<std::array<NodeId, 2>> nodes;

    Pairs(Placement placement, std::uint64_t key, int count) {
        base::RandomStream random(key);
        std::vector<Polygon> polygons;
        for (int i = 0; i < count; ++i) {
            test::PolygonPair pair = test::randomPair(placement, random);
            polygons.push_back(std::move(pair.a));
            polygons.push_back(std::move(pair.b));
        }
        built = std::make_unique<Built>(test::sceneOf(polygons));
        for (std::uint32_t i = 0; i < built->scene.objects.size(); i += 2) {
            nodes.push_back({built->tree.patchNode(i, 0, false), built->tree.patchNode(i + 1, 0, false)});
        }
    }
    const hierarchy::Hierarchy& tree() const { return built->tree; }
    double exact(const std::array<NodeId, 2>& pair) const {
        return transport::polygonCoupling(test::cornersOf(tree().shape(pair[0])),
                                          test::cornersOf(tree().shape(pair[1])));
    }
};

struct Limits {
    double median;
    double most;  ///< of 95 %
    double worst;
};

// Errors against the exact coupling of two polygons, relative to it or to 1 % of the smaller area.
Limits limitsOf(Placement placement) {
    switch (placement) {
        case Placement::far:
            return {5e-6, 5e-5, 3e-4};
        case Placement::middle:
            return {2e-5, 3e-4, 1e-3};
        case Placement::near:
            return {1e-3, 1e-2, 5e-2};
        case Placement::sharedEdge:
        case Placement::sharedCorner:
            return {5e-3, 3e-2, 0.1};
        case Placement::horizon:
            return {1e-2, 0.1, 1.0};
        case Placement::tinyOverHuge:
            return {2e-4, 1e-3, 1e-2};
    }
    return {};
}

TEST(PairFactor, agreesWithTheExactCouplingOfPolygons) {
    for (const Placement placement : kPlacements) {
        const Pairs pairs(placement, 10, 400);
        std::vector<double> errors;
        int covered = 0;
        for (const auto& pair : pairs.nodes) {
            const PairFactor f = transport::computePairFactor(makeElementPoints(pairs.tree(), pair[0]),
                                                              makeElementPoints(pairs.tree(), pair[1]));
            const double exact = pairs.exact(pair);
            const auto smaller = static_cast<double>(
                std::min(pairs.tree().shape(pair[0]).area, pairs.tree().shape(pair[1]).area));
            const double error = std::abs(f.coupling - exact);
            const double floor = placement == Placement::far || placement == Placement::middle ? 0.0 : 0.01 * smaller;
            errors.push_back(exact > 0.0 ? error / std::max(exact, floor) : error / smaller);
            covered += error <= f.coupling * std::max(f.spreadA, f.spreadB) ? 1 : 0;
        }
        const Limits limits = limitsOf(placement);
        const double median = test::quantile(errors, 0.5);
        const double most = test::quantile(errors, 0.95);
        const double worst = test::quantile(errors, 1.0);
        EXPECT_LT(median, limits.median) << test::nameOf(placement);
        EXPECT_LT(most, limits.most) << test::nameOf(placement);
        EXPECT_LT(worst, limits.worst) << test::nameOf(placement);
        // The spread that the oracle sees is an honest measure of that error.
        const double rate = covered / static_cast<double>(errors.size());
        EXPECT_GE(rate, 0.99) << test::nameOf(placement);
        std::cout << "STAT " << test::nameOf(placement) << " n " << errors.size() << " median " << median << " p95 "
                  << most << " worst " << worst << " covered " << rate << '\n';
    }
}

TEST(PairFactor, isSymmetricToTheBit) {
    for (const Placement placement : kPlacements) {
        const Pairs pairs(placement, 11, 200);
        for (const auto& pair : pairs.nodes) {
            const ElementPoints a = makeElementPoints(pairs.tree(), pair[0]);
            const ElementPoints b = makeElementPoints(pairs.tree(), pair[1]);
            const PairFactor ab = transport::computePairFactor(a, b);
            const PairFactor ba = transport::computePairFactor(b, a);
            EXPECT_EQ(std::bit_cast<std::uint64_t>(ab.coupling), std::bit_cast<std::uint64_t>(ba.coupling))
                << test::nameOf(placement) << ' ' << ab.coupling / ba.coupling - 1.0;
            EXPECT_EQ(ab.gradientA, ba.gradientB);
            EXPECT_EQ(ab.gradientB, ba.gradientA);
            EXPECT_EQ(ab.spreadA, ba.spreadB);
            EXPECT_EQ(ab.spreadB, ba.spreadA);
            EXPECT_EQ(ab.evaluations, ba.evaluations);
        }
    }
}

TEST(PairFactor, instructionSetsGiveTheSameBits) {
    if (__builtin_cpu_supports("avx2") == 0) {
        GTEST_SKIP() << "no AVX2 here";
    }
    const auto expectSame = [](const ElementPoints& a, const ElementPoints& b) {
        const PairFactor baseline = transport::computePairFactorBaseline(a, b);
        const PairFactor wide = transport::computePairFactorAvx2(a, b);
        EXPECT_EQ(std::memcmp(&baseline.coupling, &wide.coupling, sizeof(double)), 0);
        EXPECT_EQ(baseline.gradientA, wide.gradientA);
        EXPECT_EQ(baseline.gradientB, wide.gradientB);
        EXPECT_EQ(baseline.spreadA, wide.spreadA);
        EXPECT_EQ(baseline.spreadB, wide.spreadB);
    };
    for (const Placement placement : kPlacements) {
        const Pairs pairs(placement, 12, 300);
        for (const auto& pair : pairs.nodes) {
            expectSame(makeElementPoints(pairs.tree(), pair[0]), makeElementPoints(pairs.tree(), pair[1]));
        }
    }
    const Built curved(test::randomScene(13, 1, 10, 6));
    for (const NodeId a : curved.tree.patches()) {
        for (const NodeId b : curved.tree.patches()) {
            expectSame(makeElementPoints(curved.tree, a), makeElementPoints(curved.tree, b));
        }
    }
}

TEST(PairFactor, isZeroBehindThePlane) {
    base::RandomStream random(14);
    for (int i = 0; i < 200; ++i) {
        test::PolygonPair pair = test::randomPair(Placement::middle, random);
        std::reverse(pair.b.begin(), pair.b.end());
        for (Vec3d& p : pair.b) {
            p.z += 10.0;  // certainly above a, and looking away
        }
        const Built built(test::sceneOf({pair.a, pair.b}));
        const ElementPoints a = makeElementPoints(built.tree, built.tree.patchNode(0, 0, false));
        const ElementPoints b = makeElementPoints(built.tree, built.tree.patchNode(1, 0, false));
        if (glm::dot(b.axis, -b.center) < -b.radius - 1.0) {
            EXPECT_EQ(transport::computePairFactor(a, b).coupling, 0.0);
        }
    }
}

// The gradient of the kernel over an element against central differences of the exact factor at its middle.
TEST(PairFactor, gradientsAreThoseOfTheKernel) {
    const Pairs pairs(Placement::far, 15, 300);
    for (const auto& pair : pairs.nodes) {
        const ElementPoints a = makeElementPoints(pairs.tree(), pair[0]);
        const ElementPoints b = makeElementPoints(pairs.tree(), pair[1]);
        const PairFactor f = transport::computePairFactor(a, b);
        const double mean = f.coupling / a.area;
        const auto factorAt = [&](const base::Vec2d& local) {
            Vec3d x;
            const auto& c = a.corners;
            if (a.cornerCount == 3) {
                const base::Vec2d uv = local + base::Vec2d(1.0 / 3.0);
                x = (1.0 - uv.x - uv.y) * c[0] + uv.x * c[1] + uv.y * c[2];
            } else {
                const base::Vec2d st = 0.5 * (local + 1.0);
                x = (1.0 - st.y) * ((1.0 - st.x) * c[0] + st.x * c[1]) +
                    st.y * ((1.0 - st.x) * c[3] + st.x * c[2]);
            }
            return transport::pointToPolygon(x, a.axis, std::span(b.corners.data(), b.cornerCount));
        };
        const double h = 0.02;
        const base::Vec2d expected((factorAt({h, 0}) - factorAt({-h, 0})) / (2.0 * h * mean),
                                   (factorAt({0, h}) - factorAt({0, -h})) / (2.0 * h * mean));
        EXPECT_LT(glm::length(f.gradientA - expected), 0.01 + 0.1 * glm::length(expected));
    }
}

TEST(PairFactor, pointFactorsAreExactOnPolygons) {
    base::RandomStream random(16);
    for (const Placement placement : kPlacements) {
        const Pairs pairs(placement, 16, 100);
        for (const auto& pair : pairs.nodes) {
            const ElementPoints a = makeElementPoints(pairs.tree(), pair[0]);
            const ElementPoints b = makeElementPoints(pairs.tree(), pair[1]);
            const double exact = transport::pointToPolygon(a.center, a.axis, std::span(b.corners.data(), b.cornerCount));
            EXPECT_NEAR(transport::computePointFactor(a.center, a.axis, b), exact, 1e-9);
        }
    }
}

}  // namespace
}  // namespace fluxwalk
