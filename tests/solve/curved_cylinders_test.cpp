
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
        const auto problem = makeCylinders({{0, height}}, leafArea);
        test::refine(*problem, 1e-9);
        test::converge(*problem);
        const double expected = closed_forms::coaxialCylinders(1.0, 2.0, height).outerToOuter;
        EXPECT_NEAR(test::meanIrradiance(*problem, 0).g / expected, 1.0, .005) << height;
    }
}

// 1,000 radii long. Sections grow with their distance from the middle, whose own factor is that of infinite
// cylinders, 1/2, to 1e-3; check 15 gives .499218 as the mean over 1,000 radii.
TEST(CoaxialCylinders, longOnes) {
    constexpr double kEnd = 500.0;
    std::vector<Section> sections{{-1, 1}};
    for (double y = 1.0; y < kEnd; y *= 2.0) {
        const double next = std::min(kEnd, 2.0 * y);
        sections.push_back({y, next});
        sections.push_back({-next, -y});
    }
    const auto problem = makeCylinders(sections, .05);
    test::refine(*problem, 4e-5);
    test::converge(*problem);
    const double middle = test::meanIrradiance(*problem, 0).g;
    EXPECT_NEAR(middle / .5, 1.0, .0025);
    EXPECT_NEAR(middle / .499218, 1.0, .005);
}

}  // namespace fluxwalk
