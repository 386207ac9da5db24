#include "core/transport/shaft.h"

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/surface/cylinder.h"
#include "tests/transport/polygon_pairs.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec3;
using base::Vec3d;
using test::Built;
using transport::inspectShaft;
using transport::Shaft;
using transport::ShaftContent;

constexpr std::size_t kRays = 4096;

// Blocked rays among up to `rays` between random points that face each other; {0, 0} where none do.
struct Cast {
    std::size_t blocked = 0;
    std::size_t count = 0;
};
Cast castRays(const Built& built, NodeId a, NodeId b, std::size_t rays, std::uint64_t key) {
    base::RandomStream random(key);
    const std::array<surface::Region, 2> regions{built.tree.region(a), built.tree.region(b)};
    const auto pointOf = [&](NodeId id, const surface::Region& region) {
        const hierarchy::ElementName name = built.tree.name(id);
        surface::SurfacePoint p =
            built.tree.surfaceOf(id).evaluate(name.patch, surface::mapToRegion(region, random.next2()).uv);
        p.normal = name.back ? -p.normal : p.normal;
        return p;
    };
    std::vector<rays::Ray> bundle;
    for (std::size_t i = 0; i < rays; ++i) {
        const surface::SurfacePoint p = pointOf(a, regions[0]);
        const surface::SurfacePoint q = pointOf(b, regions[1]);
        const Vec3d d = q.position - p.position;
        // Both ends are lifted along their own normals: where one is nearly in the other's plane, the lift of
        // the first may take it below the second.
        const double least = 2.0 * built.rays.lift();
        if (glm::dot(p.normal, d) > least && glm::dot(q.normal, d) < -least) {
            bundle.push_back(built.rays.segment(p.position, p.normal, q.position, q.normal));
        }
    }
    std::vector<std::uint8_t> blocked(bundle.size());
    built.rays.occluded(bundle, blocked);
    Cast result;
    result.count = bundle.size();
    for (const std::uint8_t is : blocked) {
        result.blocked += is;
    }
    return result;
}

struct Census {
    int pairs = 0;
    int empty = 0;
    int blocked = 0;
};

// Random pairs of leaves that face each other: certificates must agree with every ray.
Census takeCensus(const Built& built, std::uint64_t key, int count) {
    std::vector<NodeId> leaves;
    for (const NodeId id : built.tree.patches()) {
        const std::vector<NodeId> below = built.leavesOf(id);
        leaves.insert(leaves.end(), below.begin(), below.end());
    }
    base::RandomStream random(key);
    Census census;
    for (int i = 0; i < 20 * count && census.pairs < count; ++i) {
        const auto pick = [&] {
            return leaves[static_cast<std::size_t>(random.next() * static_cast<double>(leaves.size()))];
        };
        const NodeId a = pick();
        const NodeId b = pick();
        const std::uint64_t castKey = base::combine(key, static_cast<std::uint64_t>(i));
        if (a == b || castRays(built, a, b, 16, castKey).count == 0) {
            continue;
        }
        ++census.pairs;
        const double tolerance = transport::shaftTolerance(built.tree, built.rays, a, b);
        const ShaftContent content = inspectShaft(built.tree, a, b, tolerance);
        if (content == ShaftContent::unknown) {
            continue;
        }
        const Cast cast = castRays(built, a, b, kRays, castKey);
        EXPECT_EQ(content, inspectShaft(built.tree, b, a, tolerance));
        if (content == ShaftContent::empty) {
            ++census.empty;
            EXPECT_EQ(cast.blocked, 0u) << "of " << cast.count << " in an empty shaft";
        } else {
            ++census.blocked;
            EXPECT_EQ(cast.blocked, cast.count) << "in a blocked shaft";
        }
    }
    return census;
}

TEST(ShaftCertificates, neverLieOnRandomMeshes) {
    Census all;
    for (std::uint64_t key = 1; key <= 8; ++key) {
        Built built(test::randomScene(60 + key, 3, key % 2 == 0 ? 3 : 8, 0));
        built.split(1 + key % 2);
        const Census census = takeCensus(built, key, 120);
        all.pairs += census.pairs;
        all.empty += census.empty;
        all.blocked += census.blocked;
    }
    EXPECT_GT(all.empty, 100);
    EXPECT_GT(all.blocked, 10);
}

TEST(ShaftCertificates, neverLieAmongSpheres) {
    Census all;
    for (std::uint64_t key = 1; key <= 6; ++key) {
        Built built(test::randomScene(70 + key, 2, 4, 5, 0.5));
        built.split(1 + key % 2);
        const Census census = takeCensus(built, key, 120);
        all.pairs += census.pairs;
        all.empty += census.empty;
        all.blocked += census.blocked;
    }
    EXPECT_GT(all.empty, 5) << "elements of a sphere are in each other's way";
}

// Walls at right angles to the axes, contacts, shared edges: what rooms are made of.
TEST(ShaftCertificates, neverLieInRooms) {
    for (const bool cornell : {true, false}) {
        Built built(cornell ? scene::buildCornellBox(base::Rgb(100.0f)) : scene::buildTwoRooms());
        built.split(cornell ? 3 : 2);
        const Census census = takeCensus(built, 80, 400);
        EXPECT_GT(census.empty, census.pairs / 10);
        EXPECT_GT(census.blocked, census.pairs / 50);
    }
}

TEST(ShaftCertificates, alphaDecides) {
    // A pane between two plates.
    for (const auto& [mode, expected] : {std::pair{scene::AlphaMode::opaque, ShaftContent::blocked},
                                         std::pair{scene::AlphaMode::blend, ShaftContent::empty},
                                         std::pair{scene::AlphaMode::mask, ShaftContent::unknown}}) {
        scene::Scene scene = test::sceneOf({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                            {{0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}},
                                            {{-1, -1, 1}, {2, -1, 1}, {2, 2, 1}, {-1, 2, 1}}});
        scene::addMaterial(scene, "pane", base::Rgb(0.5f));
        scene.materials[1].alphaMode = mode;
        scene.objects[2].material = 1;
        const Built built(std::move(scene));
        const NodeId a = built.tree.patchNode(0, 0, false);
        const NodeId b = built.tree.patchNode(1, 0, false);
        EXPECT_EQ(inspectShaft(built.tree, a, b, 1e-6), expected);
    }
}

TEST(Shaft, excludesOnlyBoxesThatHoldNoPointOfIt) {
    base::RandomStream random(90);
    int excluded = 0;
    for (int trial = 0; trial < 300; ++trial) {
        test::PolygonPair pair =
            test::randomPair(trial % 2 == 0 ? test::Placement::middle : test::Placement::near, random);
        const auto toShape = [](const test::Polygon& polygon) {
            hierarchy::Shape shape;
            shape.cornerCount = static_cast<std::uint8_t>(polygon.size());
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                shape.corners[i] = Vec3(polygon[i]);
            }
            shape.axis = Vec3(glm::normalize(glm::cross(polygon[1] - polygon[0], polygon[2] - polygon[0])));
            return shape;
        };
        const Shaft shaft(toShape(pair.a), toShape(pair.b), 1e-6);
        for (int i = 0; i < 40; ++i) {
            // A point between the two, well inside the hull.
            const auto weigh = [&random](const test::Polygon& p) {
                Vec3d sum(0.0);
                double total = 0.0;
                for (const Vec3d& c : p) {
                    const double w = 0.05 + random.next();
                    sum += w * c;
                    total += w;
                }
                return sum / total;
            };
            const Vec3d p = weigh(pair.a);
            const Vec3d q = weigh(pair.b);
            const Vec3d normalA(toShape(pair.a).axis);
            const Vec3d normalB(toShape(pair.b).axis);
            if (glm::dot(normalA, q - p) < 0.01 || glm::dot(normalB, p - q) < 0.01) {
                continue;
            }
            const Vec3d middle = glm::mix(p, q, 0.1 + 0.8 * random.next());
            const Vec3 around(middle);
            EXPECT_FALSE(shaft.excludes(around - 0.01f, around + 0.01f));
            const Vec3 elsewhere(test::randomPoint(random, 6.0));
            excluded += shaft.excludes(elsewhere - 0.2f, elsewhere + 0.2f) ? 1 : 0;
        }
    }
    EXPECT_GT(excluded, 2000);
}

// A cylinder about both plates stands between no two of their points; it does once one is outside.
TEST(ShaftCertificates, convexShellsBlockNothingInside) {
    for (const bool isInside : {true, false}) {
        const double x = isInside ? .5 : 1.5;
        scene::Scene scene = test::sceneOf({{{-.5, -.2, -.2}, {-.5, .2, -.2}, {-.5, .2, .2}, {-.5, -.2, .2}},
                                            {{x, -.2, -.2}, {x, -.2, .2}, {x, .2, .2}, {x, .2, -.2}}});
        scene.objects.push_back(
            {"shell", std::make_shared<surface::Cylinder>(base::Mat4d(1.0), 1.0, 4.0, true), 0});
        const test::Built built(std::move(scene));
        const NodeId a = built.tree.patchNode(0, 0, false);
        const NodeId b = built.tree.patchNode(1, 0, false);
        const auto content = transport::inspectShaft(built.tree, a, b, 1e-6);
        EXPECT_EQ(content == transport::ShaftContent::empty, isInside);
    }
}

}  // namespace
}  // namespace fluxwalk
