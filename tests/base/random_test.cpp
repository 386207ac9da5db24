#include "core/base/random.h"

#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace fluxwalk::base {
namespace {

constexpr int kBins = 64;

/// Chi-square over kBins equal bins of [0, 1); 63 degrees of freedom have mean 63 and standard
/// deviation 11.2.
template <class Draw>
double chiSquare(int samples, Draw draw) {
    std::array<int, kBins> bins{};
    for (int i = 0; i < samples; ++i) {
        const double x = draw(i);
        EXPECT_GE(x, 0.0);
        EXPECT_LT(x, 1.0);
        ++bins[static_cast<std::size_t>(x * kBins)];
    }
    const double expected = static_cast<double>(samples) / kBins;
    double sum = 0.0;
    for (const int n : bins) {
        sum += (n - expected) * (n - expected) / expected;
    }
    return sum;
}

TEST(Random, StreamIsUniform) {
    RandomStream random(combine(1, 2));
    // Four standard deviations above the mean.
    EXPECT_LT(chiSquare(100000, [&](int) { return random.next(); }), 108.0);
}

TEST(Random, FirstNumbersOfNeighbouringKeysAreUniform) {
    const auto firstOfKey = [](int i) {
        return RandomStream(combine(combine(1, 3), static_cast<std::uint64_t>(i))).next();
    };
    EXPECT_LT(chiSquare(100000, firstOfKey), 108.0);
}

TEST(Random, PairsAreUncorrelated) {
    RandomStream random(99);
    const int samples = 100000;
    double sum = 0.0;
    for (int i = 0; i < samples; ++i) {
        const Vec2d p = random.next2();
        sum += (p.x - 0.5) * (p.y - 0.5);
    }
    // The product has standard deviation 1/12.
    EXPECT_LT(std::abs(sum / samples), 4.0 / 12.0 / std::sqrt(static_cast<double>(samples)));
}

TEST(Random, SameKeyGivesTheSameNumbers) {
    RandomStream a(5);
    RandomStream b(5);
    RandomStream c(6);
    EXPECT_EQ(a.next(), b.next());
    EXPECT_EQ(a.next(), b.next());
    EXPECT_NE(a.next(), c.next());
}

TEST(Random, CombineDependsOnTheOrder) {
    EXPECT_NE(combine(combine(0, 1), 2), combine(combine(0, 2), 1));
}

TEST(Random, MixIsInjectiveOnCounters) {
    std::set<std::uint64_t> seen;
    for (std::uint64_t i = 0; i < 10000; ++i) {
        seen.insert(mix(i));
    }
    EXPECT_EQ(seen.size(), 10000u);
}

TEST(Random, UnitStaysBelowOne) {
    EXPECT_EQ(toUnit(0), 0.0);
    EXPECT_LT(toUnit(~0ULL), 1.0);
}

TEST(Random, R2IntegratesASmoothFunctionBetterThanRandomPoints) {
    // Integral of x y over the unit square is 1/4; 1,024 random points have a standard error of 0.007.
    double sum = 0.0;
    const int samples = 1024;
    for (std::uint64_t i = 0; i < samples; ++i) {
        const Vec2d p = r2Point(i, {0.3, 0.7});
        EXPECT_GE(p.x, 0.0);
        EXPECT_LT(p.x, 1.0);
        EXPECT_GE(p.y, 0.0);
        EXPECT_LT(p.y, 1.0);
        sum += p.x * p.y;
    }
    EXPECT_NEAR(sum / samples, 0.25, 0.001);
}

}  // namespace
}  // namespace fluxwalk::base
