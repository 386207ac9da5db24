// What holds for every curved shape, placed anywhere: measure, bounds, common edges and parameters.
#include "tests/surface/curved_shapes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <gtest/gtest.h>

namespace fluxwalk {
namespace {

using base::NormalCone;
using surface::PatchDomain;
using surface::SurfacePoint;
using test::CurvedShape;
using test::Placed;
using test::Region;
using test::Surface;
using test::Vec2d;
using test::Vec3d;

class CurvedShapes : public testing::TestWithParam<CurvedShape> {
  protected:
    std::vector<Placed> placed_ = test::placements(GetParam());
};

INSTANTIATE_TEST_SUITE_P(All, CurvedShapes, testing::ValuesIn(test::curvedShapes()),
                         [](const auto& shape) { return shape.param.name; });

bool sameBits(const Vec3d& a, const Vec3d& b) {
    return std::bit_cast<std::array<std::uint64_t, 3>>(std::array{a.x, a.y, a.z}) ==
           std::bit_cast<std::array<std::uint64_t, 3>>(std::array{b.x, b.y, b.z});
}

// Area of a region by 3 x 3 Gauss points in each of 40 x 40 cells.
double fineArea(const Surface& surface, std::uint32_t patch, const Region& region) {
    constexpr int kCells = 40;
    const std::array<double, 3> node{.5 - .5 * std::sqrt(.6), .5, .5 + .5 * std::sqrt(.6)};
    constexpr std::array<double, 3> kWeight{5.0 / 18, 8.0 / 18, 5.0 / 18};
    double sum = 0.0;
    for (int i = 0; i < 3 * kCells; ++i) {
        for (int j = 0; j < 3 * kCells; ++j) {
            const auto a = static_cast<std::size_t>(i % 3);
            const auto b = static_cast<std::size_t>(j % 3);
            double s = (i / 3 + node[a]) / kCells;
            double slope = 1.0;
            if (region.cornerCount == 3) {
                slope = 2.0 * s;
                s *= s;
            }
            const surface::RegionPoint at = surface::mapToRegion(region, {s, (j / 3 + node[b]) / kCells});
            sum += kWeight[a] * kWeight[b] * slope * at.jacobian * surface.evaluate(patch, at.uv).jacobian;
        }
    }
    return sum / (kCells * kCells);
}

TEST_P(CurvedShapes, JacobianAndNormalAreThoseOfTheTangents) {
    base::RandomStream random(1);
    for (const Placed& placed : placed_) {
        for (int i = 0; i < 300; ++i) {
            const std::uint32_t patch = test::randomPatch(*placed.surface, random);
            const Region whole = surface::wholePatch(placed.surface->domain(patch));
            const Vec2d uv = surface::mapToRegion(whole, .02 + .96 * random.next2()).uv;
            constexpr double kStep = 1e-4;
            // Central differences of fourth order.
            const auto tangent = [&](const Vec2d& axis) {
                const auto at = [&](double h) {
                    return placed.surface->evaluate(patch, uv + h * axis).position;
                };
                return (8.0 * (at(kStep) - at(-kStep)) - (at(2 * kStep) - at(-2 * kStep))) / (12.0 * kStep);
            };
            const SurfacePoint p = placed.surface->evaluate(patch, uv);
            const Vec3d area = glm::cross(tangent({1, 0}), tangent({0, 1}));
            ASSERT_NEAR(glm::length(p.normal), 1.0, 1e-14) << placed.name;
            // Counter-clockwise seen from the front, and perpendicular to both tangents.
            ASSERT_NEAR(glm::dot(area, p.normal) / p.jacobian, 1.0, 1e-8) << placed.name;
            ASSERT_LT(glm::distance(glm::normalize(area), p.normal), 1e-8) << placed.name;
        }
    }
}

// At every level, as check 10 of ALGORITHMS section 4 asks of the sphere.
TEST_P(CurvedShapes, AreaIsTheIntegralAndTheSumOfTheParts) {
    base::RandomStream random(2);
    for (const Placed& placed : placed_) {
        for (std::uint32_t patch = 0; patch < placed.surface->patchCount(); patch += 3) {
            const Region whole = surface::wholePatch(placed.surface->domain(patch));
            const double area = placed.surface->area(patch, whole);
            EXPECT_NEAR(fineArea(*placed.surface, patch, whole) / area, 1.0, 1e-9) << placed.name;
            std::vector<Region> level{whole};
            for (int depth = 1; depth <= 4; ++depth) {
                std::vector<Region> next;
                double sum = 0.0;
                for (const Region& region : level) {
                    for (const Region& child :
                         surface::childRegions(*placed.surface, patch, region, surface::Split::quarters)) {
                        next.push_back(child);
                        sum += placed.surface->area(patch, child);
                    }
                }
                EXPECT_NEAR(sum / area, 1.0, 1e-12) << placed.name << ' ' << depth;
                level = std::move(next);
            }
        }
    }
}

TEST_P(CurvedShapes, BoundsHoldAllPointsAndNormalsTightly) {
    base::RandomStream random(3);
    for (const Placed& placed : placed_) {
        const base::Box all = placed.surface->bounds();
        const double size = all.diagonal();
        double widestBox = 0.0;
        double widestCone = 0.0;
        for (int i = 0; i < 100; ++i) {
            const std::uint32_t patch = test::randomPatch(*placed.surface, random);
            const Region region = test::randomElement(*placed.surface, patch, 6, random);
            const surface::RegionBounds bounds = placed.surface->bounds(patch, region);
            base::Box reached;
            std::vector<Vec3d> normals;
            for (int j = 0; j < 104; ++j) {
                const Vec2d uv = j < 4 ? region.corners[static_cast<std::size_t>(j)]
                                       : surface::mapToRegion(region, random.next2()).uv;
                const SurfacePoint p = placed.surface->evaluate(patch, uv);
                reached.extend(p.position);
                normals.push_back(p.normal);
                ASSERT_LE(NormalCone::angleBetween(p.normal, bounds.normals.axis),
                          bounds.normals.halfAngle + 1e-13)
                    << placed.name;
                for (int axis = 0; axis < 3; ++axis) {
                    ASSERT_GE(p.position[axis], bounds.box.lower[axis] - 1e-14 * size) << placed.name;
                    ASSERT_LE(p.position[axis], bounds.box.upper[axis] + 1e-14 * size) << placed.name;
                    ASSERT_GE(p.position[axis], all.lower[axis] - 1e-14 * size) << placed.name;
                    ASSERT_LE(p.position[axis], all.upper[axis] + 1e-14 * size) << placed.name;
                }
            }
            double spread = 0.0;
            for (const Vec3d& a : normals) {
                for (const Vec3d& b : normals) {
                    spread = std::max(spread, NormalCone::angleBetween(a, b));
                }
            }
            widestBox = std::max(widestBox, bounds.box.diagonal() / reached.diagonal());
            // No cone with these normals in it is narrower than half their spread.
            if (spread > 1e-7) {
                widestCone = std::max(widestCone, bounds.normals.halfAngle / (.5 * spread));
            } else {
                EXPECT_LT(bounds.normals.halfAngle, 1e-7) << placed.name;
            }
        }
        EXPECT_LT(widestBox, 2.0) << placed.name;
        EXPECT_LT(widestCone, 1.5) << placed.name;
        // The whole's box is no wider than its patches'.
        base::Box joined;
        for (std::uint32_t patch = 0; patch < placed.surface->patchCount(); ++patch) {
            joined.extend(
                placed.surface->bounds(patch, surface::wholePatch(placed.surface->domain(patch))).box);
        }
        EXPECT_LT(glm::distance(joined.lower, all.lower), 1e-13 * size) << placed.name;
        EXPECT_LT(glm::distance(joined.upper, all.upper), 1e-13 * size) << placed.name;
    }
}

// Points along an edge of a region, as six levels of splitting make them.
std::vector<Vec3d> edgePoints(const Surface& surface, std::uint32_t patch, const Vec2d& from,
                              const Vec2d& to) {
    std::vector<Vec2d> uv{from, to};
    for (int level = 0; level < 6; ++level) {
        std::vector<Vec2d> finer;
        for (std::size_t i = 0; i + 1 < uv.size(); ++i) {
            finer.push_back(uv[i]);
            finer.push_back(surface.splitPoint(patch, uv[i], uv[i + 1]));
        }
        finer.push_back(uv.back());
        uv = std::move(finer);
    }
    std::vector<Vec3d> points;
    for (const Vec2d& at : uv) {
        points.push_back(surface.evaluate(patch, at).position);
    }
    return points;
}

TEST_P(CurvedShapes, NeighboursShareTheirEdgesBitwise) {
    for (const Placed& placed : placed_) {
        std::vector<std::vector<Vec3d>> edges;
        for (std::uint32_t patch = 0; patch < placed.surface->patchCount(); ++patch) {
            const Region whole = surface::wholePatch(placed.surface->domain(patch));
            for (std::uint32_t i = 0; i < whole.cornerCount; ++i) {
                edges.push_back(edgePoints(*placed.surface, patch, whole.corners[i],
                                           whole.corners[(i + 1) % whole.cornerCount]));
            }
        }
        const double near = 1e-9 * placed.surface->bounds().diagonal();
        int shared = 0;
        for (std::size_t a = 0; a < edges.size(); ++a) {
            const std::size_t middle = edges[a].size() / 2;
            if (glm::distance(edges[a].front(), edges[a].back()) < near) {
                // An edge that is one point, as at an apex: in all bits.
                for (const Vec3d& p : edges[a]) {
                    EXPECT_TRUE(sameBits(p, edges[a].front())) << placed.name;
                }
                continue;
            }
            for (std::size_t b = a + 1; b < edges.size(); ++b) {
                if (glm::distance(edges[a][middle], edges[b][middle]) > near) {
                    continue;
                }
                ++shared;
                // Neighbours run along it in opposite directions.
                std::reverse(edges[b].begin(), edges[b].end());
                for (std::size_t i = 0; i < edges[a].size(); ++i) {
                    EXPECT_TRUE(sameBits(edges[a][i], edges[b][i])) << placed.name << ' ' << i;
                }
                std::reverse(edges[b].begin(), edges[b].end());
            }
        }
        EXPECT_EQ(shared, GetParam().sharedEdgeCount) << placed.name;
    }
}

TEST_P(CurvedShapes, LocateInvertsEvaluate) {
    base::RandomStream random(5);
    for (const Placed& placed : placed_) {
        for (int i = 0; i < 1000; ++i) {
            const std::uint32_t patch = test::randomPatch(*placed.surface, random);
            const Region whole = surface::wholePatch(placed.surface->domain(patch));
            // Parameters are as ill-conditioned as circles about the axis are small.
            const Vec2d uv = surface::mapToRegion(whole, .001 + .998 * random.next2()).uv;
            const Vec3d at = placed.surface->evaluate(patch, uv).position;
            const Vec2d back = placed.surface->locate(patch, at);
            ASSERT_LT(glm::distance(back, uv), 1e-10) << placed.name;
            ASSERT_LT(glm::distance(placed.surface->evaluate(patch, back).position, at),
                      1e-14 * (placed.surface->bounds().diagonal() + glm::length(at)))
                << placed.name;
        }
        // Corners and points beyond stay in the patch.
        const Vec2d far = placed.surface->locate(0, Vec3d(1e6, -1e5, 3e5));
        EXPECT_TRUE(far.x >= 0.0 && far.x <= 1.0 && far.y >= 0.0 && far.y <= 1.0) << placed.name;
    }
}

// Textures run continuously within a patch, and a point has one coordinate whatever side is the front.
TEST_P(CurvedShapes, TexcoordsAreContinuousAndOfThePoint) {
    base::RandomStream random(6);
    const test::SurfacePtr outside = GetParam().make(test::Mat4d(1.0), false);
    const test::SurfacePtr inside = GetParam().make(test::Mat4d(1.0), true);
    for (int i = 0; i < 1000; ++i) {
        const std::uint32_t patch = test::randomPatch(*outside, random);
        const Region whole = surface::wholePatch(outside->domain(patch));
        const Vec2d uv = surface::mapToRegion(whole, .01 + .98 * random.next2()).uv;
        const Vec2d here = outside->texcoord(patch, uv, 0);
        EXPECT_TRUE(here.x >= 0.0 && here.x <= 1.0 && here.y >= 0.0 && here.y <= 1.0);
        EXPECT_LT(glm::distance(outside->texcoord(patch, uv + Vec2d(1e-6, -1e-6), 0), here), 1e-4);
        const Vec3d point = outside->evaluate(patch, uv).position;
        EXPECT_LT(glm::distance(inside->texcoord(patch, inside->locate(patch, point), 0), here), 1e-12);
    }
}

TEST_P(CurvedShapes, CanSeeItselfWherePointsDo) {
    base::RandomStream random(7);
    for (const Placed& placed : placed_) {
        for (std::uint32_t patch = 0; patch < placed.surface->patchCount(); ++patch) {
            const Region whole = surface::wholePatch(placed.surface->domain(patch));
            for (const bool back : {false, true}) {
                bool seen = false;
                for (int i = 0; i < 400 && !seen; ++i) {
                    const auto draw = [&] {
                        return placed.surface->evaluate(patch,
                                                        surface::mapToRegion(whole, random.next2()).uv);
                    };
                    const SurfacePoint a = draw();
                    const SurfacePoint b = draw();
                    const Vec3d between = b.position - a.position;
                    const double side = back ? -1.0 : 1.0;
                    const double least = 1e-6 * glm::length(between);
                    seen = side * glm::dot(a.normal, between) > least &&
                           side * glm::dot(b.normal, between) < -least &&
                           !placed.surface->intersect(a.position, between, 1e-6, 1.0 - 1e-6);
                }
                EXPECT_EQ(seen, placed.surface->canSeeItself(patch, back))
                    << placed.name << ' ' << patch << ' ' << back;
            }
        }
    }
}

}  // namespace
}  // namespace fluxwalk
