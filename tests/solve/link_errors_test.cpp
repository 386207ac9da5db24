#include "core/solve/link_errors.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/assess_link.h"
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

TEST(LinkErrors, areThoseOfTheLinksThatEndAtAnElementOrAboveIt) {
    const auto problem = refined(5.0);
    const std::vector<float> errors = solve::computeLinkErrors(*problem);
    const hierarchy::Hierarchy& h = problem->hierarchy;
    std::size_t compared = 0;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const base::NodeId leaf{i};
        if (h.kind(leaf) != hierarchy::NodeKind::element || !h.isLeaf(leaf)) {
            continue;
        }
        double sum = 0.0;
        bool isFinite = true;
        for (base::NodeId id = leaf; id != base::NodeId::none; id = h.parent(id)) {
            for (const std::uint32_t l : problem->links.endingAt(id)) {
                const hierarchy::Link& link = problem->links.links[l];
                if (link.a != link.b) {
                    const auto error = static_cast<double>(solve::assessLink(*problem, link).error);
                    isFinite = isFinite && std::isfinite(error);
                    sum += error * error;
                }
            }
        }
        // Where samples say nothing, all light that could pass counts.
        if (isFinite) {
            EXPECT_NEAR(static_cast<double>(errors[i]), std::sqrt(sum), 1e-4 * std::sqrt(sum));
            ++compared;
        }
    }
    EXPECT_GT(compared, 10u);
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
