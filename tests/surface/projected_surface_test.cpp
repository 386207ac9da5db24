#include "core/surface/projected_surface.h"

#include <bit>

#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "tests/surface/projectables.h"

namespace fluxwalk {

namespace {

using base::kPi;
using base::Vec2d;
using base::Vec3d;
using surface::Region;
using surface::SurfacePoint;
using test::areaAt;
using test::forElements;
using test::inRegion;
using test::shapes;
using test::wholeOf;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool sameBits(const Vec3d& a, const Vec3d& b) {
    return std::bit_cast<std::array<std::uint64_t, 3>>(std::array{a.x, a.y, a.z}) ==
           std::bit_cast<std::array<std::uint64_t, 3>>(std::array{b.x, b.y, b.z});
}

}  // namespace

// Issue: same vertices as the sphere's own parameterisation, to 1e-5 of its size.
TEST(ProjectedSurface, sphereHasTheVerticesOfItsOwnParameterisation) {
    const test::ProjectedSphere& generic = shapes().sphere;
    const surface::Sphere& exact = generic.object->sphere();
    std::vector<Vec3d> expected;
    std::vector<Vec3d> found;
    constexpr unsigned kLevel = 5;
    const auto collect = [](const surface::Surface& surface, std::vector<Vec3d>& into) {
        forElements(surface, kLevel, [&](auto patch, const Region& r) {
            for (std::size_t k = 0; k < 3; ++k) {
                into.push_back(surface.evaluate(patch, r.corners[k]).position);
            }
        });
    };
    collect(exact, expected);
    collect(generic.surface, found);
    ASSERT_EQ(found.size(), expected.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        worst = std::max(worst, glm::distance(found[i], expected[i]));
    }
    EXPECT_LT(worst, 1e-12);
}

// The paper's recursion taken literally: the middle of each edge goes along the mean of the end normals. The
// first split is the same everywhere; on the sphere all are.
TEST(ProjectedSurface, verticesAreThoseOfTheLiteralRecursion) {
    struct Vertex {
        Vec3d position;
        Vec3d normal;
    };
    for (const surface::ProjectedSurface* surface : shapes().all()) {
        const surface::Projectable& object = surface->object();
        const auto literal = [&](const Vertex& a, const Vertex& b) {
            const Vec3d middle = .5 * (a.position + b.position);
            const Vec3d d = .5 * (a.normal + b.normal);
            const double reach = glm::distance(a.position, b.position) / glm::length(d);
            const auto ahead = object.intersect(middle, d, -1e-12, reach);
            const auto behind = object.intersect(middle, -d, -1e-12, reach);
            EXPECT_TRUE(ahead || behind);
            const bool forwards = ahead && (!behind || ahead->t <= behind->t);
            return forwards ? Vertex{ahead->position, ahead->normal}
                            : Vertex{behind->position, behind->normal};
        };
        const auto vertexAt = [&](std::uint32_t patch, const Vec2d& uv) {
            const SurfacePoint p = surface->evaluate(patch, uv);
            return Vertex{p.position, p.normal};
        };
        double first = 0.0;
        double later = 0.0;
        for (std::uint32_t patch = 0; patch < surface->patchCount(); ++patch) {
            const Region whole = wholeOf(*surface, patch);
            for (std::uint32_t k = 0; k < whole.cornerCount; ++k) {
                const Vec2d a = whole.corners[k];
                const Vec2d b = whole.corners[(k + 1) % whole.cornerCount];
                const Vertex from = vertexAt(patch, a);
                const Vertex to = vertexAt(patch, b);
                const double edge = glm::distance(from.position, to.position);
                const Vec2d middle = surface->splitPoint(patch, a, b);
                const Vertex here = literal(from, to);
                first =
                    std::max(first, glm::distance(here.position, vertexAt(patch, middle).position) / edge);
                const Vec2d quarter = surface->splitPoint(patch, a, middle);
                later = std::max(
                    later,
                    glm::distance(literal(from, here).position, vertexAt(patch, quarter).position) / edge);
            }
        }
        EXPECT_LT(first, 1e-12);
        // As parts of the edge. They lie on the object either way, some way apart.
        EXPECT_LT(later, surface == &shapes().sphere.surface ? 1e-12 : .1);
    }
}

TEST(ProjectedSurface, verticesLieOnTheTorus) {
    const test::ProjectedTorus& torus = shapes().torus;
    double worst = 0.0;
    forElements(torus.surface, 4, [&](auto patch, const Region& r) {
        for (std::size_t k = 0; k < 4; ++k) {
            const SurfacePoint p = torus.surface.evaluate(patch, r.corners[k]);
            worst = std::max(worst, glm::distance(p.position, torus.object->nearestPoint(p.position)));
            ASSERT_LT(glm::distance(p.normal, torus.object->normalAt(p.position)), 1e-9);
        }
    });
    EXPECT_LT(worst, 1e-10 * torus.object->bounds().diagonal());
    // Inside the ring the chords lie outside the solid: the direction is reversed there.
    const surface::ProjectionCount& count = torus.surface.projectionCount();
    EXPECT_EQ(count.unsnapped, 0u);
    EXPECT_EQ(count.closest, 0u);
    EXPECT_GT(count.reversed, count.points / 20);
    EXPECT_LT(count.reversed, count.points / 2);
    EXPECT_EQ(shapes().sphere.surface.projectionCount().reversed, 0u) << "convex";
    EXPECT_GT(shapes().blobs.surface.projectionCount().reversed, 0u) << "the necks are hollow";
}

TEST(ProjectedSurface, areasAreTheTrueOnesAtEveryLevel) {
    const double sphere = 4.0 * kPi * .49;
    const double torus = 4.0 * kPi * kPi * test::ProjectedTorus::kMajor * test::ProjectedTorus::kMinor;
    for (const unsigned level : {0u, 3u, 4u}) {
        EXPECT_NEAR(areaAt(shapes().sphere.surface, level) / sphere, 1.0, 1e-9) << level;
        EXPECT_NEAR(areaAt(shapes().torus.surface, level) / torus, 1.0, 1e-9) << level;
    }
}

TEST(ProjectedSurface, partsAddUpToTheirParent) {
    for (const surface::ProjectedSurface* surface : shapes().all()) {
        double coarse = 0.0;
        double fine = 0.0;
        for (unsigned level = 0; level < 4; ++level) {
            std::size_t element = 0;
            forElements(*surface, level, [&](auto patch, const Region& r) {
                if (element++ % (level + 1) != 0) {
                    return;
                }
                double sum = 0.0;
                for (const Region& part :
                     surface::childRegions(*surface, patch, r, surface::Split::quarters)) {
                    sum += surface->area(patch, part);
                }
                double& worst = level < 2 ? coarse : fine;
                worst = std::max(worst, std::abs(sum / surface->area(patch, r) - 1.0));
            });
        }
        EXPECT_LT(coarse, 1e-12);
        // One Gauss rule against four. The union is only twice differentiable where the reach of a ball ends,
        // which costs quadrature its order there.
        EXPECT_LT(fine, surface == &shapes().blobs.surface ? 1e-5 : 1e-9);
    }
}

TEST(ProjectedSurface, neighboursShareTheirEdgesBitwise) {
    for (const surface::ProjectedSurface* surface : shapes().all()) {
        const surface::Cage& cage = surface->cage();
        const auto corners = [&](std::uint32_t f) { return cage.faces[f][2] == cage.faces[f][3] ? 3u : 4u; };
        std::size_t shared = 0;
        for (std::uint32_t f = 0; f < cage.faces.size(); ++f) {
            for (std::uint32_t g = f + 1; g < cage.faces.size(); ++g) {
                for (std::uint32_t i = 0; i < corners(f); ++i) {
                    for (std::uint32_t j = 0; j < corners(g); ++j) {
                        const std::uint32_t iNext = (i + 1) % corners(f);
                        const std::uint32_t jNext = (j + 1) % corners(g);
                        if (cage.faces[f][i] != cage.faces[g][jNext] ||
                            cage.faces[f][iNext] != cage.faces[g][j]) {
                            continue;
                        }
                        ++shared;
                        const Region a = wholeOf(*surface, f);
                        const Region b = wholeOf(*surface, g);
                        const auto descend = [&](const auto& self, Vec2d s0, Vec2d s1, Vec2d t0, Vec2d t1,
                                                 unsigned level) -> void {
                            const Vec2d s = surface->splitPoint(f, s0, s1);
                            const Vec2d t = surface->splitPoint(g, t0, t1);
                            ASSERT_EQ(s, surface->splitPoint(f, s1, s0));
                            const SurfacePoint p = surface->evaluate(f, s);
                            const SurfacePoint q = surface->evaluate(g, t);
                            ASSERT_TRUE(sameBits(p.position, q.position)) << f << ' ' << g << ' ' << level;
                            ASSERT_TRUE(sameBits(p.normal, q.normal)) << f << ' ' << g << ' ' << level;
                            if (level < 6) {
                                self(self, s0, s, t0, t, level + 1);
                                self(self, s, s1, t, t1, level + 1);
                            }
                        };
                        EXPECT_TRUE(sameBits(surface->evaluate(f, a.corners[i]).position,
                                             surface->evaluate(g, b.corners[jNext]).position));
                        descend(descend, a.corners[i], a.corners[iNext], b.corners[jNext], b.corners[j], 1);
                    }
                }
            }
        }
        // Closed: every side of every face has its neighbour.
        std::size_t sides = 0;
        for (std::uint32_t f = 0; f < cage.faces.size(); ++f) {
            sides += corners(f);
        }
        EXPECT_EQ(2 * shared, sides);
    }
}

// The map inside a patch runs up to its edges without a jump, although those are computed on their own.
TEST(ProjectedSurface, edgesContinueTheInside) {
    base::RandomStream random(1);
    for (const surface::ProjectedSurface* surface : shapes().all()) {
        for (std::uint32_t patch = 0; patch < surface->patchCount(); ++patch) {
            const double s = random.next();
            const SurfacePoint edge = surface->evaluate(patch, {s, 0.0});
            const SurfacePoint inside = surface->evaluate(patch, {s, 1e-12});
            EXPECT_LT(glm::distance(edge.position, inside.position), 1e-10);
            EXPECT_NEAR(edge.jacobian / inside.jacobian, 1.0, 1e-8);
        }
    }
}

TEST(ProjectedSurface, jacobianIsThatOfTheMap) {
    base::RandomStream random(2);
    for (const surface::ProjectedSurface* surface : shapes().all()) {
        for (std::uint32_t patch = 0; patch < surface->patchCount(); ++patch) {
            const Vec2d uv = .8 * inRegion(wholeOf(*surface, patch), random) + Vec2d(.05);
            const SurfacePoint p = surface->evaluate(patch, uv);
            constexpr double kStep = 1e-5;
            const auto slope = [&](const Vec2d& step) {
                return (surface->evaluate(patch, uv + step).position -
                        surface->evaluate(patch, uv - step).position) /
                       (2.0 * kStep);
            };
            const Vec3d across = glm::cross(slope({kStep, 0.0}), slope({0.0, kStep}));
            EXPECT_NEAR(glm::length(across) / p.jacobian, 1.0, 1e-7);
            EXPECT_NEAR(glm::dot(across, p.normal) / p.jacobian, 1.0, 1e-7) << "counter-clockwise";
        }
    }
}

TEST(ProjectedSurface, nothingFolds) {
    for (const surface::ProjectedSurface* surface : shapes().all()) {
        for (unsigned level = 1; level < 5; ++level) {
            forElements(*surface, level, [&](auto patch, const Region& r) {
                std::array<SurfacePoint, 4> c;
                for (std::size_t k = 0; k < r.cornerCount; ++k) {
                    c[k] = surface->evaluate(patch, r.corners[k]);
                }
                const Vec3d across =
                    r.cornerCount == 3
                        ? glm::cross(c[1].position - c[0].position, c[2].position - c[0].position)
                        : glm::cross(c[2].position - c[0].position, c[3].position - c[1].position);
                ASSERT_GT(glm::dot(glm::normalize(across), c[0].normal), level < 3 ? .087 : .7)
                    << patch << ' ' << level;
            });
        }
    }
}

TEST(ProjectedSurface, locateInvertsEvaluate) {
    base::RandomStream random(4);
    for (const surface::ProjectedSurface* surface : shapes().all()) {
        for (int i = 0; i < 2000; ++i) {
            const auto patch = static_cast<std::uint32_t>(i) % surface->patchCount();
            const Vec2d uv = inRegion(wholeOf(*surface, patch), random);
            const SurfacePoint p = surface->evaluate(patch, uv);
            ASSERT_LT(glm::distance(surface->locate(patch, p.position), uv), 1e-10) << patch;
            // A little off the surface: the nearest point's parameter.
            const Vec3d off = p.position + 1e-4 * p.normal;
            ASSERT_LT(
                glm::distance(surface->evaluate(patch, surface->locate(patch, off)).position, p.position),
                1e-3);
        }
        // Outside of the patch: its border.
        const Vec2d far = surface->locate(0, surface->bounds().upper + 10.0);
        EXPECT_GE(std::min(far.x, far.y), 0.0);
        EXPECT_LE(std::max(far.x, far.y), 1.0);
    }
}

TEST(ProjectedSurface, raysAndParameterisationAgreeOnWhereTheSurfaceIs) {
    base::RandomStream random(5);
    for (const surface::ProjectedSurface* surface : shapes().all()) {
        const surface::Box box = surface->bounds();
        int hits = 0;
        for (int i = 0; i < 5000; ++i) {
            const auto point = [&] {
                return box.lower + Vec3d(random.next(), random.next(), random.next()) * box.size();
            };
            const Vec3d from = point() + 2.0 * (point() - box.center());
            const Vec3d direction = point() - from;
            if (const auto hit = surface->intersect(from, direction, 0.0, kInfinity)) {
                ++hits;
                const Vec3d met = from + hit->t * direction;
                const SurfacePoint p = surface->evaluate(hit->patch, hit->uv);
                ASSERT_LT(glm::distance(p.position, met), 1e-8) << i;
            }
        }
        EXPECT_GT(hits, 1000);
    }
}

TEST(ProjectedSurface, onlyTheOutsideOfAConvexObjectSurelySeesNothingOfItself) {
    EXPECT_FALSE(shapes().sphere.surface.canSeeItself(0, false));
    EXPECT_TRUE(shapes().sphere.surface.canSeeItself(0, true));
    EXPECT_TRUE(shapes().torus.surface.canSeeItself(0, false));
}

// Whatever the order and the number of threads, the same bits.
TEST(ProjectedSurface, pointsDependOnNothingButTheirParameters) {
    const surface::ProjectedSurface& surface = shapes().blobs.surface;
    constexpr std::size_t kPoints = 20000;
    const auto pointAt = [&](std::size_t i) {
        base::RandomStream random(i);
        const auto patch = static_cast<std::uint32_t>(i % surface.patchCount());
        const Vec2d uv = random.next2();
        const Vec2d split = surface.splitPoint(patch, uv, random.next2());
        return surface.evaluate(patch, i % 2 == 0 ? uv : split).position;
    };
    std::vector<Vec3d> forwards(kPoints);
    std::vector<Vec3d> parallel(kPoints);
    for (std::size_t i = kPoints; i-- > 0;) {
        forwards[i] = pointAt(i);
    }
    base::Executor(4).forRange(kPoints, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            parallel[i] = pointAt(i);
        }
    });
    const test::ProjectedUnion again;
    for (std::size_t i = 0; i < kPoints; ++i) {
        ASSERT_TRUE(sameBits(forwards[i], parallel[i])) << i;
    }
    ASSERT_EQ(again.surface.patchCount(), surface.patchCount());
    EXPECT_TRUE(
        sameBits(again.surface.evaluate(7, {.3, .6}).position, surface.evaluate(7, {.3, .6}).position));
}

}  // namespace fluxwalk
