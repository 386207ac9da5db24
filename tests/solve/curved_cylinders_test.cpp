#include <chrono>
#include <iostream>

#include <gtest/gtest.h>

#include "tests/analytic/closed_forms.h"
#include "tests/support/curved_scenes.h"
#include "tests/support/solving.h"

// Checks 14 and 15: the outer of two coaxial cylinders of radii 1 and 2 to itself, past the inner one.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using test::Problem;

/// Part of a cylinder's height that is an object of its own.
struct Section {
    double from = 0.0;
    double to = 0.0;
};

// Outer sections first; only they glow.
std::unique_ptr<Problem> makeCylinders(const std::vector<Section>& sections, double leafArea) {
    scene::Scene scene;
    const std::uint32_t glowing = scene::addMaterial(scene, "glowing", Rgb(0.0f), Rgb(1.0f));
    const std::uint32_t black = scene::addMaterial(scene, "black", Rgb(0.0f));
    for (const bool outer : {true, false}) {
        for (const Section& s : sections) {
            scene.objects.push_back(
                {outer ? "outer" : "inner",
                 std::make_shared<const surface::Cylinder>(test::movedTo({0, .5 * (s.from + s.to), 0}),
                                                           outer ? 2.0 : 1.0, s.to - s.from, outer),
                 outer ? glowing : black});
        }
    }
    solve::Options options;
    options.minArea = leafArea;
    return test::makeProblem(std::move(scene), options);
}

}  // namespace

TEST(CoaxialCylinders, outerToItself) {
    for (const auto& [height, leafArea] : {std::pair{2.0, .2}, {10.0, .5}}) {
        const auto t0 = std::chrono::steady_clock::now();
        const auto problem = makeCylinders({{0, height}}, leafArea);
        test::refine(*problem, 1e-9);
        test::converge(*problem);
        const double f = test::meanIrradiance(*problem, 0).g;
        const double expected = closed_forms::coaxialCylinders(1.0, 2.0, height).outerToOuter;
        EXPECT_NEAR(f / expected, 1.0, .005) << height;
        std::cout << height << " " << f / expected - 1 << " links " << problem->links.links.size()
                  << " leaves " << test::leavesOf(problem->hierarchy).size() << " t "
                  << std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count() << "\n";
    }
}

// 1,000 radii long. Sections grow with their distance from the middle, whose own factor is that of infinite
// cylinders, 1/2, to 1e-5; the mean over all, .499218, differs from it by less than the tolerance.
TEST(CoaxialCylinders, longOnes) {
    std::vector<Section> sections{{-1, 1}};
    for (double y = 1.0; y < 500.0; y *= 2.0) {
        const double next = std::min(500.0, 2.0 * y);
        sections.push_back({y, next});
        sections.push_back({-next, -y});
    }
    for (auto [th, A] : {std::pair{1e-4, .02}, {3e-5, .02}}) {
        const auto t0 = std::chrono::steady_clock::now();
        const auto problem = makeCylinders(sections, A);
        test::refine(*problem, th);
        test::converge(*problem);
        std::cout << th << " " << test::meanIrradiance(*problem, 0).g << " links "
                  << problem->links.links.size() << " leaves " << test::leavesOf(problem->hierarchy).size()
                  << " t " << std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count()
                  << "\n";
        EXPECT_NEAR(test::meanIrradiance(*problem, 0).g / .499218, 1.0, .005);
    }
}

}  // namespace fluxwalk
