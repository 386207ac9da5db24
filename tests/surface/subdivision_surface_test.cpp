#include "core/surface/subdivision_surface.h"

#include <bit>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/surface/region.h"
#include "tests/surface/cages.h"

namespace fluxwalk {

namespace {

using base::Vec2d;
using base::Vec3d;
using surface::ControlCage;
using surface::PatchDomain;
using surface::Region;
using surface::SubdivisionSurface;

std::vector<ControlCage> allCages() {
    return {test::cubeCage(),
            test::octahedronCage(),
            test::torusCage(8, 6),
            test::vaseCage(),
            test::mixedCage(),
            test::openLoopCage(),
            surface::transformCage(test::mixedCage(), test::skewMap(true)),
            surface::transformCage(test::openLoopCage(), test::skewMap(true))};
}

Vec2d anywhere(PatchDomain domain, base::RandomStream& random) {
    return surface::mapToRegion(surface::wholePatch(domain), random.next2()).uv;
}

using Bits = std::array<std::uint64_t, 3>;
Bits bitsOf(const Vec3d& p) {
    return std::bit_cast<Bits>(std::array{p.x, p.y, p.z});
}

/// The points of a side at multiples of 1/64 from one end to the other, or of a part of it.
using SidePoints = std::vector<Bits>;

SidePoints pointsBetween(const SubdivisionSurface& surface, std::uint32_t patch, const Vec2d& a,
                         const Vec2d& b) {
    SidePoints points;
    for (int i = 0; i <= 64; ++i) {
        const double t = i / 64.0;
        points.push_back(bitsOf(surface.evaluate(patch, (1.0 - t) * a + t * b).position));
    }
    if (points.back() < points.front()) {
        std::reverse(points.begin(), points.end());
    }
    return points;
}

// Counts sides without an equal one; those next to two halves are compared with these.
std::size_t countFreeSides(const SubdivisionSurface& surface) {
    struct Side {
        std::uint32_t patch;
        Vec2d from;
        Vec2d to;
    };
    std::vector<Side> open;
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        const Region whole = surface::wholePatch(surface.domain(patch));
        for (std::uint32_t k = 0; k < whole.cornerCount; ++k) {
            open.push_back({patch, whole.corners[k], whole.corners[(k + 1) % whole.cornerCount]});
        }
    }
    for (int round = 0; round < 2; ++round) {
        std::map<SidePoints, std::vector<Side>> equal;
        for (const Side& side : open) {
            equal[pointsBetween(surface, side.patch, side.from, side.to)].push_back(side);
        }
        open.clear();
        std::map<std::pair<Bits, Bits>, std::vector<SidePoints>> byEnds;
        for (const auto& [points, sides] : equal) {
            EXPECT_LE(sides.size(), 2u);
            byEnds[{points.front(), points.back()}].push_back(points);
            if (sides.size() == 1) {
                open.push_back(sides[0]);
            }
        }
        if (round == 0) {
            std::vector<Side> parts;
            std::map<Bits, int> ends;
            for (const Side& s : open) {
                ++ends[bitsOf(surface.evaluate(s.patch, s.from).position)];
                ++ends[bitsOf(surface.evaluate(s.patch, s.to).position)];
            }
            for (const Side& s : open) {
                const Vec2d middle = .5 * (s.from + s.to);
                if (ends.count(bitsOf(surface.evaluate(s.patch, middle).position)) != 0) {
                    parts.push_back({s.patch, s.from, middle});
                    parts.push_back({s.patch, middle, s.to});
                } else {
                    parts.push_back(s);
                }
            }
            open = parts;
        }
    }
    return open.size();
}

}  // namespace

// Every point of every edge is bitwise the same from both sides; what is left are the boundaries.
TEST(SubdivisionSurface, neighboursShareTheirEdgesBitwise) {
    EXPECT_EQ(countFreeSides(SubdivisionSurface(test::cubeCage())), 0u);
    EXPECT_EQ(countFreeSides(SubdivisionSurface(test::octahedronCage())), 0u);
    EXPECT_EQ(countFreeSides(SubdivisionSurface(test::torusCage(8, 6))), 0u);
    EXPECT_EQ(countFreeSides(SubdivisionSurface(test::mixedCage())), 0u);
    EXPECT_EQ(countFreeSides(SubdivisionSurface(test::vaseCage())), 20u);
    EXPECT_EQ(countFreeSides(SubdivisionSurface(test::openLoopCage())), 3u);
    const ControlCage moved = surface::transformCage(test::mixedCage(), test::skewMap(true));
    EXPECT_EQ(countFreeSides(SubdivisionSurface(moved)), 0u);
}

// The owner's points are those that the patch would have itself, to rounding.
TEST(SubdivisionSurface, edgesJoinTheInside) {
    for (const ControlCage& cage : allCages()) {
        const SubdivisionSurface surface(cage);
        const double size = surface.bounds().diagonal();
        for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
            const Region whole = surface::wholePatch(surface.domain(patch));
            const Vec2d middle = surface.domain(patch) == PatchDomain::quad ? Vec2d(.5) : Vec2d(1.0 / 3.0);
            for (std::uint32_t k = 0; k < whole.cornerCount; ++k) {
                for (const double t : {0.0, 1e-4, .1, .25, .5, .7, .999}) {
                    const Vec2d on =
                        (1.0 - t) * whole.corners[k] + t * whole.corners[(k + 1) % whole.cornerCount];
                    const Vec2d inside = on + 1e-9 * (middle - on);
                    EXPECT_LT(glm::distance(surface.evaluate(patch, on).position,
                                            surface.evaluate(patch, inside).position),
                              1e-7 * size)
                        << patch << ' ' << k << ' ' << t;
                }
            }
        }
    }
}

TEST(SubdivisionSurface, jacobianAndNormalAreThoseOfTheDerivatives) {
    base::RandomStream random(1);
    for (const ControlCage& cage : allCages()) {
        const SubdivisionSurface surface(cage);
        for (int i = 0; i < 400; ++i) {
            const auto patch = static_cast<std::uint32_t>(i) % surface.patchCount();
            const Vec2d uv = .9 * anywhere(surface.domain(patch), random) + Vec2d(.03);
            const surface::SurfacePoint p = surface.evaluate(patch, uv);
            constexpr double kStep = 1e-6;
            const Vec2d du(kStep, 0);
            const Vec2d dv(0, kStep);
            const Vec3d u =
                (surface.evaluate(patch, uv + du).position - surface.evaluate(patch, uv - du).position) /
                (2.0 * kStep);
            const Vec3d v =
                (surface.evaluate(patch, uv + dv).position - surface.evaluate(patch, uv - dv).position) /
                (2.0 * kStep);
            const Vec3d n = glm::cross(u, v);
            EXPECT_NEAR(glm::length(n) / p.jacobian, 1.0, 1e-6) << patch << ' ' << uv.x << ' ' << uv.y;
            EXPECT_LT(glm::distance(glm::normalize(n), p.normal), 1e-6);
        }
    }
}

TEST(SubdivisionSurface, normalsAreContinuousAcrossSmoothEdgesAndAtExtraordinaryVertices) {
    for (const ControlCage& cage : {test::cubeCage(), test::octahedronCage()}) {
        const SubdivisionSurface surface(cage);
        std::map<Bits, std::vector<Vec3d>> normals;
        for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
            const Region whole = surface::wholePatch(surface.domain(patch));
            for (std::uint32_t k = 0; k < whole.cornerCount; ++k) {
                for (const double t : {0.0, .25, .5}) {
                    const surface::SurfacePoint p = surface.evaluate(
                        patch, (1.0 - t) * whole.corners[k] + t * whole.corners[(k + 1) % whole.cornerCount]);
                    EXPECT_NEAR(glm::length(p.normal), 1.0, 1e-14);
                    EXPECT_GT(glm::dot(p.normal, p.position), 0.0);
                    normals[bitsOf(p.position)].push_back(p.normal);
                }
            }
        }
        for (const auto& [point, list] : normals) {
            for (const Vec3d& n : list) {
                // In caps, 1e-4 of the size, rounding of the positions turns normals by so much.
                EXPECT_LT(glm::distance(n, list[0]), 1e-10);
            }
        }
    }
}

TEST(SubdivisionSurface, cornersRunCounterClockwiseUnderMirrorsToo) {
    for (const bool mirrored : {false, true}) {
        const ControlCage cage = surface::transformCage(test::cubeCage(), test::skewMap(mirrored));
        EXPECT_FALSE(surface::findDefect(cage).has_value());
        const SubdivisionSurface surface(cage);
        const Vec3d center(1, -2, 3);
        for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
            const Vec3d a = surface.evaluate(patch, {0, 0}).position;
            const Vec3d b = surface.evaluate(patch, {1, 0}).position;
            const Vec3d c = surface.evaluate(patch, {1, 1}).position;
            const surface::SurfacePoint middle = surface.evaluate(patch, {.5, .5});
            EXPECT_GT(glm::dot(glm::cross(b - a, c - a), middle.normal), 0.0);
            EXPECT_GT(glm::dot(middle.normal, middle.position - center), 0.0);
        }
    }
}

// The surface of a moved cage is the moved surface.
TEST(SubdivisionSurface, affineMapsCommute) {
    const SubdivisionSurface plain(test::vaseCage());
    const SubdivisionSurface moved(surface::transformCage(test::vaseCage(), test::skewMap(false)));
    base::RandomStream random(2);
    for (std::uint32_t patch = 0; patch < plain.patchCount(); ++patch) {
        const Vec2d uv = random.next2();
        const Vec3d expected(test::skewMap(false) * glm::dvec4(plain.evaluate(patch, uv).position, 1.0));
        EXPECT_LT(glm::distance(moved.evaluate(patch, uv).position, expected), 1e-14 * 20);
    }
}

TEST(SubdivisionSurface, boundsHoldAllPointsAndNormals) {
    base::RandomStream random(3);
    for (const ControlCage& cage : allCages()) {
        const SubdivisionSurface surface(cage);
        for (int i = 0; i < 1500; ++i) {
            const auto patch = static_cast<std::uint32_t>(i) % surface.patchCount();
            const PatchDomain domain = surface.domain(patch);
            Region region = surface::wholePatch(domain);
            if (i % 3 != 0) {
                for (unsigned level = static_cast<unsigned>(i) % 14; level > 0; --level) {
                    region = surface::childRegion(surface, patch, region, surface::Split::quarters,
                                                  static_cast<unsigned>(4.0 * random.next()) & 3u);
                }
            } else {
                // No dyadic fractions: a rectangle, or any triangle.
                const Vec2d a = anywhere(domain, random);
                const Vec2d b = anywhere(domain, random);
                const Vec2d c = anywhere(domain, random);
                const Vec2d lower = glm::min(a, b);
                const Vec2d upper = glm::max(a, b);
                const double turn = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
                region = domain == PatchDomain::quad
                             ? Region{{lower, Vec2d(upper.x, lower.y), upper, Vec2d(lower.x, upper.y)}, 4}
                         : turn > 0.0 ? Region{{a, b, c, c}, 3}
                                      : Region{{a, c, b, b}, 3};
            }
            const surface::RegionBounds bounds = surface.bounds(patch, region);
            for (int k = 0; k < 12; ++k) {
                const Vec2d uv = k < 4 ? region.corners[static_cast<std::size_t>(k)]
                                       : surface::mapToRegion(region, random.next2()).uv;
                const surface::SurfacePoint p = surface.evaluate(patch, uv);
                for (int axis = 0; axis < 3; ++axis) {
                    ASSERT_GE(p.position[axis], bounds.box.lower[axis] - 1e-13);
                    ASSERT_LE(p.position[axis], bounds.box.upper[axis] + 1e-13);
                }
                ASSERT_LE(base::NormalCone::angleBetween(p.normal, bounds.normals.axis),
                          bounds.normals.halfAngle + 1e-9)
                    << i << ' ' << patch << ' ' << k;
            }
        }
    }
}

// Boxes and cones of small regions are at most twice what densely taken samples need.
TEST(SubdivisionSurface, boundsAreTight) {
    for (const ControlCage& cage : {test::cubeCage(), test::vaseCage(), test::octahedronCage()}) {
        const SubdivisionSurface surface(cage);
        for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
            // Four levels down, away from the corners.
            Region region = surface::wholePatch(surface.domain(patch));
            for (const unsigned child : {3u, 1u, 2u, 0u}) {
                region = surface::childRegion(surface, patch, region, surface::Split::quarters, child);
            }
            const surface::RegionBounds bounds = surface.bounds(patch, region);
            base::Box box;
            double angle = 0.0;
            for (int i = 0; i <= 20; ++i) {
                for (int j = 0; j <= 20; ++j) {
                    const surface::SurfacePoint p =
                        surface.evaluate(patch, surface::mapToRegion(region, {i / 20.0, j / 20.0}).uv);
                    box.extend(p.position);
                    angle = std::max(angle, base::NormalCone::angleBetween(p.normal, bounds.normals.axis));
                }
            }
            EXPECT_LT(bounds.box.diagonal(), 1.2 * box.diagonal()) << patch;
            EXPECT_LT(bounds.normals.halfAngle, 2.0 * angle) << patch;
        }
    }
}

// Against the midpoint rule with 256 x 256 points on each of 16 parts, and its children.
TEST(SubdivisionSurface, areas) {
    for (const ControlCage& cage : {test::cubeCage(), test::vaseCage(), test::openLoopCage()}) {
        const SubdivisionSurface surface(cage);
        const std::uint32_t patch = surface.patchCount() / 2;
        const Region whole = surface::wholePatch(surface.domain(patch));
        const double area = surface.area(patch, whole);
        double parts = 0.0;
        double sum = 0.0;
        for (const Region& half : surface::childRegions(surface, patch, whole, surface::Split::quarters)) {
            for (const Region& part : surface::childRegions(surface, patch, half, surface::Split::quarters)) {
                parts += surface.area(patch, part);
                constexpr int kN = 256;
                for (int i = 0; i < kN; ++i) {
                    for (int j = 0; j < kN; ++j) {
                        // The map to triangles is smooth in the root of s.
                        const double x = (i + .5) / kN;
                        const bool isTriangle = part.cornerCount == 3;
                        const surface::RegionPoint at =
                            surface::mapToRegion(part, {isTriangle ? x * x : x, (j + .5) / kN});
                        sum += (isTriangle ? 2.0 * x : 1.0) * at.jacobian *
                               surface.evaluate(patch, at.uv).jacobian / (kN * kN);
                    }
                }
            }
        }
        EXPECT_NEAR(parts / area, 1.0, 1e-12);
        EXPECT_NEAR(sum / area, 1.0, 2e-6);
        // Parts that are no quarters of quarters: three strips make the whole.
        if (whole.cornerCount == 4) {
            double strips = 0.0;
            for (const auto& [a, b] : {std::pair{0.0, .3}, {.3, .71}, {.71, 1.0}}) {
                strips += surface.area(patch, {{Vec2d(a, 0), Vec2d(b, 0), Vec2d(b, 1), Vec2d(a, 1)}, 4});
            }
            EXPECT_NEAR(strips / area, 1.0, 1e-8);
        } else {
            const Vec2d p(.3, .37);
            double fan = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                fan += surface.area(patch, {{p, whole.corners[k], whole.corners[(k + 1) % 3], p}, 3});
            }
            EXPECT_NEAR(fan / area, 1.0, 1e-8);
        }
    }
}

TEST(SubdivisionSurface, locateInvertsEvaluate) {
    base::RandomStream random(4);
    for (const ControlCage& cage : allCages()) {
        const SubdivisionSurface surface(cage);
        const double size = surface.bounds().diagonal();
        for (int i = 0; i < 300; ++i) {
            const auto patch = static_cast<std::uint32_t>(i) % surface.patchCount();
            const surface::SurfacePoint p = surface.evaluate(patch, anywhere(surface.domain(patch), random));
            // As rays in float meet it: somewhat off.
            const Vec3d off = p.position + 1e-7 * size * (random.next() - .5) * p.normal;
            const Vec3d found = surface.evaluate(patch, surface.locate(patch, off)).position;
            EXPECT_LT(glm::distance(found, p.position), 1e-9 * size) << patch;
        }
    }
}

TEST(SubdivisionSurface, patchesThatCannotSeeThemselves) {
    const SubdivisionSurface torus(test::torusCage(12, 8));
    base::RandomStream random(5);
    int blind = 0;
    for (std::uint32_t patch = 0; patch < torus.patchCount(); ++patch) {
        for (const bool back : {false, true}) {
            if (torus.canSeeItself(patch, back)) {
                continue;
            }
            ++blind;
            for (int i = 0; i < 300; ++i) {
                const surface::SurfacePoint a = torus.evaluate(patch, random.next2());
                const surface::SurfacePoint b = torus.evaluate(patch, random.next2());
                EXPECT_LE((back ? -1.0 : 1.0) * glm::dot(a.normal, b.position - a.position), 1e-12);
            }
        }
        EXPECT_TRUE(torus.canSeeItself(patch, true));
    }
    // The outer side at least is blind: rings 7 and 0 of 8 lie about the equator.
    EXPECT_GE(blind, 24);
    // A flat cage sees itself from neither side.
    ControlCage flat;
    for (int i = 0; i < 16; ++i) {
        flat.positions.emplace_back(i % 4, 0.0, -(i / 4));
    }
    for (std::uint32_t i = 0; i < 9; ++i) {
        const std::uint32_t v = i / 3 * 4 + i % 3;
        test::addFace(flat, {v, v + 1, v + 5, v + 4});
    }
    const SubdivisionSurface plane(flat);
    EXPECT_FALSE(plane.canSeeItself(4, false));
    EXPECT_FALSE(plane.canSeeItself(4, true));
    EXPECT_NEAR(plane.area(0, surface::wholePatch(PatchDomain::quad)), 1.0, 1e-12);
    EXPECT_LT(plane.bounds(4, surface::wholePatch(PatchDomain::quad)).normals.halfAngle, 1e-9);
}

TEST(SubdivisionSurface, texcoordsAreThoseOfTheCorners) {
    ControlCage cage = test::mixedCage();
    for (std::size_t i = 0; i < cage.corners.size(); ++i) {
        cage.texcoords[1].emplace_back(static_cast<float>(i), -static_cast<float>(i));
    }
    const SubdivisionSurface surface(cage);
    // The pentagon's sub-faces, then a quad.
    EXPECT_EQ(surface.texcoord(2, {0, 0}, 1), Vec2d(2, -2));
    EXPECT_EQ(surface.texcoord(2, {1, 0}, 1), Vec2d(2.5, -2.5));
    EXPECT_NEAR(surface.texcoord(2, {1, 1}, 1).x, 2.0, 1e-6);
    EXPECT_EQ(surface.texcoord(2, {0, 1}, 1), Vec2d(1.5, -1.5));
    EXPECT_EQ(surface.texcoord(5, {1, 0}, 1), Vec2d(6, -6));
    EXPECT_EQ(surface.texcoord(5, {.5, .5}, 1), Vec2d(6.5, -6.5));
    EXPECT_EQ(surface.texcoord(5, {.5, .5}, 0), Vec2d(0, 0));
    // A mirror takes the coordinates along with their corners.
    const SubdivisionSurface mirrored(surface::transformCage(cage, test::skewMap(true)));
    EXPECT_EQ(mirrored.texcoord(5, {1, 0}, 1), Vec2d(8, -8));
}

// Cages at the edge of what is sound: two faces back to back, a ring drawn together, and many faces at a
// vertex.
TEST(SubdivisionSurface, unusualCagesStayFinite) {
    ControlCage pillow;
    pillow.positions = {{0, 0, 0}, {1, 0, .2}, {1, 1, 0}, {0, 1, .1}};
    test::addFace(pillow, {0, 1, 2, 3});
    test::addFace(pillow, {3, 2, 1, 0});
    ControlCage pole = test::vaseCage();
    for (std::size_t i = 0; i < 10; ++i) {
        // The lowest ring is one point, ten times.
        pole.positions[i] = {0, 0, 0};
    }
    ControlCage loopWheel = test::wheelCage(40);
    loopWheel.scheme = surface::SubdivisionScheme::loop;
    for (const ControlCage& cage : {pillow, pole, test::wheelCage(40), loopWheel}) {
        ASSERT_EQ(surface::findDefect(cage).value_or("none"), "none");
        const SubdivisionSurface surface(cage);
        for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
            const Region whole = surface::wholePatch(surface.domain(patch));
            EXPECT_TRUE(std::isfinite(surface.area(patch, whole)));
            const surface::RegionBounds bounds = surface.bounds(patch, whole);
            for (std::uint32_t k = 0; k < whole.cornerCount; ++k) {
                const surface::SurfacePoint p = surface.evaluate(patch, whole.corners[k]);
                EXPECT_NEAR(glm::length(p.normal), 1.0, 1e-12);
                EXPECT_LE(base::NormalCone::angleBetween(p.normal, bounds.normals.axis),
                          bounds.normals.halfAngle + 1e-9);
            }
            const Vec3d middle = surface.evaluate(patch, Vec2d(.3)).position;
            const auto hit = surface.intersect(middle + Vec3d(3, 4, 5), Vec3d(-3, -4, -5), 0.0, 2.0);
            EXPECT_TRUE(hit.has_value() && hit->t < 1.0 + 1e-9) << patch;
        }
    }
}

}  // namespace fluxwalk
