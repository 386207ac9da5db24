#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/image/sensors.h"
#include "core/reference/random_sensors.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/solve/audit.h"
#include "core/solve/solver.h"
#include "tests/support/curved_room.h"
#include "tests/support/hard_scenes.h"
#include "tests/support/solving.h"

// The same light with clusters and without, and none where none can be.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using scene::Sensor;

std::unique_ptr<solve::Solver> solveScene(scene::Scene scene, double error, bool clusterLinks = true) {
    solve::Options options;
    options.error = error;
    options.errorOf = solve::ErrorOf::gathered;
    options.clusterLinks = clusterLinks ? solve::ClusterLinks::on : solve::ClusterLinks::off;
    auto solver =
        std::make_unique<solve::Solver>(std::make_shared<const scene::Scene>(std::move(scene)), options, 2);
    solver->solve({});
    return solver;
}

// Check 8: sensors on all sides that light reaches, read with clusters and without.
void expectSameLight(const std::function<scene::Scene()>& build, double error) {
    const auto with = solveScene(build(), error);
    const auto without = solveScene(build(), error, false);
    EXPECT_GT(with->problem().links.clusterLinks, 100u);
    EXPECT_EQ(without->problem().links.clusterLinks, 0u);
    const scene::Scene& scene = *with->problem().scene;
    std::vector<reference::ObjectSide> sides;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (with->problem().hierarchy.reached().isReached(i, false)) {
            sides.push_back({i, false});
        }
    }
    const auto sensors = reference::randomSensors(scene, sides, 400, reference::kBenchmarkSeed);
    const std::vector<Rgb> a = image::measure(*with, sensors);
    const std::vector<Rgb> b = image::measure(*without, sensors);
    double mean = 0.0;
    double difference = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const auto d = static_cast<double>(base::channelMean(a[i] - b[i]));
        mean += static_cast<double>(base::channelMean(b[i])) / 400.0;
        difference += d / 400.0;
        squares += d * d / 400.0;
    }
    EXPECT_LT(std::abs(difference) / mean, .005);
    EXPECT_LT(std::sqrt(squares) / mean, error);
    testing::Test::RecordProperty("difference", std::to_string(difference / mean));
    testing::Test::RecordProperty("rms", std::to_string(std::sqrt(squares) / mean));
}

}  // namespace

TEST(ClusterLight, isTheSameInTwoRooms) {
    expectSameLight(scene::buildTwoRooms, .02);
}

TEST(ClusterLight, isTheSameInACurvedRoom) {
    expectSameLight(test::buildCurvedRoom, .02);
}

TEST(ClusterLight, isTheSameInACloud) {
    expectSameLight([] { return test::buildCloud(300, 2); }, .01);
}

// Negative test n3: light that clusters do not carry any more is missing in the balance.
TEST(ClusterLight, isMissedByTheAudit) {
    const auto solver = solveScene(test::buildCloud(300, 1), .02);
    auto& problem = const_cast<test::Problem&>(solver->problem());
    test::converge(problem, 1e-9);
    const double whole = solve::auditEnergy(problem, 1000).relativeDefect();
    auto& links = problem.links.links;
    links.erase(links.begin(), links.begin() + static_cast<std::ptrdiff_t>(problem.links.clusterLinks));
    problem.links.clusterLinks = 0;
    problem.links.index(problem.hierarchy.nodeCount());
    test::converge(problem, 1e-9);
    const solve::Audit audit = solve::auditEnergy(problem, 1000);
    EXPECT_TRUE(audit.isClosed);
    EXPECT_GT(audit.relativeDefect(), whole + .02);
    EXPECT_LT(audit.absorbed.y, audit.emitted.y);
}

// Check 24 with clusters. Factors of clusters are sampled, and at the error that is asked for so are their
// visibilities: the balance is closed to half of that error, 1e-4 is for direct links (balance_test.cpp).
TEST(ClusterLight, isBalanced) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        auto solver = solveScene(test::buildCloud(300, seed), .02);
        auto& problem = const_cast<test::Problem&>(solver->problem());
        test::converge(problem, 1e-9);
        const solve::Audit audit = solve::auditEnergy(problem, 1000);
        EXPECT_TRUE(audit.isClosed);
        EXPECT_LT(audit.relativeDefect(), .01) << seed;
    }
}

// T7: a wall that touches the floor, a lamp and clutter on both sides of it.
TEST(ClusterLeak, noLightComesThroughAWall) {
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", Rgb(.6f));
    const std::uint32_t green = scene::addMaterial(scene, "lamp", Rgb(.3f), Rgb(0.0f, 1000.0f, 0.0f));
    const std::uint32_t red = scene::addMaterial(scene, "other lamp", Rgb(.3f), Rgb(1000.0f, 0.0f, 0.0f));
    // Floor, ceiling and outer walls go through; the wall has no thickness.
    scene::addPolygons(scene, "house", grey, scene::boxFaces(Vec3d(0.0), {6, 2, 3}, scene::kAllFaces, true));
    scene::addPolygons(scene, "wall", grey,
                       {{Vec3d(3, 0, 0), Vec3d(3, 2, 0), Vec3d(3, 2, 3), Vec3d(3, 0, 3)}});
    scene::addPolygons(scene, "lamp", green, scene::boxFaces({1, 1.9, 1}, {1.5, 1.9, 1.5}, scene::kBottom));
    scene::addPolygons(scene, "other lamp", red,
                       scene::boxFaces({5, 1.9, 1}, {5.5, 1.9, 1.5}, scene::kBottom));
    base::RandomStream random(8);
    for (int i = 0; i < 30; ++i) {
        const double x = .3 + 5.2 * random.next();
        const double z = .2 + 2.4 * random.next();
        const Vec3d at(x > 2.5 && x < 3.1 ? 2.0 : x, .2 + random.next(), z);
        scene::addPolygons(scene, "box", grey,
                           scene::boxFaces(at, at + Vec3d(.2, .1, .15), scene::kAllFaces));
    }
    const auto solver = solveScene(std::move(scene), .03);
    const test::Problem& problem = solver->problem();
    EXPECT_GT(problem.links.clusterLinks, 300u);
    double lit = 0.0;
    double dark = 0.0;
    for (int i = 0; i < 20; ++i) {
        for (const double x : {1.0, 2.9, 3.1, 5.0}) {
            const std::vector<Sensor> sensor{{{x, 0.0, .1 + 2.8 * (i + .5) / 20}, {0, 1, 0}}};
            const Rgb e = image::measure(*solver, sensor)[0];
            (x < 3.0 ? lit : dark) += static_cast<double>(e.g);
        }
    }
    EXPECT_GT(lit, 0.0);
    EXPECT_LT(dark, 1e-4 * lit);
    for (std::uint32_t i = 4; i < problem.scene->objects.size(); ++i) {
        const bool isLit = problem.scene->objects[i].surface->bounds().lower.x < 3.0;
        const Vec3d e = test::meanIrradiance(problem, i);
        EXPECT_LT(isLit ? e.x / (e.y + 1e-9) : e.y / (e.x + 1e-9), 1e-4);
    }
}

namespace {

void expectSolved(scene::Scene scene) {
    solve::Options options = test::withClusterLinks();
    options.threshold = .5;
    solve::Solver solver(std::make_shared<const scene::Scene>(std::move(scene)), options, 2);
    EXPECT_EQ(solver.solve({}), solve::Outcome::reachedError);
    const hierarchy::Hierarchy& h = solver.problem().hierarchy;
    for (const NodeId id : h.patches()) {
        const Rgb e = h.light(id).irradiance;
        ASSERT_TRUE(std::isfinite(e.r) && std::isfinite(e.g) && std::isfinite(e.b));
        ASSERT_GE(e.g, 0.0f);
    }
    EXPECT_GT(h.patches().size(), 0u);
}

}  // namespace

TEST(ClusterHardScenes, onePolygon) {
    expectSolved(test::buildOnePolygon());
}

TEST(ClusterHardScenes, farFromTheOrigin) {
    expectSolved(test::buildFarAway());
}

TEST(ClusterHardScenes, onePolygonAMillionTimesLarger) {
    expectSolved(test::buildHugePolygon());
}

TEST(ClusterHardScenes, coincidentPolygons) {
    expectSolved(test::buildCoincident(2000));
}

// A lamp of few patches near the ceiling: its cluster costs no more links than its patches, and sends as
// much.
TEST(ClusterLight, globeCostsNoMoreThanItsPatches) {
    const auto solve = [](solve::ClusterLinks links) {
        scene::Scene scene;
        scene::addMaterial(scene, "wall", Rgb(.5f));
        scene::addMaterial(scene, "lamp", Rgb(0.0f), Rgb(3000.0f));
        scene::addPolygons(scene, "room", 0,
                           scene::boxFaces({-2, 0, -2}, {2.3, 3, 2}, scene::kAllFaces, true));
        scene.objects.push_back({"globe", std::make_shared<surface::Sphere>(Vec3d(.1, 2.85, .2), .12), 1});
        solve::Options options;
        options.clusterLinks = links;
        auto problem = test::makeProblem(std::move(scene), options);
        for (const double threshold : {1.0, .25, .06, .015, .004}) {
            test::refine(*problem, threshold);
            test::converge(*problem, 1e-4);
        }
        return problem;
    };
    const auto with = solve(solve::ClusterLinks::on);
    const auto without = solve(solve::ClusterLinks::off);
    EXPECT_GT(with->links.clusterLinks, 10u);
    EXPECT_LT(with->links.links.size(), without->links.links.size());
    EXPECT_GT(without->links.links.size(), 2000u);
    const Vec3d sent = solve::auditEnergy(*with, 1000).absorbed;
    const Vec3d reference = solve::auditEnergy(*without, 1000).absorbed;
    EXPECT_NEAR(sent.y / reference.y, 1.0, .005);
}

}  // namespace fluxwalk
