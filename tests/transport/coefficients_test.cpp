#include "core/transport/coefficients.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/surface/sphere.h"
#include "core/transport/exact_form_factor.h"
#include "tests/transport/polygon_pairs.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using test::Built;
using transport::Coefficient;
using transport::CoefficientService;
using transport::Query;

bool areSame(const Coefficient& a, const Coefficient& b) {
    return a.coupling == b.coupling && a.visibility == b.visibility && a.gradientA == b.gradientA &&
           a.gradientB == b.gradientB && a.spreadA == b.spreadA && a.spreadB == b.spreadB &&
           a.isOpen == b.isOpen && a.isBlocked == b.isBlocked && a.isMixed == b.isMixed && a.rays == b.rays;
}

Coefficient swapped(Coefficient c) {
    std::swap(c.gradientA, c.gradientB);
    std::swap(c.spreadA, c.spreadB);
    return c;
}

std::vector<Query> randomQueries(const Built& built, std::uint64_t key, int count) {
    std::vector<NodeId> leaves;
    for (const NodeId id : built.tree.patches()) {
        const std::vector<NodeId> below = built.leavesOf(id);
        leaves.insert(leaves.end(), below.begin(), below.end());
    }
    base::RandomStream random(key);
    const auto pick = [&] {
        return leaves[static_cast<std::size_t>(random.next() * static_cast<double>(leaves.size()))];
    };
    std::vector<Query> queries;
    for (int i = 0; i < count; ++i) {
        const NodeId a = pick();
        queries.push_back({a, pick(), false});
    }
    return queries;
}

TEST(Coefficients, arePureAndTheSameBothWays) {
    Built built(test::randomScene(95, 3, 8, 3));
    built.split(1);
    const CoefficientService service(built.tree, built.rays);
    const std::vector<Query> queries = randomQueries(built, 96, 1000);
    std::vector<Coefficient> batch(queries.size());
    service.compute(queries, batch);
    int exchanging = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        Coefficient alone;
        service.compute(std::span(&queries[i], 1), std::span(&alone, 1));
        EXPECT_TRUE(areSame(batch[i], alone));
        const Query back{queries[i].b, queries[i].a, false};
        Coefficient other;
        service.compute(std::span(&back, 1), std::span(&other, 1));
        EXPECT_TRUE(areSame(batch[i], swapped(other))) << i;
        exchanging += batch[i].coupling > 0.0f ? 1 : 0;
        EXPECT_FALSE(batch[i].isOpen && batch[i].isBlocked);
        EXPECT_TRUE(!batch[i].isBlocked || batch[i].visibility == 0.0f);
        EXPECT_TRUE(!batch[i].isOpen || (batch[i].visibility == 1.0f && batch[i].rays == 0));
    }
    EXPECT_GT(exchanging, 100);
}

TEST(Coefficients, knownToBeOpenNeedNoRays) {
    const Built built(scene::buildParallelSquares(1.0));
    const CoefficientService service(built.tree, built.rays);
    for (const bool isOpen : {false, true}) {
        const Query query{built.tree.patchNode(0, 0, false), built.tree.patchNode(1, 0, false), isOpen};
        Coefficient c;
        service.compute(std::span(&query, 1), std::span(&c, 1));
        EXPECT_TRUE(c.isOpen);
        EXPECT_EQ(c.rays, 0);
        EXPECT_NEAR(static_cast<double>(c.coupling), 0.19982489569, 1e-4) << "squares at distance 1";
    }
}

TEST(Coefficients, inASphereAreExact) {
    scene::Scene scene = test::sceneOf({});
    scene.objects.push_back(
        {"sphere", std::make_shared<surface::Sphere>(base::Vec3d(1, 2, 3), 2.0, true), 0});
    Built built(std::move(scene));
    built.split(1);
    const CoefficientService service(built.tree, built.rays);
    for (const Query& query : randomQueries(built, 97, 300)) {
        Coefficient c;
        service.compute(std::span(&query, 1), std::span(&c, 1));
        if (built.tree.name(query.a).back || built.tree.name(query.b).back) {
            continue;  // the outside, which sees nothing of itself
        }
        const double areas = static_cast<double>(built.tree.shape(query.a).area) *
                             static_cast<double>(built.tree.shape(query.b).area);
        EXPECT_NEAR(static_cast<double>(c.coupling), areas / (16.0 * base::kPi), 1e-6 * areas);
        EXPECT_EQ(c.spreadA, 0.0f);
        EXPECT_EQ(c.visibility, 1.0f);
    }
}

// The ring at a column's foot lies on a disk that begins below it: near the circle where they meet part of
// the disk is hidden, and the rest can send no more than all it has.
TEST(Coefficients, sendNoMoreThanWhatIsExposed) {
    Built built(scene::buildGallery());
    const auto& objects = built.scene.objects;
    const auto disk = static_cast<std::uint32_t>(
        std::find_if(objects.begin(), objects.end(),
                     [](const scene::Object& object) { return object.name == "column step top"; }) -
        objects.begin());
    ASSERT_EQ(objects.at(disk + 1).name, "column base");
    const auto height = static_cast<float>(objects[disk].surface->bounds().upper.y);
    const auto isAtContact = [&](NodeId id) {
        const hierarchy::ElementName name = built.tree.name(id);
        const hierarchy::Shape& shape = built.tree.shape(id);
        const bool isRing = name.object == disk + 1;
        if (name.back || name.patch % 4 != 0 || !(isRing || name.object == disk)) {
            return false;
        }
        // Of the ring what is near the disk, of that what begins at its inner edge.
        const surface::Region region = built.tree.region(id);
        return isRing ? shape.center.y - shape.radius < height + .01f
                      : std::any_of(region.corners.begin(), region.corners.end(),
                                    [](const base::Vec2d& uv) { return uv.x == 0.0 || uv.y == 0.0; });
    };
    for (int i = 0; i < 3; ++i) {
        built.split(1, isAtContact);
    }
    std::array<std::vector<NodeId>, 2> ends;
    for (std::uint32_t i = 0; i < built.tree.nodeCount(); ++i) {
        const NodeId id{i};
        if (built.tree.kind(id) == hierarchy::NodeKind::element && built.tree.isLeaf(id) && isAtContact(id)) {
            ends[built.tree.name(id).object - disk].push_back(id);
        }
    }
    const CoefficientService service(built.tree, built.rays);
    int close = 0;
    int hiding = 0;
    for (const NodeId a : ends[0]) {
        hiding += built.tree.shape(a).exposed < 1.0f ? 1 : 0;
        for (const NodeId b : ends[1]) {
            const Query query{a, b, false};
            Coefficient c;
            service.compute(std::span(&query, 1), std::span(&c, 1));
            const float least =
                std::min(built.tree.shape(a).exposedArea(), built.tree.shape(b).exposedArea());
            EXPECT_LE(c.coupling, least);
            close += c.coupling > .5f * least ? 1 : 0;
        }
    }
    EXPECT_GT(close, 0);
    EXPECT_GT(hiding, 0);
}

}  // namespace
}  // namespace fluxwalk
