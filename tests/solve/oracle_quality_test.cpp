#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/solve/assess_link.h"
#include "core/surface/sphere.h"
#include "tests/solve/link_errors.h"
#include "tests/support/curved_room.h"
#include "tests/support/statistics.h"

// What oracles predict, against what links really do wrong (ALGORITHMS 4, oracle quality checks).

namespace fluxwalk {

namespace {

using hierarchy::Link;
using solve::OracleKind;
using test::Problem;

// All leaves linked to each other directly, and light at its rest.
std::unique_ptr<Problem> linkLeaves(scene::Scene scene, double leafArea) {
    solve::Options options;
    options.minArea = leafArea;
    auto problem = test::makeProblem(std::move(scene), options);
    test::refine(*problem, 1e-9);
    test::converge(*problem, 1e-4);
    return problem;
}

std::vector<Link> drawLinks(const Problem& problem, int count, std::uint64_t seed) {
    base::RandomStream random(seed);
    const std::vector<Link>& all = problem.links.links;
    std::vector<Link> links;
    while (links.size() < static_cast<std::size_t>(count)) {
        const Link& link = all[static_cast<std::size_t>(random.next() * static_cast<double>(all.size()))];
        if (link.a != link.b) {
            links.push_back(link);
        }
    }
    return links;
}

/// Errors of links, and what an oracle predicts of them.
struct Predictions {
    std::vector<double> actual;
    std::vector<double> predicted;

    void add(double a, double p) {
        actual.push_back(a);
        predicted.push_back(p);
    }
    double rankCorrelation() const { return test::rankCorrelation(actual, predicted); }
};

}  // namespace

TEST(OracleQuality, boundedRanksTheLinksOfTheCornellBox) {
    const auto problem = linkLeaves(scene::buildCornellBox(base::Rgb(100.0f)), .1);
    Predictions all;
    for (const Link& link : drawLinks(*problem, 400, 5)) {
        all.add(test::measureLink(*problem, link, 8).rms, solve::assessLink(*problem, link).error);
    }
    EXPECT_GT(all.rankCorrelation(), .8);
}

TEST(OracleQuality, boundedRanksTheLinksOfCurvedObjects) {
    const auto problem = linkLeaves(test::buildCurvedRoom(), .5);
    // By how many ends are curved.
    std::array<Predictions, 3> classes;
    Predictions all;
    for (const Link& link : drawLinks(*problem, 600, 6)) {
        const hierarchy::Hierarchy& h = problem->hierarchy;
        const std::size_t curved =
            (h.shape(link.a).isPlanar ? 0u : 1u) + (h.shape(link.b).isPlanar ? 0u : 1u);
        const double actual = test::measureLink(*problem, link, 8).rms;
        const double predicted = solve::assessLink(*problem, link).error;
        all.add(actual, predicted);
        classes[curved].add(actual, predicted);
    }
    EXPECT_GT(all.rankCorrelation(), .8);
    for (const Predictions& one : classes) {
        EXPECT_GT(one.actual.size(), 80u);
        EXPECT_GT(one.rankCorrelation(), .8);
    }
}

// No link's power is off by more than a strict oracle says.
TEST(OracleQuality, strictIsNeverExceeded) {
    const auto problem = linkLeaves(test::buildCurvedRoom(), .5);
    problem->options.oracle = OracleKind::strict;
    int loose = 0;
    for (const Link& link : drawLinks(*problem, 250, 7)) {
        const double actual = test::measureLink(*problem, link, 8).mean;
        const double predicted = static_cast<double>(solve::assessLink(*problem, link).error);
        EXPECT_LE(actual, predicted * 1.001 + 1e-9);
        loose += predicted > 0.0 ? 1 : 0;
    }
    EXPECT_GT(loose, 100);
}

namespace {

// Two facing plates of 1 m, the upper one glowing, and a pea between them that hides a part of 1e-3.
scene::Scene makePlatesAndPea() {
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", base::Rgb(.5f));
    const std::uint32_t lamp = scene::addMaterial(scene, "lamp", base::Rgb(0.0f), base::Rgb(1000.0f));
    scene::addPolygons(scene, "floor", grey, scene::boxFaces({0, 0, 0}, {1, 0, 1}, scene::kTop));
    scene::addPolygons(scene, "lamp", lamp, scene::boxFaces({0, 3, 0}, {1, 3, 1}, scene::kBottom));
    scene.objects.push_back(
        {"pea", std::make_shared<surface::Sphere>(base::Vec3d(.33, 1.5, .41), .015), grey});
    return scene;
}

// Least visibility of a link between floor and lamp, and how many there are.
std::pair<float, int> linksOfPlates(OracleKind oracle, double threshold) {
    solve::Options options;
    options.oracle = oracle;
    const auto problem = test::makeProblem(makePlatesAndPea(), options);
    // The second pass knows the light.
    for (int pass = 0; pass < 4; ++pass) {
        test::refine(*problem, threshold);
        test::converge(*problem, 1e-4);
    }
    std::pair<float, int> found{1.0f, 0};
    for (const Link& link : problem->links.links) {
        const auto a = problem->hierarchy.name(link.a).object;
        const auto b = problem->hierarchy.name(link.b).object;
        if (a + b == 1) {
            found.first = std::min(found.first, link.visibility());
            ++found.second;
        }
    }
    return found;
}

}  // namespace

// That all rays pass is no certificate: strict goes on until the pea is found or the power is small.
TEST(OracleQuality, strictDoesNotTrustRays) {
    constexpr double kThreshold = .5;
    const auto [boundedLeast, boundedCount] = linksOfPlates(OracleKind::bounded, kThreshold);
    const auto [strictLeast, strictCount] = linksOfPlates(OracleKind::strict, kThreshold);
    EXPECT_EQ(boundedLeast, 1.0f);
    EXPECT_LT(strictLeast, 1.0f);
    EXPECT_GT(strictCount, 4 * boundedCount);
}

}  // namespace fluxwalk
