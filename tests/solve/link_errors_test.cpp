#include "core/solve/link_errors.h"

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/sweep.h"
#include "tests/support/solving.h"

namespace fluxwalk {
namespace {

double areaMean(const solve::Problem& problem, const std::vector<float>& values) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    double sum = 0.0;
    double area = 0.0;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const base::NodeId id{i};
        if (h.kind(id) == hierarchy::NodeKind::element && h.isLeaf(id)) {
            const auto own = static_cast<double>(h.shape(id).exposedArea());
            sum += own * static_cast<double>(values[i]);
            area += own;
        } else {
            EXPECT_EQ(values[i], 0.0f);
        }
    }
    return sum / area;
}

std::unique_ptr<solve::Problem> refined(double threshold) {
    auto problem = test::makeProblem(*scene::buildScene("cornell-box"));
    problem->statistics.meanIrradiance = 100.0;
    test::refine(*problem, threshold);
    solve::Sweeper(*problem).sweep();
    return problem;
}

TEST(LinkErrors, fallWithTheThreshold) {
    const auto coarse = refined(5.0);
    const auto fine = refined(0.5);
    const double before = areaMean(*coarse, solve::computeLinkErrors(*coarse));
    const double after = areaMean(*fine, solve::computeLinkErrors(*fine));
    EXPECT_GT(before, 0.0);
    EXPECT_LT(after, 0.7 * before);
}

TEST(LinkErrors, areProportionalToTheLight) {
    const auto problem = refined(5.0);
    const std::vector<float> once = solve::computeLinkErrors(*problem);
    for (std::uint32_t i = 0; i < problem->hierarchy.nodeCount(); ++i) {
        hierarchy::Light& light = problem->hierarchy.light(base::NodeId{i});
        light.radiosity *= 2.0f;
        light.slopeS *= 2.0f;
        light.slopeT *= 2.0f;
        light.irradiance *= 2.0f;
        light.residual *= 2.0f;
    }
    const std::vector<float> twice = solve::computeLinkErrors(*problem);
    EXPECT_NEAR(areaMean(*problem, twice) / areaMean(*problem, once), 2.0, 0.02);
}

}  // namespace
}  // namespace fluxwalk
