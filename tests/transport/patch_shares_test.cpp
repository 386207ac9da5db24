#include "core/transport/patch_shares.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace fluxwalk {

namespace {

using base::Rgb;
using base::Vec3d;
using transport::Ball;

constexpr std::size_t kPatches = 150;

hierarchy::PatchTable makeTable() {
    hierarchy::PatchTable table;
    base::RandomStream random(7);
    const auto next = [&random] { return static_cast<float>(random.next()); };
    for (std::size_t i = 0; i < kPatches; ++i) {
        const base::Vec3 axis = glm::normalize(base::Vec3(next() - .5f, next() - .5f, next() - .5f));
        for (std::size_t k = 0; k < 3; ++k) {
            table.center[k].push_back(next());
            table.axis[k].push_back(axis[static_cast<int>(k)]);
        }
        table.spread.push_back(.5f * next());
        table.area.push_back(.1f + next());
    }
    return table;
}

}  // namespace

// However many patches are taken at once: as one by one.
TEST(PatchShares, sumsAreThoseOfSinglePatches) {
    const hierarchy::PatchTable table = makeTable();
    const Ball ball{{1.5f, .5f, .5f}, .8f};
    std::array<std::vector<float>, 3> values;
    for (std::size_t i = 0; i < kPatches; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            values[c].push_back(static_cast<float>(10 * c) + table.center[c][i]);
        }
    }
    int lit = 0;
    for (const std::size_t begin : {0U, 3U, 64U}) {
        for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 63U, 64U, 65U, 72U, 86U}) {
            Vec3d wanted(0.0);
            for (std::size_t i = begin; i < begin + count; ++i) {
                const double weight = static_cast<double>(table.area[i]) *
                                      static_cast<double>(transport::computeShare(table, i, ball));
                wanted += weight * Vec3d(values[0][i], values[1][i], values[2][i]);
                lit += weight > 0.0 ? 1 : 0;
            }
            const Vec3d sum =
                transport::sumShared(table, begin, begin + count, ball, {values[0], values[1], values[2]});
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(sum[c], wanted[c], 1e-6 * wanted[c]) << begin << " " << count;
            }
        }
    }
    EXPECT_GT(lit, 100);
}

TEST(PatchShares, areAddedUpToALimit) {
    const hierarchy::PatchTable table = makeTable();
    const Ball ball{{1.5f, .5f, .5f}, .8f};
    const Rgb flux(1.0f, 2.0f, 4.0f);
    const Rgb most(.5f);
    constexpr std::size_t kPlace = 5;
    int limited = 0;
    int free = 0;
    for (const std::size_t count : {1U, 8U, 13U, 59U}) {
        transport::RunSums sums{};
        sums[1][kPlace] = 3.0f;
        transport::addShared(table, 20, count, ball, flux, most, sums, kPlace);
        for (std::size_t i = 0; i < transport::kPatchRun; ++i) {
            const bool isIn = i >= kPlace && i < kPlace + count;
            const float share = isIn ? transport::computeShare(table, 20 + i - kPlace, ball) : 0.0f;
            for (std::size_t c = 0; c < 3; ++c) {
                const float before = i == kPlace && c == 1 ? 3.0f : 0.0f;
                const float part = std::min(share * flux[static_cast<int>(c)], .5f);
                EXPECT_FLOAT_EQ(sums[c][i], before + part);
                limited += part == .5f ? 1 : 0;
                free += part > 0.0f && part < .5f ? 1 : 0;
            }
        }
    }
    EXPECT_GT(limited, 10);
    EXPECT_GT(free, 10);
}

}  // namespace fluxwalk
