#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "tests/support/solving.h"

// The invariant of ALGORITHMS 1.2: every pair of leaves is covered by exactly one link of ancestors, or
// exchanges nothing for certain.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using hierarchy::Hierarchy;
using hierarchy::NodeKind;
using test::Problem;

// A room with a lamp and a block that stands on its floor.
scene::Scene makeRoom() {
    scene::Scene scene;
    const std::uint32_t wall = scene::addMaterial(scene, "wall", Rgb(.6f));
    const std::uint32_t lamp = scene::addMaterial(scene, "lamp", Rgb(.3f), Rgb(1000.0f));
    scene::addPolygons(scene, "room", wall, scene::boxFaces(Vec3d(0.0), {2, 1.5, 2}, scene::kAllFaces, true));
    scene::addPolygons(scene, "block", wall, scene::boxFaces({.7, 0, .9}, {1.2, .8, 1.3}, scene::kStanding));
    scene::addPolygons(scene, "lamp", lamp, scene::boxFaces({.9, 1.45, .5}, {1.3, 1.45, .8}, scene::kBottom));
    scene.lights.push_back({.name = "bulb", .intensity = Rgb(10.0f), .position = {.3, .5, .3}});
    scene.sky = Rgb(5.0f);
    return scene;
}

/// How often links cover each pair of nodes' leaves.
class Cover {
  public:
    explicit Cover(const Problem& problem) : h_(problem.hierarchy) {
        for (const hierarchy::Link& link : problem.links.links) {
            ++links_[std::minmax(link.a, link.b)];
        }
    }

    std::size_t count(NodeId a, NodeId b) const {
        std::size_t covered = 0;
        std::set<std::pair<NodeId, NodeId>> met;
        for (const NodeId above : chain(a)) {
            for (const NodeId beside : chain(b)) {
                const auto it = links_.find(std::minmax(above, beside));
                if (it != links_.end() && met.insert(it->first).second) {
                    covered += it->second;
                }
            }
        }
        return covered;
    }

  private:
    std::vector<NodeId> chain(NodeId id) const {
        std::vector<NodeId> nodes;
        for (; id != NodeId::none; id = h_.parent(id)) {
            nodes.push_back(id);
        }
        return nodes;
    }

    const Hierarchy& h_;
    std::map<std::pair<NodeId, NodeId>, std::size_t> links_;
};

// Points of the exposed cells of a planar leaf.
std::vector<Vec3d> pointsOf(const Hierarchy& h, NodeId id, unsigned side) {
    const hierarchy::ElementName name = h.name(id);
    const surface::Region region = h.region(id);
    std::vector<Vec3d> points;
    for (unsigned i = 0; i < side * side; ++i) {
        const base::Vec2d st((i % side + .5) / side, (i / side + .5) / side);
        const unsigned cell = 4 * static_cast<unsigned>(4 * st.y) + static_cast<unsigned>(4 * st.x);
        if ((h.shape(id).exposedCells & 1u << cell) != 0) {
            points.push_back(
                h.surfaceOf(id).evaluate(name.patch, surface::mapToRegion(region, st).uv).position);
        }
    }
    return points;
}

// What two leaves exchange by brute force, m2; 0 where nothing is seen.
double exchange(const Problem& problem, NodeId a, NodeId b) {
    constexpr unsigned kSide = 8;
    const Hierarchy& h = problem.hierarchy;
    const Vec3d na(h.shape(a).axis);
    const Vec3d nb(h.shape(b).axis);
    const std::vector<Vec3d> onA = pointsOf(h, a, kSide);
    const std::vector<Vec3d> onB = pointsOf(h, b, kSide);
    double sum = 0.0;
    for (const Vec3d& p : onA) {
        for (const Vec3d& q : onB) {
            const Vec3d d = q - p;
            const double r2 = glm::dot(d, d);
            const double cosines = std::max(0.0, glm::dot(na, d)) * std::max(0.0, -glm::dot(nb, d));
            if (cosines > 1e-9 * r2 && !problem.rays.isOccluded(problem.rays.segment(p, na, q, nb))) {
                sum += cosines / (base::kPi * r2 * r2);
            }
        }
    }
    return sum * static_cast<double>(h.shape(a).area * h.shape(b).area) / (kSide * kSide * kSide * kSide);
}

void expectTiling(const Problem& problem) {
    const Hierarchy& h = problem.hierarchy;
    const Cover cover(problem);
    const std::vector<NodeId> leaves = test::leavesOf(h);
    EXPECT_GT(leaves.size(), 40u);
    std::size_t once = 0;
    std::size_t nothing = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        for (std::size_t j = i + 1; j < leaves.size(); ++j) {
            const std::size_t covered = cover.count(leaves[i], leaves[j]);
            ASSERT_LE(covered, 1u);
            once += covered;
            if (covered == 0) {
                ++nothing;
                const double missed = exchange(problem, leaves[i], leaves[j]);
                ASSERT_LE(missed, 1e-4 * static_cast<double>(h.shape(leaves[i]).area)) << "lost pair";
            }
        }
        for (const NodeId source : h.sources()) {
            ASSERT_LE(cover.count(leaves[i], source), 1u);
        }
    }
    EXPECT_GT(once, 500u);
    EXPECT_GT(nothing, 100u);
}

}  // namespace

TEST(Tiling, holdsAtEveryLevel) {
    const auto problem = test::makeProblem(makeRoom(), test::withClusterLinks());
    for (double threshold = 10.0; threshold > .05; threshold /= 4.0) {
        test::refine(*problem, threshold);
        test::converge(*problem, 1e-3);
    }
    expectTiling(*problem);
}

// A stop inside a refinement accepts what is still open.
TEST(Tiling, holdsAfterAStop) {
    for (const int waves : {1, 2, 3, 4}) {
        const auto problem = test::makeProblem(makeRoom(), test::withClusterLinks());
        test::refine(*problem, 2.0);
        test::converge(*problem, 1e-3);
        const std::size_t before = problem->links.links.size();
        int asked = 0;
        solve::refineLinks(*problem, .05, {}, [&] { return asked++ >= waves; });
        EXPECT_GT(asked, waves);
        EXPECT_GT(problem->links.links.size(), before);
        expectTiling(*problem);
    }
}

}  // namespace fluxwalk
