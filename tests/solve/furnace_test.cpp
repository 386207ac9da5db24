#include <algorithm>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/row_scaling.h"
#include "tests/support/solving.h"

// Check 7, planar: the closed Cornell box with two blocks inside, everything glows and reflects alike.
// Transport is proven on leaves that are linked to each other directly (threshold near 0): links of larger
// elements are linear functions over them, whose error is the oracle's business and not the kernel's.

namespace fluxwalk {

namespace {

using test::Problem;

constexpr double kLeafArea = .004;   // m2: no element above it is a leaf
constexpr double kThreshold = 1e-9;  // lux; the room's irradiance is 2

class Furnace : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        solve::Options options;
        options.minArea = kLeafArea;
        problem_ = test::makeProblem(scene::buildFurnace(.5f, false), options);
        test::refine(*problem_, kThreshold);
    }
    static void TearDownTestSuite() { problem_.reset(); }

    // Radiosity relative to 1 / (1 - rho), less 1.
    static test::Deviations solveWith(float rho, bool isScaled) {
        test::setReflectance(*problem_, rho);
        problem_->rowScale.clear();
        if (isScaled) {
            problem_->rowScale = solve::computeRowScaling(*problem_);
        }
        test::converge(*problem_, 1e-8);
        return test::deviations(*problem_, [&](NodeId id) {
            return static_cast<double>(problem_->hierarchy.light(id).radiosity.g) *
                       (1.0 - static_cast<double>(rho)) -
                   1.0;
        });
    }

    using NodeId = base::NodeId;
    static std::unique_ptr<Problem> problem_;
};

std::unique_ptr<Problem> Furnace::problem_;

}  // namespace

TEST_F(Furnace, rowsSumToOneWithoutScaling) {
    problem_->rowScale.clear();
    const std::vector<double> sums = test::transportedRowSums(*problem_);
    const test::Deviations rows =
        test::deviations(*problem_, [&](NodeId id) { return sums[base::index(id)] - 1.0; });
    EXPECT_LE(std::abs(rows.mean), .001);
    EXPECT_LE(rows.meanSize, .001);
    EXPECT_LE(rows.percentile99, .01);
}

// The largest errors are those of the floor's leaves that a block's wall cuts in two.
TEST_F(Furnace, unscaled) {
    const test::Deviations half = solveWith(.5f, false);
    EXPECT_LE(half.percentile99, .005);
    EXPECT_LE(half.largest, .01);
    const test::Deviations bright = solveWith(.9f, false);
    EXPECT_LE(std::abs(bright.mean), .01);
}

TEST_F(Furnace, scaled) {
    for (const float rho : {.5f, .9f}) {
        const test::Deviations radiosity = solveWith(rho, true);
        EXPECT_LE(radiosity.largest, .005) << rho;
        EXPECT_LE(radiosity.meanSize, .001) << rho;
    }
    const std::vector<double> sums = test::transportedRowSums(*problem_);
    const test::Deviations rows =
        test::deviations(*problem_, [&](NodeId id) { return sums[base::index(id)] - 1.0; });
    EXPECT_LE(rows.largest, .005);
    EXPECT_LE(rows.meanSize, .001);
}

}  // namespace fluxwalk
