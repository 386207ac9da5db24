
#include <gtest/gtest.h>

#include "core/surface/sphere.h"
#include "core/transport/exact_form_factor.h"
#include "core/transport/form_factor.h"
#include "tests/support/statistics.h"
#include "tests/transport/polygon_pairs.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec3d;
using test::Built;
using transport::ElementPoints;
using transport::makeElementPoints;
using transport::PairFactor;

// A glowing sphere, object 0, and a small glowing plate, object 1.
scene::Scene sphereAndPlate(const Vec3d& center, double radius, bool inside, const test::Polygon& plate) {
    scene::Scene scene = test::sceneOf({plate});
    scene.objects.insert(scene.objects.begin(),
                         {"sphere", std::make_shared<surface::Sphere>(center, radius, inside), 0});
    return scene;
}

test::Polygon plateAt(const Vec3d& center, const Vec3d& normal, double size) {
    return test::place({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, normal, size, center);
}

std::vector<NodeId> sphereLeaves(const Built& built, bool back) {
    std::vector<NodeId> leaves;
    for (std::uint32_t patch = 0; patch < 8; ++patch) {
        const std::vector<NodeId> below = built.leavesOf(built.tree.patchNode(0, patch, back));
        leaves.insert(leaves.end(), below.begin(), below.end());
    }
    return leaves;
}

TEST(CurvedFactor, elementsOfASphereSumToTheSphere) {
    base::RandomStream random(41);
    const Vec3d center(0.2, -0.1, 0.3);
    // Worst relative errors of a sum over the sphere's elements, by level: 8, 32, 128, 512 elements.
    const std::array<double, 4> limits{0.7, 0.3, 0.03, 0.012};
    for (unsigned level = 0; level < limits.size(); ++level) {
        double worstPoint = 0.0;
        double worstPair = 0.0;
        for (int i = 0; i < 12; ++i) {
            const Vec3d away = test::randomDirection(random);
            const double distance = 1.3 + 4.0 * random.next();
            const Vec3d x = center + distance * away;
            const Vec3d n = test::leaning(-away, 0.5, random);
            Built built(sphereAndPlate(center, 1.0, false, plateAt(x, n, 0.02)));
            built.split(level, [&](NodeId id) { return built.tree.name(id).object == 0; });
            const ElementPoints plate = makeElementPoints(built.tree, built.tree.patchNode(1, 0, false));
            double points = 0.0;
            double pairs = 0.0;
            for (const NodeId id : sphereLeaves(built, false)) {
                const ElementPoints e = makeElementPoints(built.tree, id);
                points += transport::computePointFactor(x, n, e);
                pairs += transport::computePairFactor(plate, e).coupling / plate.area;
            }
            const double exact = transport::pointToSphere(x, n, center, 1.0);
            worstPoint = std::max(worstPoint, std::abs(points / exact - 1.0));
            worstPair = std::max(worstPair, std::abs(pairs / exact - 1.0));
        }
        EXPECT_LT(worstPoint, limits[level]) << level;
        EXPECT_LT(worstPair, limits[level]) << level;
    }
}

// Between any two parts of the inside of a sphere: g = A_a A_b / (4 pi R2), whichever of its sides is the
// inside.
TEST(CurvedFactor, theInsideOfASphereHasOneKernel) {
    for (const bool inside : {true, false}) {
        Built built(sphereAndPlate({0, 0, 0}, 1.5, inside, plateAt({0, 0, 0}, {0, 1, 0}, 0.1)));
        built.split(2, [&](NodeId id) { return built.tree.name(id).object == 0; });
        std::vector<double> errors;
        const std::vector<NodeId> leaves = sphereLeaves(built, !inside);
        double closure = 0.0;
        for (std::size_t i = 0; i < leaves.size(); i += 5) {
            const ElementPoints a = makeElementPoints(built.tree, leaves[i]);
            for (const NodeId other : leaves) {
                if (other == leaves[i]) {
                    continue;
                }
                const ElementPoints b = makeElementPoints(built.tree, other);
                const double exact = a.area * b.area / (4.0 * base::kPi * 1.5 * 1.5);
                const PairFactor f = transport::computePairFactor(a, b);
                errors.push_back(std::abs(f.coupling / exact - 1.0));
                closure += f.coupling / a.area / static_cast<double>((leaves.size() + 4) / 5);
            }
        }
        EXPECT_LT(test::quantile(errors, 0.5), 0.002);
        EXPECT_LT(test::quantile(errors, 1.0), 0.05);
        EXPECT_NEAR(closure, 1.0, 0.02);
    }
}

// On a curved back too, the gradient belongs to the corners in the shape's order.
TEST(CurvedFactor, gradientsPointToTheNearerCorners) {
    for (const bool inside : {true, false}) {
        Built built(sphereAndPlate({0, 0, 0}, 2.0, inside, plateAt({0.9, 0.1, -0.3}, {0.7, 0.1, -0.7}, 0.2)));
        built.split(2, [&](NodeId id) { return built.tree.name(id).object == 0; });
        const ElementPoints plate = makeElementPoints(built.tree, built.tree.patchNode(1, 0, false));
        int checked = 0;
        for (const NodeId id : sphereLeaves(built, !inside)) {
            const ElementPoints e = makeElementPoints(built.tree, id);
            const PairFactor f = transport::computePairFactor(e, plate);
            if (f.coupling < 1e-4 || f.spreadA > 0.2) {
                continue;
            }
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3d n = glm::normalize(-e.corners[i]);
                const double there =
                    transport::pointToPolygon(e.corners[i], n, std::span(plate.corners.data(), 4)) * e.area /
                    f.coupling;
                const base::Vec2d local = transport::localPointCoordinates(3)[4 + i];
                EXPECT_NEAR(1.0 + glm::dot(f.gradientA, local), there, f.spreadA + 0.02);
                ++checked;
            }
        }
        EXPECT_GT(checked, 30);
    }
}

}  // namespace
}  // namespace fluxwalk
