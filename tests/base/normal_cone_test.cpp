#include "core/base/normal_cone.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace fluxwalk::base {
namespace {

Vec3d drawDirection(RandomStream& random) {
    const double y = 2.0 * random.next() - 1.0;
    const double angle = 2.0 * kPi * random.next();
    const double r = std::sqrt(std::max(0.0, 1.0 - y * y));
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

/// A direction that leans by `angle` from `axis`.
Vec3d lean(const Vec3d& axis, double angle, RandomStream& random) {
    Vec3d side = glm::cross(axis, drawDirection(random));
    side = glm::normalize(side);
    return std::cos(angle) * axis + std::sin(angle) * side;
}

TEST(NormalCone, AngleIsAccurateNearZeroAndPi) {
    const Vec3d x(1.0, 0.0, 0.0);
    EXPECT_NEAR(NormalCone::angleBetween(x, glm::normalize(Vec3d(1.0, 1e-9, 0.0))), 1e-9, 1e-15);
    EXPECT_NEAR(NormalCone::angleBetween(x, glm::normalize(Vec3d(-1.0, 1e-9, 0.0))), kPi - 1e-9, 1e-15);
    EXPECT_NEAR(NormalCone::angleBetween(x, Vec3d(0.0, 1.0, 0.0)), kPi / 2.0, 1e-15);
}

TEST(NormalCone, MergeOfTwoDirectionsSpansTheAngleBetweenThem) {
    const NormalCone merged = NormalCone::merge({{1.0, 0.0, 0.0}, 0.0}, {{0.0, 1.0, 0.0}, 0.0});
    EXPECT_NEAR(merged.halfAngle, kPi / 4.0, 1e-12);
    EXPECT_NEAR(glm::distance(merged.axis, glm::normalize(Vec3d(1.0, 1.0, 0.0))), 0.0, 1e-12);
}

TEST(NormalCone, MergeKeepsTheLargerConeWhereItHoldsTheOther) {
    const NormalCone wide{{0.0, 0.0, 1.0}, 1.0};
    const NormalCone narrow{glm::normalize(Vec3d(0.1, 0.0, 1.0)), 0.2};
    EXPECT_EQ(NormalCone::merge(wide, narrow).halfAngle, 1.0);
    EXPECT_EQ(NormalCone::merge(narrow, wide).halfAngle, 1.0);
}

TEST(NormalCone, OppositeDirectionsMergeToAllDirections) {
    EXPECT_GE(NormalCone::merge({{0.0, 0.0, 1.0}, 0.3}, {{0.0, 0.0, -1.0}, 0.3}).halfAngle, kPi);
}

TEST(NormalCone, MergeHoldsEveryDirectionOfBoth) {
    RandomStream random(7);
    for (int trial = 0; trial < 2000; ++trial) {
        const NormalCone a{drawDirection(random), 1.5 * random.next()};
        const NormalCone b{drawDirection(random), 1.5 * random.next()};
        const NormalCone merged = NormalCone::merge(a, b);
        for (const NormalCone& part : {a, b}) {
            const Vec3d inside = lean(part.axis, part.halfAngle * random.next(), random);
            EXPECT_LE(NormalCone::angleBetween(merged.axis, inside), merged.halfAngle + 1e-9);
        }
    }
}

TEST(NormalCone, MergeHoldsNearlyOppositeAxesThatWereStoredAsFloat) {
    RandomStream random(8);
    for (int trial = 0; trial < 2000; ++trial) {
        const Vec3d direction = drawDirection(random);
        const double apart = std::pow(10.0, -9.0 * random.next());
        const NormalCone a{Vec3d(Vec3(direction)), 0.5 * random.next()};
        const NormalCone b{Vec3d(Vec3(-lean(direction, apart, random))), 0.5 * random.next()};
        const NormalCone merged = NormalCone::merge(a, b);
        for (const NormalCone& part : {a, b}) {
            EXPECT_LE(NormalCone::angleBetween(merged.axis, part.axis) + part.halfAngle,
                      merged.halfAngle < kPi ? merged.halfAngle + 1e-6 : 2.0 * kPi)
                << apart;
        }
    }
}

}  // namespace
}  // namespace fluxwalk::base
