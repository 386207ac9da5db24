#include <gtest/gtest.h>

#include "core/reference/photon_tracer.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

namespace fluxwalk {

namespace {

using base::Vec3d;
using test::Problem;

constexpr double kEmitted = .01365;  // lm per channel

class CornellBox : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        solve::Options options;
        options.threshold = 5e-9;  // lux; the mean is 1e-2
        solver_ = std::make_unique<solve::Solver>(
            std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box-unit")), options, 2);
        solver_->solve({});
    }
    static void TearDownTestSuite() { solver_.reset(); }

    static const Problem& problem() { return solver_->problem(); }
    static const solve::Audit& audit() { return solver_->statistics().audit; }

    static void expectMean(const char* what, const Vec3d& mean, const Vec3d& table, double relative) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(mean[c] / table[c], 1.0, relative) << what << ", channel " << c;
        }
    }
    static Vec3d faceMean(std::uint32_t object, std::uint32_t patch) {
        const surface::Surface& surface = *problem().scene->objects[object].surface;
        return test::arrivingFlux(problem(), object, patch, false) /
               surface.area(patch, surface::wholePatch(surface.domain(patch)));
    }

    static std::unique_ptr<solve::Solver> solver_;
};

std::unique_ptr<solve::Solver> CornellBox::solver_;

}  // namespace

// Check 23, table 3.10: 1 % on the big faces, 3 % on the small.
TEST_F(CornellBox, meanIrradianceOfTheRoom) {
    expectMean("floor", test::meanIrradiance(problem(), 0), {.009044, .008701, .007380}, .01);
    expectMean("ceiling", test::meanIrradiance(problem(), 1), {.008243, .007107, .005226}, .01);
    expectMean("back wall", test::meanIrradiance(problem(), 2), {.013722, .013016, .010990}, .01);
    expectMean("right wall", test::meanIrradiance(problem(), 3), {.014791, .014143, .012625}, .01);
    expectMean("left wall", test::meanIrradiance(problem(), 4), {.013151, .012031, .010785}, .01);
    expectMean("lamp", test::meanIrradiance(problem(), 7), {.011320, .010172, .008020}, .03);
}

TEST_F(CornellBox, meanIrradianceOfTheBlocks) {
    expectMean("short top", faceMean(5, 0), {.025756, .026085, .023973}, .03);
    expectMean("short 82,225..130,65", faceMean(5, 1), {.001456, .003734, .000942}, .03);
    expectMean("short 240,272..82,225", faceMean(5, 2), {.007969, .009762, .006456}, .03);
    expectMean("short 290,114..240,272", faceMean(5, 3), {.008700, .006332, .005657}, .03);
    expectMean("short 130,65..290,114", faceMean(5, 4), {.001112, .000703, .000592}, .03);
    expectMean("tall top", faceMean(6, 0), {.058968, .056371, .054931}, .03);
    expectMean("tall 265,296..423,247", faceMean(6, 1), {.006431, .005781, .004862}, .03);
    expectMean("tall 314,456..265,296", faceMean(6, 2), {.007488, .009659, .006018}, .03);
    expectMean("tall 472,406..314,456", faceMean(6, 3), {.008030, .005604, .004589}, .03);
    expectMean("tall 423,247..472,406", faceMean(6, 4), {.006844, .000958, .000739}, .03);
}

TEST_F(CornellBox, escapedLight) {
    expectMean("escaped", audit().escaped / kEmitted, {.323153, .298231, .261259}, .005);
}

// Check 24: the balance, and independent particles.
TEST_F(CornellBox, balanceAgreesWithParticles) {
    EXPECT_NEAR(audit().emitted.x, kEmitted, 1e-8);
    EXPECT_LE(audit().relativeDefect(), .005);
    const auto photons =
        reference::tracePhotons(*problem().scene, problem().rays, problem().executor, {3, 1'000'000});
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(photons.absorbed.standardError[c], .0015 * photons.absorbed.mean[c]);
        EXPECT_NEAR(audit().absorbed[c] / photons.absorbed.mean[c], 1.0, .005);
        EXPECT_NEAR(audit().escaped[c] / photons.escaped.mean[c], 1.0, .005);
    }
}

}  // namespace fluxwalk
