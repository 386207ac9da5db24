#include "core/surface/sphere.h"

#include <gtest/gtest.h>

#include "core/scene/polygons.h"
#include "tests/support/solving.h"

// Check 11: inside of a sphere, one octant emits, reflectance .8. The irradiance is the same everywhere.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using test::Problem;

// All of one object, whose kernel is one constant; the octant's light is its own.
std::unique_ptr<Problem> makeSphere() {
    scene::Scene scene;
    const std::uint32_t lit = scene::addMaterial(scene, "lit", Rgb(.8f), Rgb(1.0f));
    scene.objects.push_back(
        {"sphere", std::make_shared<surface::Sphere>(base::Vec3d(.5, 1, -2), 1.25, true), lit});
    solve::Options options;
    options.clusterLinks = solve::ClusterLinks::off;  // octants that are dark yet would stay together
    auto problem = test::makeProblem(std::move(scene), options);
    for (std::uint32_t patch = 1; patch < 8; ++patch) {
        hierarchy::Light& light = problem->hierarchy.light(problem->hierarchy.patchNode(0, patch, false));
        light.emission = Rgb(0.0f);
        light.radiosity = Rgb(0.0f);
    }
    test::refine(*problem, 1e-6);
    test::converge(*problem, 1e-9);
    return problem;
}

}  // namespace

TEST(SphereInside, octantLightsEveryPointAlike) {
    const auto problem = makeSphere();
    const hierarchy::Hierarchy& h = problem->hierarchy;
    for (const NodeId id : test::leavesOf(h)) {
        const double expected = h.name(id).patch == 0 ? 1.5 : .5;
        EXPECT_NEAR(static_cast<double>(h.light(id).radiosity.g) / expected, 1.0, .002);
    }
}

// Negative test n1: an octant sends an eighth of its light to itself; without those links .625 lux would fall
// to .2652 in the lit octant and .3788 in the others.
TEST(SphereInside, octantsAreLinkedToThemselves) {
    const auto problem = makeSphere();
    const hierarchy::Hierarchy& h = problem->hierarchy;
    for (const NodeId patch : h.patches()) {
        double toItself = 0.0;
        for (const std::uint32_t l : problem->links.endingAt(patch)) {
            const hierarchy::Link& link = problem->links.links[l];
            if (link.a == link.b) {
                toItself += static_cast<double>(link.transfer() / h.shape(patch).area);
            }
        }
        EXPECT_NEAR(toItself, .125, 1e-4);
    }
    std::erase_if(problem->links.links, [](const hierarchy::Link& link) { return link.a == link.b; });
    problem->links.index(h.nodeCount());
    test::converge(*problem, 1e-9);
    EXPECT_NEAR(static_cast<double>(h.light(h.patchNode(0, 0, false)).irradiance.g), .2652, 1e-3);
    EXPECT_NEAR(static_cast<double>(h.light(h.patchNode(0, 3, false)).irradiance.g), .3788, 1e-3);
}

}  // namespace fluxwalk
