#include "core/reference/agreement.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace fluxwalk {
namespace {

using reference::Agreement;
using reference::Claim;
using reference::Estimate;

Estimate estimate(double value, double error) {
    Estimate e;
    e.luminance = value;
    e.luminanceError = error;
    return e;
}

// A normal number by Box and Muller.
double normal(base::RandomStream& random) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random.next()));
    return radius * std::cos(2.0 * base::kPi * random.next());
}

}  // namespace

TEST(Agreement, takesTheNoiseOfTheReferenceOff) {
    constexpr int kCount = 20000;
    base::RandomStream random(4);
    std::vector<Claim> claims;
    std::vector<Estimate> truth;
    for (int i = 0; i < kCount; ++i) {
        // Values with an error of 2 and a bias of 1, a reference with an error of 5.
        const double value = 101.0 + 2.0 * normal(random);
        claims.push_back({value, value - 2.5758 * 2.0 - 1.0, value + 2.5758 * 2.0 + 1.0});
        truth.push_back(estimate(100.0 + 5.0 * normal(random), 5.0));
    }
    const Agreement a = reference::compare(claims, truth);
    EXPECT_EQ(a.count, static_cast<std::size_t>(kCount));
    EXPECT_NEAR(a.mean, 100.0, 0.2);
    EXPECT_NEAR(a.noise, 0.05, 1e-3);
    EXPECT_NEAR(a.rms, std::sqrt(5.0) / 100.0, 2e-3);
    EXPECT_NEAR(a.bias, 0.01, 4.0 * a.biasError);
    EXPECT_NEAR(a.biasError, 0.05 / std::sqrt(kCount), 1e-5);
    EXPECT_GE(a.held, 99u * kCount / 100u);
    EXPECT_NEAR(a.medianWidth, (2.0 * 2.5758 * 2.0 + 2.0) / 101.0, 1e-3);
}

TEST(Agreement, countsWhatIntervalsHoldAndNamesTheWorst) {
    const std::vector<Claim> claims{{10, 9, 11}, {10, 9.9, 10.1}, {10, 10, 10}, {10, 0, 100}, {10, 9, 11}};
    const std::vector<Estimate> truth{estimate(10.5, 0.1), estimate(10.3, 0.01), estimate(12, 0.1),
                                      estimate(50, 0.1), estimate(10, INFINITY)};
    const Agreement a = reference::compare(claims, truth, 2);
    EXPECT_EQ(a.count, 4u) << "one has no reference yet";
    EXPECT_EQ(a.held, 2u);
    EXPECT_EQ(a.worst, (std::vector<std::size_t>{2, 1}));
    EXPECT_EQ(reference::compare({}, {}).count, 0u);
}

}  // namespace fluxwalk
