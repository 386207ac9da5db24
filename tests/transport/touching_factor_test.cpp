#include "core/transport/touching_factor.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/transport/gauss_points.h"
#include "tests/support/built.h"
#include "tests/support/curved_scenes.h"

namespace fluxwalk {
namespace {

using base::kPi;
using base::NodeId;
using base::Vec2d;
using base::Vec3d;
using test::Built;
using transport::ElementPoints;
using transport::makeElementPoints;

// Elements of all objects that `isWanted` names.
std::vector<NodeId> leavesWhere(const Built& built, const std::function<bool(NodeId)>& isWanted) {
    std::vector<NodeId> leaves;
    for (std::uint32_t i = 0; i < built.tree.nodeCount(); ++i) {
        const NodeId id{i};
        if (built.tree.kind(id) == hierarchy::NodeKind::element && built.tree.isLeaf(id) && isWanted(id)) {
            leaves.push_back(id);
        }
    }
    return leaves;
}

double touchingCoupling(const Built& built, NodeId a, NodeId b) {
    return transport::computeTouchingCoupling(built.tree, a, makeElementPoints(built.tree, a), b,
                                              makeElementPoints(built.tree, b));
}

// As pairs are computed: by the rule under test where elements touch or are one.
double couplingOf(const Built& built, NodeId a, NodeId b) {
    const ElementPoints onA = makeElementPoints(built.tree, a);
    if (a == b) {
        return transport::computeSelfFactor(onA, transport::makeSelfGrid(built.tree, a)).coupling;
    }
    const ElementPoints onB = makeElementPoints(built.tree, b);
    return transport::isCurvedContact(onA, onB) ? touchingCoupling(built, a, b)
                                                : transport::computePairFactor(onA, onB).coupling;
}

double sumCouplings(const Built& built, const std::vector<NodeId>& from, const std::vector<NodeId>& to) {
    double sum = 0.0;
    for (const NodeId a : from) {
        for (const NodeId b : to) {
            sum += couplingOf(built, a, b);
        }
    }
    return sum;
}

double areaOf(const Built& built, const std::vector<NodeId>& ids) {
    double area = 0.0;
    for (const NodeId id : ids) {
        area += static_cast<double>(built.tree.shape(id).area);
    }
    return area;
}

// Inside of a cylinder closed by two disks: disk to disk is a closed form, the rest follows from closure.
TEST(TouchingFactor, theInsideOfACappedCylinderFollowsTheClosedForms) {
    constexpr double kRadius = .5;
    constexpr double kHeight = .8;
    const double ratio = kHeight / kRadius;
    const double x = 2.0 + ratio * ratio;
    const double capToCap = .5 * (x - std::sqrt(x * x - 4.0));
    const double capArea = kPi * kRadius * kRadius;
    const double sideArea = 2.0 * kPi * kRadius * kHeight;
    const double capToSide = 1.0 - capToCap;
    const double sideToSide = 1.0 - 2.0 * capToSide * capArea / sideArea;
    scene::Scene scene = test::glowingScene("cylinder");
    test::addCappedCylinder(scene, test::leaningAt({1, 2, 3}), kRadius, kHeight, true);
    Built built(std::move(scene));
    // Relative errors of all of the side with itself, and of a cap with the side, by level: 4, 16 and 64
    // elements of each. The kernel is singular where cap and side meet at a right angle.
    constexpr std::array<double, 3> kSelfLimits{.01, .002, .0005};
    constexpr std::array<double, 3> kCapLimits{.02, .004, .001};
    for (std::size_t level = 0; level < kSelfLimits.size(); ++level) {
        if (level > 0) {
            built.split(1);
        }
        const auto isOf = [&](std::uint32_t object) {
            return leavesWhere(built, [&, object](NodeId id) {
                const hierarchy::ElementName name = built.tree.name(id);
                return name.object == object && (object != 0 || !name.back);
            });
        };
        const std::vector<NodeId> side = isOf(0);
        const std::vector<NodeId> cap = isOf(1);
        ASSERT_NEAR(areaOf(built, side), sideArea, 1e-5);
        ASSERT_NEAR(areaOf(built, cap), capArea, 1e-5);
        EXPECT_NEAR(sumCouplings(built, side, side) / (sideArea * sideToSide), 1.0, kSelfLimits[level])
            << level;
        EXPECT_NEAR(sumCouplings(built, cap, side) / (capArea * capToSide), 1.0, kCapLimits[level]) << level;
    }
}

// The kernel between any two points of the inside of a sphere is 1 / (4 pi R2).
TEST(TouchingFactor, octantsOfASphereExchangeByTheirAreas) {
    constexpr double kRadius = 1.5;
    scene::Scene scene = test::glowingScene("sphere");
    test::addCurved(scene, "sphere", std::make_shared<surface::Sphere>(Vec3d(1, 2, 3), kRadius, true));
    const Built built(std::move(scene));
    constexpr double kKernel = 1.0 / (4.0 * kPi * kRadius * kRadius);
    const std::vector<NodeId> octants =
        leavesWhere(built, [&](NodeId id) { return !built.tree.name(id).back; });
    ASSERT_EQ(octants.size(), 8u);
    int touching = 0;
    for (const NodeId a : octants) {
        const ElementPoints onA = makeElementPoints(built.tree, a);
        const transport::PairFactor self =
            transport::computeSelfFactor(onA, transport::makeSelfGrid(built.tree, a));
        EXPECT_NEAR(self.coupling / (onA.area * onA.area * kKernel), 1.0, 1e-9);
        EXPECT_LT(self.spreadA, 1e-9);
        EXPECT_EQ(self.gradientA, Vec2d(0.0));
        for (const NodeId b : octants) {
            const ElementPoints onB = makeElementPoints(built.tree, b);
            if (a == b || !transport::isCurvedContact(onA, onB)) {
                continue;
            }
            EXPECT_NEAR(touchingCoupling(built, a, b) / (onA.area * onB.area * kKernel), 1.0, .02);
            EXPECT_DOUBLE_EQ(touchingCoupling(built, a, b), touchingCoupling(built, b, a));
            ++touching;
        }
    }
    // Three neighbours over an edge and three over a corner.
    EXPECT_GE(touching, 8 * 6);
}

// The inside of a cord: its four patches are hundreds of times as long as wide, and all that they send stays
// in it but for what leaves at its ends, which is as much as two disks send in. Light would grow without end
// where the rows summed to more than 1.
TEST(TouchingFactor, theInsideOfACordClosesToItsEnds) {
    constexpr double kRadius = .003;
    constexpr double kHeight = 1.8;
    scene::Scene scene = test::glowingScene("cord");
    test::addCurved(scene, "cord",
                    std::make_shared<surface::Cylinder>(test::leaningAt({1, 2, 3}), kRadius, kHeight, true));
    Built built(std::move(scene));
    // A quarter of an infinitely long circle keeps what does not pass its chord.
    const double kept = 1.0 - 2.0 * std::sqrt(2.0) / kPi;
    const double atEnds = kRadius / kHeight;
    for (int level = 0; level < 3; ++level) {
        const std::vector<NodeId> side =
            leavesWhere(built, [&](NodeId id) { return !built.tree.name(id).back; });
        if (level == 0) {
            EXPECT_NEAR(couplingOf(built, side[0], side[0]) / areaOf(built, {side[0]}), kept, .001);
        }
        EXPECT_NEAR(sumCouplings(built, side, side) / areaOf(built, side), 1.0 - atEnds, .01) << level;
        built.split(1);
    }
}

TEST(TouchingFactor, whatBendsAwayExchangesNothing) {
    scene::Scene scene = test::glowingScene("sphere");
    test::addCurved(scene, "sphere", std::make_shared<surface::Sphere>(Vec3d(1, 2, 3), 1.0));
    const Built built(std::move(scene));
    const std::vector<NodeId> octants =
        leavesWhere(built, [&](NodeId id) { return !built.tree.name(id).back; });
    ASSERT_EQ(octants.size(), 8u);
    for (const NodeId a : octants) {
        for (const NodeId b : octants) {
            EXPECT_EQ(couplingOf(built, a, b), 0.0);
        }
    }
}

/// A part of a quad's domain.
struct Part {
    std::uint32_t patch = 0;
    Vec2d lower{0.0};
    Vec2d upper{1.0};

    Part quarter(unsigned i) const {
        const Vec2d half = .5 * (upper - lower);
        const Vec2d from = lower + Vec2d(i & 1u, i >> 1) * half;
        return {patch, from, from + half};
    }
};

/// Unoccluded coupling of two parts of one surface, in m2, by 2 x 2 Gauss points each, both quartered until
/// that changes the result by less than a tolerance.
class Quadrature {
  public:
    Quadrature(const surface::Surface& surface, double tolerance)
        : surface_(surface), tolerance_(tolerance) {}

    double integrate(const Part& a, const Part& b) const {
        return refine(a, b, estimate(pointsOf(a), pointsOf(b)), tolerance_, 0);
    }

  private:
    struct Point {
        Vec3d position{};
        Vec3d normal{};
        double area = 0.0;
    };
    using Points = std::array<Point, 4>;

    Points pointsOf(const Part& part) const {
        const double offset = .5 / std::sqrt(3.0);
        const Vec2d size = part.upper - part.lower;
        Points points;
        for (unsigned i = 0; i < points.size(); ++i) {
            const Vec2d at((i & 1u) != 0 ? .5 + offset : .5 - offset,
                           (i & 2u) != 0 ? .5 + offset : .5 - offset);
            const surface::SurfacePoint p = surface_.evaluate(part.patch, part.lower + at * size);
            points[i] = {p.position, p.normal, .25 * size.x * size.y * p.jacobian};
        }
        return points;
    }

    static double estimate(const Points& a, const Points& b) {
        double sum = 0.0;
        for (const Point& p : a) {
            for (const Point& q : b) {
                const Vec3d d = q.position - p.position;
                const double r2 = glm::dot(d, d);
                const double cosines =
                    std::max(0.0, glm::dot(p.normal, d)) * std::max(0.0, -glm::dot(q.normal, d));
                sum += r2 > 0.0 ? p.area * q.area * cosines / (kPi * r2 * r2) : 0.0;
            }
        }
        return sum;
    }

    double refine(const Part& a, const Part& b, double coarse, double tolerance, unsigned depth) const {
        std::array<Points, 4> onA;
        std::array<Points, 4> onB;
        for (unsigned i = 0; i < 4; ++i) {
            onA[i] = pointsOf(a.quarter(i));
            onB[i] = pointsOf(b.quarter(i));
        }
        std::array<double, 16> parts{};
        double sum = 0.0;
        for (unsigned i = 0; i < parts.size(); ++i) {
            parts[i] = estimate(onA[i / 4], onB[i % 4]);
            sum += parts[i];
        }
        // Horizons that pass between the points of a whole part are seen from its quarters.
        constexpr unsigned kLeast = 1;
        constexpr unsigned kMost = 6;
        if (depth >= kMost || (depth >= kLeast && std::abs(sum - coarse) < tolerance)) {
            return sum;
        }
        double result = 0.0;
        for (unsigned i = 0; i < parts.size(); ++i) {
            result += refine(a.quarter(i / 4), b.quarter(i % 4), parts[i], .25 * tolerance, depth + 1);
        }
        return result;
    }

    const surface::Surface& surface_;
    double tolerance_;
};

// Inside of a torus: each of a ring's sixteen patches with itself and with all that it touches.
TEST(TouchingFactor, rowsOfATorusFollowQuadrature) {
    scene::Scene scene = test::glowingScene("torus");
    test::addCurved(scene, "torus",
                    std::make_shared<surface::Torus>(test::leaningAt({1, 2, 3}), .5, .25, true));
    Built built(std::move(scene));
    const surface::Surface& torus = *built.scene.objects[0].surface;
    const Quadrature quadrature(torus, 1e-5);
    // Largest error of a row, relative to the row's sum, of patches and of their quarters.
    constexpr std::array<double, 2> kLimits{.012, .002};
    for (std::size_t level = 0; level < kLimits.size(); ++level) {
        if (level > 0) {
            built.split(1);
        }
        const std::vector<NodeId> leaves =
            leavesWhere(built, [&](NodeId id) { return !built.tree.name(id).back; });
        double worst = 0.0;
        for (const NodeId a : leaves) {
            const hierarchy::ElementName name = built.tree.name(a);
            // By symmetry one ring quarter stands for all.
            if ((name.patch & 3u) != 0) {
                continue;
            }
            const ElementPoints onA = makeElementPoints(built.tree, a);
            const auto partOf = [&](NodeId id) {
                const surface::Region region = built.tree.region(id);
                Part part{built.tree.name(id).patch, region.corners[0], region.corners[0]};
                for (const Vec2d& corner : region.corners) {
                    part.lower = glm::min(part.lower, corner);
                    part.upper = glm::max(part.upper, corner);
                }
                return part;
            };
            double row = 0.0;
            double exact = 0.0;
            for (const NodeId b : leaves) {
                if (a == b || transport::isCurvedContact(onA, makeElementPoints(built.tree, b))) {
                    row += couplingOf(built, a, b);
                    exact += quadrature.integrate(partOf(a), partOf(b));
                }
            }
            ASSERT_GT(exact, 0.0);
            worst = std::max(worst, std::abs(row / exact - 1.0));
        }
        EXPECT_LT(worst, kLimits[level]) << level;
    }
}

TEST(TouchingFactor, pointsOfAnElementWeighItsTrueArea) {
    scene::Scene scene = test::glowingScene("shapes");
    test::addCurved(scene, "sphere", std::make_shared<surface::Sphere>(Vec3d(0.0), 1.0, true));
    test::addCurved(scene, "torus",
                    std::make_shared<surface::Torus>(test::movedTo({4, 0, 0}), .5, .25, true));
    const Built built(std::move(scene));
    for (const NodeId id : leavesWhere(built, [](NodeId) { return true; })) {
        const transport::SelfGrid grid = transport::makeSelfGrid(built.tree, id);
        double sum = 0.0;
        Vec3d flux(0.0);
        for (const auto& p : grid.points) {
            EXPECT_GT(p.weight, 0.0);
            EXPECT_NEAR(glm::length(p.normal), 1.0, 1e-12);
            sum += p.weight;
            flux += p.weight * p.normal;
        }
        EXPECT_NEAR(sum, 1.0, 1e-12);
        if (built.tree.name(id).object == 0) {
            // The flux of an octant's normals is the area of its three shadows: A n = (pi/4, pi/4, pi/4).
            const Vec3d vector = glm::abs(flux) * .5 * kPi;
            // The rule's 8 x 8 points leave 6e-5.
            EXPECT_NEAR(glm::length(vector - Vec3d(.25 * kPi)), 0.0, 1e-4);
        }
    }
}

}  // namespace
}  // namespace fluxwalk
