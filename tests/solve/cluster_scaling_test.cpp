#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "tests/support/hard_scenes.h"
#include "tests/support/solving.h"

// Check 27: with clusters, links grow with the number of polygons, not with its square.

namespace fluxwalk {

namespace {

struct Size {
    double patches = 0.0;
    double links = 0.0;
};

// Links of a cloud at a fixed part of the mean irradiance, with the light of the levels before.
Size solveCloud(unsigned count) {
    const auto problem = test::makeProblem(test::buildCloud(count, 3), test::withClusterLinks());
    hierarchy::Hierarchy& h = problem->hierarchy;
    double emitted = 0.0;
    for (const base::NodeId id : h.patches()) {
        emitted += static_cast<double>(h.shape(id).exposedArea() * h.light(id).emission.g);
    }
    const double mean = emitted / h.totalArea();
    for (const double part : {1e-3, 2.5e-4, 6e-5}) {
        test::refine(*problem, part * mean);
        test::converge(*problem, 1e-3);
    }
    return {static_cast<double>(h.patches().size()), static_cast<double>(problem->links.links.size())};
}

}  // namespace

TEST(ClusterScaling, linksGrowWithThePolygons) {
    const Size small = solveCloud(1000);
    const Size middle = solveCloud(3000);
    const Size large = solveCloud(10000);
    const double exponent = std::log(large.links / small.links) / std::log(large.patches / small.patches);
    RecordProperty("exponent", std::to_string(exponent));
    RecordProperty("links", std::to_string(small.links) + " " + std::to_string(middle.links) + " " +
                                std::to_string(large.links));
    EXPECT_LE(exponent, 1.1);
    EXPECT_LE(std::log(large.links / middle.links) / std::log(large.patches / middle.patches), 1.1);
    // All pairs of patches, which linking starts from without clusters.
    EXPECT_GT(.5 * large.patches * large.patches, 50.0 * large.links);
}

}  // namespace fluxwalk
