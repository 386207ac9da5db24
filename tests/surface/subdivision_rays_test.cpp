#include <cmath>

#include <gtest/gtest.h>

#include "core/surface/region.h"
#include "core/surface/subdivision_surface.h"
#include "tests/surface/cages.h"

namespace fluxwalk {

namespace {

using base::Vec2d;
using base::Vec3d;
using surface::ControlCage;
using surface::PatchDomain;
using surface::SubdivisionSurface;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3d randomDirection(base::RandomStream& random) {
    for (;;) {
        const Vec3d v(2.0 * random.next() - 1.0, 2.0 * random.next() - 1.0, 2.0 * random.next() - 1.0);
        const double squared = glm::dot(v, v);
        if (squared > 1e-2 && squared < 1.0) {
            return v / std::sqrt(squared);
        }
    }
}

std::vector<ControlCage> closedCages() {
    return {test::cubeCage(), test::octahedronCage(), test::torusCage(8, 6), test::mixedCage(),
            surface::transformCage(test::mixedCage(), test::skewMap(true))};
}

std::vector<ControlCage> allCages() {
    std::vector<ControlCage> cages = closedCages();
    cages.push_back(test::vaseCage());
    cages.push_back(test::openLoopCage());
    return cages;
}

// All hits along a ray, by going on from each.
std::vector<surface::SurfaceHit> allHits(const SubdivisionSurface& surface, const Vec3d& origin,
                                         const Vec3d& direction) {
    std::vector<surface::SurfaceHit> hits;
    double t = 0.0;
    while (const auto hit = surface.intersect(origin, direction, t, kInfinity)) {
        hits.push_back(*hit);
        t = hit->t + 1e-9 * surface.bounds().diagonal();
        EXPECT_LT(hits.size(), 40u);
        if (hits.size() >= 40) {
            break;
        }
    }
    return hits;
}

}  // namespace

TEST(SubdivisionRays, hitsLieOnTheSurfaceAndOnTheRay) {
    base::RandomStream random(1);
    for (const ControlCage& cage : allCages()) {
        const SubdivisionSurface surface(cage);
        const base::Box box = surface.bounds();
        const double size = box.diagonal();
        int met = 0;
        for (int i = 0; i < 4000; ++i) {
            const Vec3d origin = box.center() + size * randomDirection(random);
            const Vec3d target = box.center() + .3 * size * random.next() * randomDirection(random);
            const Vec3d direction = (.1 + 3.0 * random.next()) * (target - origin);
            const auto hit = surface.intersect(origin, direction, 0.0, kInfinity);
            if (!hit) {
                continue;
            }
            ++met;
            EXPECT_LT(
                glm::distance(surface.evaluate(hit->patch, hit->uv).position, origin + hit->t * direction),
                1e-9 * size);
            // The range is open, and what lies before it does not count.
            EXPECT_FALSE(surface.intersect(origin, direction, 0.0, hit->t).has_value());
            const auto next = surface.intersect(origin, direction, hit->t, kInfinity);
            EXPECT_TRUE(!next || next->t > hit->t);
        }
        EXPECT_GT(met, 1000);
    }
}

// The first hit on the way to any point of the surface is that point, or one before it.
TEST(SubdivisionRays, everyPointIsMet) {
    base::RandomStream random(2);
    for (const ControlCage& cage : allCages()) {
        const SubdivisionSurface surface(cage);
        const double size = surface.bounds().diagonal();
        int direct = 0;
        for (int i = 0; i < 3000; ++i) {
            const auto patch = static_cast<std::uint32_t>(i) % surface.patchCount();
            const Vec2d uv =
                surface::mapToRegion(surface::wholePatch(surface.domain(patch)), random.next2()).uv;
            const surface::SurfacePoint p = surface.evaluate(patch, uv);
            // A tenth of a degree from the tangent at the least.
            Vec3d away = randomDirection(random);
            if (std::abs(glm::dot(away, p.normal)) < 2e-3) {
                continue;
            }
            const Vec3d origin = p.position + 2.0 * size * away;
            const auto hits = allHits(surface, origin, -away);
            double nearest = kInfinity;
            for (const surface::SurfaceHit& hit : hits) {
                nearest = std::min(nearest, std::abs(hit.t - 2.0 * size));
            }
            EXPECT_LT(nearest, 1e-9 * size) << patch << ' ' << uv.x << ' ' << uv.y;
            direct += !hits.empty() && std::abs(hits[0].t - 2.0 * size) < 1e-9 * size;
        }
        EXPECT_GT(direct, 500);
    }
}

// Through a closed surface a ray goes in as often as out, in turns.
TEST(SubdivisionRays, closedSurfacesAreEnteredAndLeft) {
    base::RandomStream random(3);
    for (const ControlCage& cage : closedCages()) {
        const SubdivisionSurface surface(cage);
        const base::Box box = surface.bounds();
        for (int i = 0; i < 3000; ++i) {
            const Vec3d origin = box.center() + box.diagonal() * randomDirection(random);
            const Vec3d direction =
                box.center() + .3 * box.diagonal() * random.next() * randomDirection(random) - origin;
            const auto hits = allHits(surface, origin, direction);
            EXPECT_EQ(hits.size() % 2, 0u);
            for (std::size_t k = 0; k < hits.size(); ++k) {
                const Vec3d n = surface.evaluate(hits[k].patch, hits[k].uv).normal;
                EXPECT_EQ(glm::dot(n, direction) < 0.0, k % 2 == 0);
            }
        }
    }
}

// 1e5 rays within 1e-10 to 1e-7 of edges and corners of patches, of their pieces and facets: none passes.
TEST(SubdivisionRays, noRayPassesBetweenPatches) {
    base::RandomStream random(4);
    for (const ControlCage& cage : closedCages()) {
        const SubdivisionSurface surface(cage);
        const double size = surface.bounds().diagonal();
        const bool isRing = surface.patchCount() == 48;
        int missed = 0;
        for (int i = 0; i < 25000; ++i) {
            const auto patch = static_cast<std::uint32_t>(i) % surface.patchCount();
            surface::Region cell = surface::wholePatch(surface.domain(patch));
            for (unsigned level = static_cast<unsigned>(4.0 * random.next() * random.next() * 3.0); level > 0;
                 --level) {
                cell = surface::childRegion(surface, patch, cell, surface::Split::quarters,
                                            static_cast<unsigned>(4.0 * random.next()) & 3u);
            }
            const std::uint32_t k =
                static_cast<std::uint32_t>(random.next() * cell.cornerCount) % cell.cornerCount;
            const double t = i % 4 == 0 ? 0.0 : random.next();
            const Vec2d uv = (1.0 - t) * cell.corners[k] + t * cell.corners[(k + 1) % cell.cornerCount];
            const surface::SurfacePoint p = surface.evaluate(patch, uv);
            const double offset = size * std::pow(10.0, -10.0 + 3.0 * random.next());
            const Vec3d target = p.position + offset * randomDirection(random);
            // From inside, so that whatever way the surface bends there is something to meet: from the middle
            // of the body, or of the ring's tube.
            const Vec3d ring(p.position.x, 0.0, p.position.z);
            const Vec3d inside = isRing ? 2.0 * glm::normalize(ring) : surface.bounds().center();
            missed += !surface.intersect(inside, target - inside, 0.0, 1.0 + 1e-5).has_value();
        }
        EXPECT_EQ(missed, 0);
    }
}

TEST(SubdivisionRays, vaseIsOpenAboveAndBelowOnly) {
    const SubdivisionSurface vase(test::vaseCage());
    base::RandomStream random(5);
    const double lowest = vase.evaluate(0, {0, 0}).position.y;
    const double highest = vase.evaluate(99, {0, 1}).position.y;
    EXPECT_NEAR(lowest, 0.0, 1e-14);
    EXPECT_NEAR(highest, 3.0, 1e-14);
    for (int i = 0; i < 5000; ++i) {
        const double height = lowest + (.001 + .998 * random.next()) * (highest - lowest);
        const double angle = 2.0 * base::kPi * random.next();
        const auto hit =
            vase.intersect({0, height, 0}, {std::cos(angle), 0, std::sin(angle)}, 0.0, kInfinity);
        ASSERT_TRUE(hit.has_value());
        EXPECT_GT(hit->t, .3);
        EXPECT_LT(hit->t, 1.05);
        EXPECT_GT(
            glm::dot(vase.evaluate(hit->patch, hit->uv).normal, Vec3d(std::cos(angle), 0, std::sin(angle))),
            0.0);
    }
    EXPECT_FALSE(vase.intersect({0, -1, 0}, {0, 1, 0}, 0.0, kInfinity).has_value());
    EXPECT_FALSE(vase.intersect({0, 3.01, 0}, {1, 0, .3}, 0.0, kInfinity).has_value());
    EXPECT_FALSE(vase.intersect({0, 1, 0}, {0, 0, 0}, 0.0, kInfinity).has_value());
    // The mouth is the cubic spline circle of its vertices, whose radius at them is (4 + 2 cos 36) / 6.
    const double radius = .65 * (4.0 + 2.0 * std::cos(.2 * base::kPi)) / 6.0;
    EXPECT_NEAR(
        glm::length(Vec2d(vase.evaluate(95, {0, 1}).position.x, vase.evaluate(95, {0, 1}).position.z)),
        radius, 1e-13);
}

// Rays that graze: they meet a sphere-like surface from just inside of the silhouette, and pass just outside.
TEST(SubdivisionRays, silhouettesAreSharp) {
    const SubdivisionSurface torus(test::torusCage(12, 8));
    base::RandomStream random(6);
    const double size = torus.bounds().diagonal();
    int tested = 0;
    for (int i = 0; i < 3000; ++i) {
        // Where the outer half bends away both ways.
        const auto patch = static_cast<std::uint32_t>(i) % torus.patchCount();
        if (torus.canSeeItself(patch, false)) {
            continue;
        }
        const surface::SurfacePoint p = torus.evaluate(patch, random.next2());
        const Vec3d along = glm::normalize(glm::cross(p.normal, randomDirection(random)));
        const Vec3d origin = p.position - .02 * size * along;
        for (const double depth : {1e-5, 1e-7}) {
            EXPECT_TRUE(
                torus.intersect(origin - depth * size * p.normal, along, 0.0, .04 * size).has_value());
            EXPECT_FALSE(
                torus.intersect(origin + depth * size * p.normal, along, 0.0, .04 * size).has_value());
        }
        ++tested;
    }
    EXPECT_GT(tested, 200);
}

// Far away and close by, the hit keeps its digits.
TEST(SubdivisionRays, fromFarAway) {
    const SubdivisionSurface cube(test::cubeCage());
    base::RandomStream random(7);
    for (int i = 0; i < 500; ++i) {
        const surface::SurfacePoint p = cube.evaluate(static_cast<std::uint32_t>(i % 6), random.next2());
        const Vec3d origin = p.position + 1e5 * glm::normalize(p.normal + .5 * randomDirection(random));
        const auto hit = cube.intersect(origin, glm::normalize(p.position - origin), 0.0, kInfinity);
        ASSERT_TRUE(hit.has_value());
        EXPECT_LT(glm::distance(cube.evaluate(hit->patch, hit->uv).position, p.position), 1e-9);
    }
}

}  // namespace fluxwalk
