#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/hierarchy/local_frame.h"
#include "core/scene/builders.h"
#include "core/solve/point_gather.h"
#include "tests/support/solving.h"

// Checks 16 and 17 (ALGORITHMS 3.8): two parallel strips, width and gap 1, both emit 1, reflectance .8.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Vec3d;
using test::Problem;

constexpr double kLength = 80.0;    // what is missing beyond the ends counts 1e-5
constexpr unsigned kSegments = 30;  // as long as keeps elements from being cut into strips
constexpr std::uint32_t kMiddle = kSegments / 2;

// Every plate is cut into 2^level columns, linked leaf to leaf wherever the kernel is not constant.
std::unique_ptr<Problem> solveStrips(unsigned level) {
    solve::Options options;
    options.minArea = kLength / kSegments / std::pow(4.0, level) * 1.5;
    auto problem = test::makeProblem(scene::buildStrips(kLength, kSegments, .8f), options);
    for (unsigned i = 0; i < level; ++i) {
        problem->hierarchy.split(test::leavesOf(problem->hierarchy), problem->executor);
    }
    test::refine(*problem, 1e-8);
    test::converge(*problem, 1e-8);
    return problem;
}

// The exact solution by Nystrom's method; the kernel is that of infinite strips.
class ExactStrips {
  public:
    ExactStrips() {
        // Gauss-Legendre on [0, 1].
        for (std::size_t i = 0; i < kCount; ++i) {
            double x = std::cos(base::kPi * (static_cast<double>(i) + .75) / (kCount + .5));
            double slope = 0.0;
            for (int step = 0; step < 30; ++step) {
                double below = 1.0;
                double value = x;
                for (std::size_t k = 2; k <= kCount; ++k) {
                    const auto d = static_cast<double>(k);
                    const double next = ((2 * d - 1) * x * value - (d - 1) * below) / d;
                    below = value;
                    value = next;
                }
                slope = kCount * (x * value - below) / (x * x - 1);
                x -= value / slope;
            }
            at_[i] = .5 * (1 - x);
            weight_[i] = 1 / ((1 - x * x) * slope * slope);
        }
        value_.fill(1.0);
        for (int sweep = 0; sweep < 100; ++sweep) {
            std::array<double, kCount> next{};
            for (std::size_t i = 0; i < kCount; ++i) {
                next[i] = radiosity(at_[i]);
            }
            value_ = next;
        }
    }

    double radiosity(double x) const {
        double irradiance = 0.0;
        for (std::size_t j = 0; j < kCount; ++j) {
            irradiance += weight_[j] * value_[j] * .5 * std::pow(1 + (x - at_[j]) * (x - at_[j]), -1.5);
        }
        return 1 + .8 * irradiance;
    }
    double mean() const {
        double sum = 0.0;
        for (std::size_t j = 0; j < kCount; ++j) {
            sum += weight_[j] * value_[j];
        }
        return sum;
    }

  private:
    static constexpr std::size_t kCount = 40;
    std::array<double, kCount> at_{};
    std::array<double, kCount> weight_{};
    std::array<double, kCount> value_{};
};

// Leaves of the lower plate in the middle of the strips.
std::vector<NodeId> middleLeaves(const Problem& problem) {
    std::vector<NodeId> leaves;
    for (const NodeId id : test::leavesOf(problem.hierarchy)) {
        const hierarchy::ElementName name = problem.hierarchy.name(id);
        if (name.object == 0 && name.patch == kMiddle) {
            leaves.push_back(id);
        }
    }
    return leaves;
}

struct Errors {
    double constant = 0.0;  ///< L1, of the leaves' means
    double linear = 0.0;    ///< L1, of their linear functions
    double middle = 0.0;    ///< largest, at their middles
};

Errors measureErrors(const Problem& problem, const ExactStrips& exact) {
    constexpr int kSteps = 32;
    const hierarchy::Hierarchy& h = problem.hierarchy;
    Errors errors;
    const std::vector<NodeId> leaves = middleLeaves(problem);
    for (const NodeId id : leaves) {
        const hierarchy::Shape& shape = h.shape(id);
        const hierarchy::Light& light = h.light(id);
        const auto b = static_cast<double>(light.radiosity.g);
        errors.middle =
            std::max(errors.middle, std::abs(b - exact.radiosity(static_cast<double>(shape.center.x))));
        for (int i = 0; i < kSteps; ++i) {
            const double t = (i + .5) / kSteps;
            const double s = 2 * t - 1;
            // Corners 0 and 1, or 0 and 3, span the strip's width.
            const bool alongS = std::abs(shape.corners[1].x - shape.corners[0].x) > 1e-6f;
            const base::Vec3& end = alongS ? shape.corners[1] : shape.corners[3];
            const double x =
                (1 - t) * static_cast<double>(shape.corners[0].x) + t * static_cast<double>(end.x);
            const double slope = static_cast<double>(alongS ? light.slopeS.g : light.slopeT.g);
            const double share = 1.0 / (kSteps * static_cast<double>(leaves.size()));
            errors.constant += share * std::abs(b - exact.radiosity(x));
            errors.linear += share * std::abs(b + slope * s - exact.radiosity(x));
        }
    }
    return errors;
}

double slopeOf(double coarse, double fine, unsigned levels) {
    return std::log2(fine / coarse) / levels;
}

}  // namespace

TEST(Strips, nystromGivesThePublishedValues) {
    const ExactStrips exact;
    EXPECT_NEAR(exact.radiosity(0.0), 1.4234929569, 1e-9);
    EXPECT_NEAR(exact.radiosity(.5), 1.5367128314, 1e-9);
    EXPECT_NEAR(exact.mean(), 1.4967718996, 1e-9);
}

TEST(Strips, edgeCentreAndMean) {
    const auto problem = solveStrips(3);
    const auto radiosityAt = [&](double x) {
        // The edge itself belongs to the plate.
        const Vec3d position(x, 0.0, .5 * kLength);
        const base::Vec2d uv = problem->scene->objects[0].surface->locate(kMiddle, position);
        const auto leaf = solve::findLeaf(*problem, 0, kMiddle, false, uv);
        return 1.0 + .8 * static_cast<double>(solve::gatherAtPoint(*problem, {*leaf, position, {0, 1, 0}}).g);
    };
    EXPECT_NEAR(radiosityAt(0.0) / 1.42349, 1.0, .005);
    EXPECT_NEAR(radiosityAt(.5) / 1.53671, 1.0, .005);
    const double mean = static_cast<double>(
        problem->hierarchy.light(problem->hierarchy.patchNode(0, kMiddle, false)).radiosity.g);
    EXPECT_NEAR(mean / 1.49677, 1.0, .005);
}

// Constants converge as h and are better at the middles of the elements (h2), the linear functions that the
// solver keeps as h2, as far as the factors are accurate: to 1e-4 of what they carry.
TEST(Strips, slopesOfConvergence) {
    const ExactStrips exact;
    const Errors coarse = measureErrors(*solveStrips(1), exact);
    const Errors fine = measureErrors(*solveStrips(3), exact);
    EXPECT_NEAR(slopeOf(coarse.constant, fine.constant, 2), -1.0, .15);
    constexpr double kOfFactors = 2e-4;
    EXPECT_LT(fine.middle, coarse.middle / 16.0 + kOfFactors);
    EXPECT_LT(fine.linear, coarse.linear / 16.0 + kOfFactors);
    EXPECT_LT(fine.constant, 7.5e-3);
}

}  // namespace fluxwalk
