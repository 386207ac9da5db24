#include "core/surface/smooth_union.h"

#include <gtest/gtest.h>

#include "core/base/normal_cone.h"
#include "core/base/random.h"
#include "tests/surface/projectables.h"

namespace fluxwalk {

namespace {

using base::kPi;
using base::Vec3d;
using surface::Ball;
using surface::SmoothUnion;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3d direction(base::RandomStream& random) {
    const double z = 2.0 * random.next() - 1.0;
    const double phi = 2.0 * kPi * random.next();
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

Vec3d inBox(const surface::Box& box, base::RandomStream& random) {
    return box.lower + Vec3d(random.next(), random.next(), random.next()) * box.size();
}

}  // namespace

TEST(Bernstein, productsAndCuts) {
    // (1 - s) (2 + s) = 2 - s - s^2.
    const surface::Bernstein<3> product =
        surface::multiply(surface::Bernstein<2>{1, 0}, surface::Bernstein<2>{2, 3});
    for (const double s : {0.0, .25, .6, 1.0}) {
        EXPECT_NEAR(surface::valueAt(product, s), 2.0 - s - s * s, 1e-15);
    }
    surface::Bernstein<3> left{};
    surface::Bernstein<3> right{};
    EXPECT_NEAR(surface::cut(product, .3, left, right), 2.0 - .3 - .09, 1e-15);
    EXPECT_NEAR(surface::valueAt(left, .5), 2.0 - .15 - .0225, 1e-15);
    EXPECT_NEAR(surface::valueAt(right, .5), 2.0 - .65 - .4225, 1e-15);
}

// Polynomials of degree 6 with known roots, some of them close to each other or on the middle.
TEST(Bernstein, firstCrossingIsTheFirst) {
    base::RandomStream random(1);
    int tested = 0;
    for (int i = 0; i < 4000; ++i) {
        std::array<double, 6> roots{};
        for (double& root : roots) {
            root = 1.6 * random.next() - .3;
        }
        if (i % 3 == 0) {
            roots[1] = roots[0] + 1e-4;
        }
        if (i % 5 == 0) {
            roots[2] = .5;
        }
        surface::Bernstein<7> f{};
        const auto factor = [&](std::size_t k) { return surface::Bernstein<2>{-roots[k], 1.0 - roots[k]}; };
        const auto pair = [&](std::size_t k) { return surface::multiply(factor(k), factor(k + 1)); };
        f = surface::multiply(surface::multiply(pair(0), pair(2)), pair(4));
        double expected = 2.0;
        for (const double root : roots) {
            expected = root > 0.0 && root < 1.0 ? std::min(expected, root) : expected;
        }
        // How far rounding of the coefficients can move the root.
        double slope = 1.0;
        for (const double root : roots) {
            slope *= root == expected ? 1.0 : std::abs(root - expected);
        }
        const double tolerance = 2e-15 / slope;
        if (expected < 1.0 && tolerance > 1e-5) {
            continue;
        }
        ++tested;
        const auto found = surface::firstCrossing(f);
        ASSERT_EQ(found.has_value(), expected < 1.0) << i;
        if (found) {
            EXPECT_NEAR(*found, expected, tolerance) << i;
        }
    }
    EXPECT_GT(tested, 3000);
}

TEST(SmoothUnion, aSingleBallIsItsSphere) {
    const SmoothUnion ball({{Vec3d(1, 2, 3), .7}});
    const surface::Sphere sphere(Vec3d(1, 2, 3), .7);
    base::RandomStream random(2);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3d from = Vec3d(1, 2, 3) + 3.0 * direction(random);
        const Vec3d to = Vec3d(1, 2, 3) + .8 * direction(random);
        const auto expected = sphere.intersect(from, to - from, 0.0, kInfinity);
        const auto found = ball.intersect(from, to - from, 0.0, kInfinity);
        ASSERT_EQ(found.has_value(), expected.has_value()) << i;
        if (found) {
            ++hits;
            // Where the ray grazes, the root's digits halve.
            const Vec3d normal = (found->position - Vec3d(1, 2, 3)) / .7;
            EXPECT_LT(std::abs(glm::length(normal) - 1.0), 1e-12);
            EXPECT_LT(glm::distance(found->normal, normal), 1e-11);
            const double slope = std::abs(glm::dot(normal, glm::normalize(to - from)));
            EXPECT_NEAR(found->t, expected->t, 1e-13 / slope);
        }
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LT(glm::distance(ball.bounds().lower, Vec3d(.3, 1.3, 2.3)), 1e-10);
}

// Every crossing that dense sampling of f finds is found, at the same place, and none is invented.
TEST(SmoothUnion, raysMeetWhatSamplingMeets) {
    const test::ProjectedUnion blobs;
    const SmoothUnion& object = *blobs.object;
    base::RandomStream random(3);
    int met = 0;
    int grazed = 0;
    for (int i = 0; i < 1500; ++i) {
        const Vec3d origin = inBox(object.bounds(), random);
        // Every other ray grazes: it starts in the tangent plane of a point of the surface, just off it.
        Vec3d from = origin - 4.0 * direction(random);
        Vec3d along = origin - from;
        if (i % 2 == 0) {
            const auto point = object.closestPoint(origin);
            if (!point) {
                continue;
            }
            const Vec3d tangent = glm::normalize(glm::cross(point->normal, direction(random)));
            const Vec3d off = (random.next() - .5) * 2e-4 * point->normal;
            from = point->position + off - 4.0 * tangent;
            along = 4.0 * tangent;
            ++grazed;
        }
        constexpr int kSamples = 4000;
        double first = kInfinity;
        bool inside = object.value(from) < 0.0;
        for (int k = 1; k <= kSamples && first == kInfinity; ++k) {
            const double t = 2.0 * k / kSamples;
            if ((object.value(from + t * along) < 0.0) != inside) {
                first = t;
            }
        }
        const auto hit = object.intersect(from, along, 0.0, 2.0);
        if (first != kInfinity) {
            ++met;
            ASSERT_TRUE(hit.has_value()) << i;
            // Sampling may miss a shorter crossing before.
            ASSERT_LE(hit->t, first + 1e-12) << i;
        }
        if (hit) {
            EXPECT_LT(std::abs(object.value(hit->position)), 1e-13) << i;
            EXPECT_LT(glm::distance(from + hit->t * along, hit->position), 1e-13) << i;
            // The sign does change there.
            const double step = 1e-9;
            const double before = object.value(from + (hit->t - step) * along);
            const double after = object.value(from + (hit->t + step) * along);
            const double slope = std::abs(glm::dot(object.gradient(hit->position), along));
            if (slope > 1e-4) {
                EXPECT_LT(before * after, 0.0) << i;
            }
        }
    }
    EXPECT_GT(met, 400);
    EXPECT_GT(grazed, 600);
}

TEST(SmoothUnion, raysThatStartOnTheSurfaceGoOn) {
    const SmoothUnion two({{Vec3d(0.0), .5}, {Vec3d(3, 0, 0), .5}});
    double t = 0.0;
    std::vector<double> hits;
    while (const auto hit = two.intersect({-2, 0, 0}, {1, 0, 0}, t, 10.0)) {
        hits.push_back(hit->t);
        t = hit->t + 1e-12;
        ASSERT_LE(hits.size(), 4u);
    }
    ASSERT_EQ(hits.size(), 4u);
    constexpr std::array<double, 4> kExpected{1.5, 2.5, 4.5, 5.5};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(hits[i], kExpected[i], 1e-13);
    }
    EXPECT_FALSE(two.intersect({-2, 0, 0}, {0, 0, 0}, 0.0, 10.0).has_value());
    EXPECT_FALSE(two.intersect({-2, 0, 0}, {-1, 0, 0}, 0.0, 10.0).has_value());
    // Backwards, and from far away.
    EXPECT_NEAR(two.intersect({-2, 0, 0}, {-1, 0, 0}, -10.0, 10.0)->t, -5.5, 1e-13);
    EXPECT_NEAR(two.intersect({-1e6, 0, 0}, {1, 0, 0}, 0.0, kInfinity)->t, 1e6 - .5, 1e-9);
}

TEST(SmoothUnion, normalsTurnNoFasterThanTheBoundSays) {
    const test::ProjectedUnion blobs;
    const SmoothUnion& object = *blobs.object;
    base::RandomStream random(4);
    int informative = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto a = object.closestPoint(inBox(object.bounds(), random));
        if (!a) {
            continue;
        }
        const double radius = .2 * random.next();
        const double bound = object.normalVariation(a->position, radius);
        informative += bound < 1.0 ? 1 : 0;
        for (int k = 0; k < 20; ++k) {
            const auto b = object.closestPoint(a->position + radius * random.next() * direction(random));
            if (b && glm::distance(a->position, b->position) <= radius) {
                EXPECT_LE(base::NormalCone::angleBetween(a->normal, b->normal), bound + 1e-9) << i;
            }
        }
    }
    EXPECT_GT(informative, 300);
}

TEST(SmoothUnion, closestPointIsOnTheSurfaceBelowThePosition) {
    const test::ProjectedUnion blobs;
    base::RandomStream random(5);
    int found = 0;
    for (int i = 0; i < 500; ++i) {
        const Vec3d position = inBox(blobs.object->bounds(), random);
        if (const auto point = blobs.object->closestPoint(position)) {
            ++found;
            EXPECT_LT(std::abs(blobs.object->value(point->position)), 1e-11);
            EXPECT_LT(glm::length(glm::cross(position - point->position, point->normal)), 1e-11);
        }
    }
    EXPECT_GT(found, 400);
}

TEST(DualCage, isCoarseClosedAndSound) {
    const test::ProjectedUnion blobs;
    const surface::ProjectionCount& count = blobs.surface.projectionCount();
    EXPECT_LE(blobs.surface.patchCount(), 140u);
    EXPECT_EQ(count.unsnapped, 0u);
    EXPECT_EQ(count.closest, 0u);
    // Euler: a closed surface without handles, of quads: V - E + F = 2 and E = 2 F.
    EXPECT_EQ(blobs.surface.cage().vertices.size(), blobs.surface.patchCount() + 2u);
}

}  // namespace fluxwalk
