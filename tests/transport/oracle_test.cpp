#include "core/transport/oracle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/transport/coefficients.h"

namespace fluxwalk {
namespace {

using transport::assess;
using transport::LinkBounds;
using transport::OracleKind;

constexpr std::array kOracles{OracleKind::bounded, OracleKind::bfa, OracleKind::bf};

LinkBounds randomBounds(base::RandomStream& random) {
    const auto draw = [&random](double low, double high) {
        return static_cast<float>(low + (high - low) * random.next());
    };
    LinkBounds k;
    k.coupling = draw(0.0, 2.0);
    k.visibility = draw(0.0, 1.0);
    k.visibilityUpper = k.visibility + (1.0f - k.visibility) * draw(0.0, 1.0);
    k.isMixed = random.next() < 0.5;
    k.spreadA = draw(0.0, 2.0);
    k.spreadB = draw(0.0, 2.0);
    k.curvatureA = draw(0.0, 1.0);
    k.curvatureB = draw(0.0, 1.0);
    k.radiosityA = draw(0.0, 100.0);
    k.radiosityB = draw(0.0, 100.0);
    k.residualA = draw(0.0, 20.0);
    k.residualB = draw(0.0, 20.0);
    k.rangeA = k.residualA + draw(0.0, 30.0);
    k.rangeB = k.residualB + draw(0.0, 30.0);
    k.areaA = draw(0.1, 3.0);
    k.areaB = draw(0.1, 3.0);
    k.radiusA = draw(0.1, 2.0);
    k.radiusB = draw(0.1, 2.0);
    k.distance = draw(0.1, 5.0);
    k.sceneArea = draw(5.0, 50.0);
    return k;
}

// Swaps the roles of the two ends.
LinkBounds swapped(LinkBounds k) {
    std::swap(k.spreadA, k.spreadB);
    std::swap(k.curvatureA, k.curvatureB);
    std::swap(k.radiosityA, k.radiosityB);
    std::swap(k.residualA, k.residualB);
    std::swap(k.rangeA, k.rangeB);
    std::swap(k.areaA, k.areaB);
    std::swap(k.radiusA, k.radiusB);
    return k;
}

TEST(Oracle, errorsGrowWithEveryBoundOfTheirTransport) {
    base::RandomStream random(31);
    const std::array growing{&LinkBounds::coupling,  &LinkBounds::visibilityUpper, &LinkBounds::spreadA,
                             &LinkBounds::spreadB,   &LinkBounds::radiosityA,      &LinkBounds::radiosityB,
                             &LinkBounds::residualA, &LinkBounds::residualB,       &LinkBounds::rangeA,
                             &LinkBounds::rangeB};
    const std::array shrinking{&LinkBounds::sceneArea, &LinkBounds::distance};
    for (int i = 0; i < 2000; ++i) {
        const LinkBounds k = randomBounds(random);
        for (const OracleKind oracle : kOracles) {
            const float error = assess(oracle, k).error;
            EXPECT_GE(error, 0.0f);
            EXPECT_TRUE(std::isfinite(error));
            for (const auto member : growing) {
                LinkBounds more = k;
                more.*member *= 1.5f;
                EXPECT_GE(assess(oracle, more).error, error * (1.0f - 1e-6f));
            }
            for (const auto member : shrinking) {
                LinkBounds more = k;
                more.*member *= 1.5f;
                EXPECT_LE(assess(oracle, more).error, error * (1.0f + 1e-6f));
            }
        }
        // More is seen: of power (not mixed, where half seen is worst) more arrives.
        LinkBounds clear = k;
        clear.isMixed = false;
        LinkBounds clearer = clear;
        clearer.visibility = std::min(1.0f, 1.3f * clear.visibility);
        for (const OracleKind oracle : kOracles) {
            EXPECT_GE(assess(oracle, clearer).error, assess(oracle, clear).error * (1.0f - 1e-6f));
        }
        LinkBounds mixed = k;
        mixed.isMixed = true;
        EXPECT_GE(assess(OracleKind::bounded, mixed).error, assess(OracleKind::bounded, clear).error);
    }
}

TEST(Oracle, isTheSameForBothOrders) {
    base::RandomStream random(32);
    for (int i = 0; i < 2000; ++i) {
        const LinkBounds k = randomBounds(random);
        for (const OracleKind oracle : kOracles) {
            EXPECT_FLOAT_EQ(assess(oracle, k).error, assess(oracle, swapped(k)).error);
            EXPECT_NE(assess(oracle, k).splitA, assess(oracle, swapped(k)).splitA);
        }
    }
}

// Lux: twice the light is twice the error; the same scene in other lengths has the same.
TEST(Oracle, units) {
    base::RandomStream random(33);
    for (int i = 0; i < 500; ++i) {
        const LinkBounds k = randomBounds(random);
        LinkBounds bright = k;
        for (const auto member : {&LinkBounds::radiosityA, &LinkBounds::radiosityB, &LinkBounds::residualA,
                                  &LinkBounds::residualB, &LinkBounds::rangeA, &LinkBounds::rangeB}) {
            bright.*member *= 7.0f;
        }
        LinkBounds large = k;
        for (const auto member :
             {&LinkBounds::coupling, &LinkBounds::areaA, &LinkBounds::areaB, &LinkBounds::sceneArea}) {
            large.*member *= 9.0f;
        }
        for (const auto member : {&LinkBounds::radiusA, &LinkBounds::radiusB, &LinkBounds::distance}) {
            large.*member *= 3.0f;
        }
        for (const OracleKind oracle : kOracles) {
            const float error = assess(oracle, k).error;
            EXPECT_NEAR(assess(oracle, bright).error, 7.0f * error, 7e-5f * error + 1e-9f);
            EXPECT_NEAR(assess(oracle, large).error, error, 1e-5f * error + 1e-9f);
        }
    }
}

TEST(Oracle, definitionsOfBfAndBfa) {
    LinkBounds k;
    k.coupling = 0.3f;
    k.visibility = 0.5f;
    k.radiosityA = 10.0f;
    k.radiosityB = 40.0f;
    k.areaA = 2.0f;
    k.areaB = 0.25f;
    k.sceneArea = 12.0f;
    k.radiusA = 1.0f;
    k.radiusB = 0.4f;
    // BF: irradiance that arrives, H_a = g V B_b / A_a = 3 lux, H_b = 6 lux; the worse of both.
    EXPECT_FLOAT_EQ(assess(OracleKind::bf, k).error, 6.0f);
    // BFA: power that arrives, g V B = 6 lm, as lux over the scene's area.
    EXPECT_FLOAT_EQ(assess(OracleKind::bfa, k).error, 0.5f);
    EXPECT_TRUE(assess(OracleKind::bfa, k).splitA) << "the larger end";
    EXPECT_FALSE(assess(OracleKind::bfa, swapped(k)).splitA);
}

TEST(Oracle, theBoundedOneTrustsWhatIsConstant) {
    LinkBounds k;
    k.coupling = 1.0f;
    k.radiosityA = k.radiosityB = 100.0f;
    // Constant kernel, constant radiosity, free view: nothing to refine, whatever is transferred.
    EXPECT_EQ(assess(OracleKind::bounded, k).error, 0.0f);
    k.isMixed = true;
    k.visibility = 0.5f;
    EXPECT_FLOAT_EQ(assess(OracleKind::bounded, k).error, 50.0f) << "g B sqrt(v (1 - v)) over 1 m2";
    k.radiusA = 10.0f;
    EXPECT_TRUE(assess(OracleKind::bounded, k).splitA) << "much larger";
    k.radiusB = 100.0f;
    EXPECT_FALSE(assess(OracleKind::bounded, k).splitA);
}

TEST(Oracle, darkLinksHaveNoError) {
    base::RandomStream random(34);
    for (int i = 0; i < 100; ++i) {
        LinkBounds k = randomBounds(random);
        k.radiosityA = k.radiosityB = k.residualA = k.residualB = k.rangeA = k.rangeB = 0.0f;
        for (const OracleKind oracle : kOracles) {
            EXPECT_EQ(assess(oracle, k).error, 0.0f);
        }
    }
}

// Chance that the bound from n rays is at least the true visibility, over all outcomes (binomial).
double coverage(double v, unsigned n) {
    double covered = 0.0;
    for (unsigned k = 0; k <= n; ++k) {
        const double logChance = std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                                 k * std::log(v) + (n - k) * std::log(1.0 - v);
        const float seen = static_cast<float>(k) / static_cast<float>(n);
        if (static_cast<double>(transport::visibilityUpperBound(seen, n)) >= v) {
            covered += std::exp(logChance);
        }
    }
    return covered;
}

TEST(VisibilityUpperBound, holdsInFiveOfSixCases) {
    // One standard deviation on one side would be 84 % of a normal distribution. As rays are counted, the
    // rate is a sawtooth; it is worst just below 1, where the bound misses by little.
    for (const unsigned rays : {16u, 64u}) {
        double sum = 0.0;
        constexpr int kSteps = 999;
        for (int i = 1; i <= kSteps; ++i) {
            const double v = i / (kSteps + 1.0);
            const double rate = coverage(v, rays);
            sum += rate;
            EXPECT_GT(rate, 0.5) << rays << " rays, visibility " << v;
            if (v < 0.9) {
                EXPECT_GT(rate, 0.65) << rays << " rays, visibility " << v;
            }
        }
        EXPECT_GT(sum / kSteps, 0.84) << rays;
    }
}

TEST(VisibilityUpperBound, isAboveTheEstimateAndNotAboveOne) {
    for (const unsigned rays : {16u, 64u, 1000u}) {
        float last = 0.0f;
        for (int i = 0; i <= 64; ++i) {
            const float v = static_cast<float>(i) / 64.0f;
            const float upper = transport::visibilityUpperBound(v, rays);
            EXPECT_LE(upper, 1.0f);
            EXPECT_GE(upper, v) << rays;
            EXPECT_GE(upper, last);
            last = upper;
        }
        EXPECT_EQ(last, 1.0f) << "nothing was blocked";
    }
    EXPECT_GT(transport::visibilityUpperBound(0.0f, 16), 0.1f)
        << "no ray came through, yet it is not certain";
}

TEST(Oracle, curvatureIsThatOfTheCosines) {
    using transport::boundCurvature;
    for (const float angle : {0.0f, 0.4f, 1.2f, 1.6f, 3.0f}) {
        EXPECT_EQ(boundCurvature(angle, 0.0f), 0.0f);
    }
    // All above the horizon: the cosines of the ends have the mean cos(angle) cos(halfAngle).
    for (const float angle : {0.5f, 0.8f, 1.0f}) {
        const float tangent = std::tan(0.2f);
        EXPECT_NEAR(boundCurvature(angle, 0.4f), 2.0f * tangent * tangent, 1e-5f);
    }
    EXPECT_GT(boundCurvature(1.4f, 0.4f), boundCurvature(1.0f, 0.4f));
    EXPECT_GT(boundCurvature(1.6f, 0.4f), boundCurvature(1.4f, 0.4f));
    EXPECT_LE(boundCurvature(3.0f, 0.4f), 64.0f);
}

TEST(Oracle, selfLinksOfCapsAreBounded) {
    // Inside of a sphere a cap sees sin2(halfAngle / 2) of itself.
    EXPECT_EQ(transport::assessSelf(OracleKind::bf, {1.0f, 0.0f, 100.0f, 1.0f}), 0.0f);
    for (const float halfAngle : {0.01f, 0.1f, 0.5f, 1.0f, 1.5f, 3.0f}) {
        const float seen = std::sin(0.5f * halfAngle) * std::sin(0.5f * halfAngle);
        const float irradiance = transport::assessSelf(OracleKind::bf, {2.0f, halfAngle, 100.0f, 50.0f});
        EXPECT_GE(irradiance, 100.0f * seen);
        EXPECT_LE(irradiance, std::min(100.0f, 17.0f * 100.0f * seen));
        for (const OracleKind oracle : {OracleKind::bounded, OracleKind::bfa}) {
            EXPECT_FLOAT_EQ(transport::assessSelf(oracle, {2.0f, halfAngle, 100.0f, 50.0f}),
                            irradiance * 2.0f / 50.0f);
        }
    }
}

}  // namespace
}  // namespace fluxwalk
