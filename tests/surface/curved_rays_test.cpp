// Rays against every curved shape: where they meet it, and that none slips through.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/random_scenes.h"
#include "tests/surface/curved_shapes.h"

namespace fluxwalk {
namespace {

using surface::SurfacePoint;
using test::CurvedShape;
using test::Placed;
using test::Region;
using test::Surface;
using test::Vec2d;
using test::Vec3d;

constexpr double kInf = std::numeric_limits<double>::infinity();

class CurvedRays : public testing::TestWithParam<CurvedShape> {
  protected:
    std::vector<Placed> placed_ = test::placements(GetParam(), 8);
};

INSTANTIATE_TEST_SUITE_P(All, CurvedRays, testing::ValuesIn(test::curvedShapes()),
                         [](const auto& shape) { return shape.param.name; });

// A direction to the front side that does not graze.
Vec3d frontDirection(const Vec3d& normal, base::RandomStream& random) {
    for (;;) {
        Vec3d d = test::randomDirection(random);
        const double cosine = glm::dot(d, normal);
        if (std::abs(cosine) > .05) {
            return cosine > 0.0 ? d : -d;
        }
    }
}

TEST_P(CurvedRays, MeetWhatTheyAreAimedAt) {
    base::RandomStream random(1);
    for (const Placed& placed : placed_) {
        const Surface& shape = *placed.surface;
        const double size = shape.bounds().diagonal();
        for (int i = 0; i < 2000; ++i) {
            const std::uint32_t patch = test::randomPatch(shape, random);
            const Region whole = surface::wholePatch(shape.domain(patch));
            const Vec2d uv = surface::mapToRegion(whole, .01 + .98 * random.next2()).uv;
            const SurfacePoint p = shape.evaluate(patch, uv);
            const double away = size * std::pow(10.0, -2.0 + 5.0 * random.next());
            const double speed = .1 + 10.0 * random.next();
            const Vec3d d = -speed * frontDirection(p.normal, random);
            const Vec3d from = p.position - away * d;
            const double tolerance = 1e-14 * (1.0 + away) / .05;
            // Just before the point, so that nothing else is in between.
            const auto hit = shape.intersect(from, d, away - 1e-7 * size, away + 1e-7 * size);
            ASSERT_TRUE(hit.has_value()) << placed.name << ' ' << away;
            ASSERT_EQ(hit->patch, patch) << placed.name;
            ASSERT_LT(std::abs(hit->t - away) * speed, tolerance * (speed + 1.0) + 1e-13 * away * speed)
                << placed.name;
            ASSERT_LT(glm::distance(shape.evaluate(patch, hit->uv).position, p.position),
                      1e-12 * (size + speed * away))
                << placed.name;
            // The first hit is on the ray, on the surface, and not behind it.
            const auto first = shape.intersect(from, d, 0.0, kInf);
            ASSERT_TRUE(first.has_value()) << placed.name;
            ASSERT_LE(first->t, hit->t) << placed.name;
            ASSERT_LT(glm::distance(shape.evaluate(first->patch, first->uv).position, from + first->t * d),
                      1e-12 * (size + speed * away))
                << placed.name;
            // Nothing is met in an empty range or by a ray that leaves the point forwards.
            ASSERT_FALSE(shape.intersect(from, d, first->t, first->t).has_value());
            const auto again = shape.intersect(p.position, -d, 1e-10 * size, 1e-5 * size);
            ASSERT_FALSE(again.has_value()) << placed.name << ' ' << again->t;
        }
    }
}

TEST_P(CurvedRays, MissWhatIsBesideAndRefuseWhatIsNoRay) {
    base::RandomStream random(2);
    for (const Placed& placed : placed_) {
        const base::Box box = placed.surface->bounds();
        for (int i = 0; i < 500; ++i) {
            // Through the plane of a face of the box, away from it.
            const Vec3d at = box.center() + test::randomPoint(random, box.diagonal());
            const int axis = i % 3;
            Vec3d from = at;
            from[axis] = box.upper[axis] + 1e-9 * box.diagonal();
            Vec3d d = test::randomDirection(random);
            d[axis] = std::abs(d[axis]);
            EXPECT_FALSE(placed.surface->intersect(from, d, 0.0, kInf).has_value()) << placed.name;
            from[axis] = box.lower[axis] - 1e-9 * box.diagonal();
            d[axis] = -d[axis];
            EXPECT_FALSE(placed.surface->intersect(from, d, 0.0, kInf).has_value()) << placed.name;
        }
        const Vec3d origin = box.center();
        const double nan = std::numeric_limits<double>::quiet_NaN();
        EXPECT_FALSE(placed.surface->intersect(origin, Vec3d(0.0), 0.0, kInf).has_value()) << placed.name;
        EXPECT_FALSE(placed.surface->intersect(origin, Vec3d(nan, 1, 0), 0.0, kInf).has_value());
        EXPECT_FALSE(placed.surface->intersect(Vec3d(nan), Vec3d(0, 1, 0), 0.0, kInf).has_value());
        EXPECT_FALSE(placed.surface->intersect(Vec3d(kInf, 0, 0), Vec3d(-1, 0, 0), 0.0, kInf).has_value());
    }
}

// Elements' edges and corners are where samples fall and where tessellations leak.
TEST_P(CurvedRays, NonePassesBetweenElements) {
    base::RandomStream random(3);
    int passed = 0;
    int shot = 0;
    for (const Placed& placed : placed_) {
        const Surface& shape = *placed.surface;
        const double size = shape.bounds().diagonal();
        for (int i = 0; i < 10000; ++i) {
            const std::uint32_t patch = test::randomPatch(shape, random);
            const Region region = test::randomElement(shape, patch, 5, random);
            const auto corner = static_cast<std::uint32_t>(random.next() * region.cornerCount);
            const Vec2d next = region.corners[(corner + 1) % region.cornerCount];
            const double along = i % 3 == 0 ? 0.0 : random.next();
            const Vec2d onEdge = region.corners[corner] + along * (next - region.corners[corner]);
            const Vec2d middle = surface::mapToRegion(region, Vec2d(.5)).uv;
            // On the surface and 1e-10 to 1e-7 of the size off the edge.
            const Vec3d edge = shape.evaluate(patch, onEdge).position;
            const double reach = glm::distance(shape.evaluate(patch, middle).position, edge);
            const double off = size * std::pow(10.0, -10.0 + 3.0 * random.next()) / reach;
            const SurfacePoint p = shape.evaluate(patch, onEdge + std::min(off, 1.0) * (middle - onEdge));
            const Vec3d towards = frontDirection(p.normal, random);
            const double away = size * (.01 + 3.0 * random.next());
            ++shot;
            passed += shape.intersect(p.position + away * towards, -towards, 0.0, away + 1e-5 * size) ? 0 : 1;
        }
    }
    EXPECT_GE(shot, 100000);
    EXPECT_EQ(passed, 0);
}

}  // namespace
}  // namespace fluxwalk
