#include "viewer/session/still_job.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/viewer/plain_stills.h"

namespace fluxwalk::session {
namespace {

using image::Still;
using image::StillCallbacks;
using image::StillOptions;
using testing::Collected;
using testing::countPixels;
using testing::sized;

TEST(StillJob, HandsOutEveryPixelOnce) {
    StillJob job({}, sized(100, 70));
    EXPECT_EQ(job.status().phase, StillPhase::waiting);
    Collected collected(100, 70);
    std::vector<double> seen;
    job.run(countPixels, [&] {
        EXPECT_EQ(job.still(), nullptr);
        seen.push_back(job.status().progress);
        collected.add(job.takeParts());
    });
    const StillStatus status = job.status();
    EXPECT_EQ(status.phase, StillPhase::done);
    EXPECT_TRUE(status.isOver());
    EXPECT_EQ(seen, (std::vector<double>{32.0 / 70, 64.0 / 70, 1.0}));
    EXPECT_EQ(collected.pixels, 7000u);
    ASSERT_NE(job.still(), nullptr);
    EXPECT_EQ(collected.luminance, job.still()->luminance);
    EXPECT_TRUE(job.takeParts().empty());
    // Once only.
    job.run([](const auto&, const auto&, const auto&) -> Still { throw std::logic_error("again"); }, {});
    EXPECT_EQ(job.status().phase, StillPhase::done);
}

TEST(StillJob, SmallerPartsAreMeansOfSquares) {
    StillJob job({}, sized(70, 37), 4);
    job.run(countPixels, {});
    Collected collected(18, 10);
    collected.add(job.takeParts());
    EXPECT_EQ(collected.pixels, 180u);
    const auto expected = [](std::uint32_t x, std::uint32_t y) {
        double sum = 0.0;
        int count = 0;
        for (std::uint32_t v = 4 * y; v < std::min(37u, 4 * y + 4); ++v) {
            for (std::uint32_t u = 4 * x; u < std::min(70u, 4 * x + 4); ++u) {
                sum += 70.0 * v + u;
                ++count;
            }
        }
        return sum / count;
    };
    for (std::uint32_t y = 0; y < 10; ++y) {
        for (std::uint32_t x = 0; x < 18; ++x) {
            EXPECT_FLOAT_EQ(collected.luminance[3 * (18 * y + x) + 1], static_cast<float>(expected(x, y)))
                << x << ' ' << y;
        }
    }
}

TEST(StillJob, CancelKeepsWhatIsDone) {
    StillJob job({}, sized(64, 96));
    job.run(countPixels, [&] { job.cancel(); });
    EXPECT_EQ(job.status().phase, StillPhase::cancelled);
    ASSERT_NE(job.still(), nullptr);
    EXPECT_EQ(job.still()->rowsDone, 32u);
    EXPECT_EQ(job.still()->luminance[3 * (31 * 64 + 63)], 31.0f * 64 + 63);
    EXPECT_EQ(job.still()->luminance[3 * (32 * 64)], 0.0f);
    Collected collected(64, 96);
    collected.add(job.takeParts());
    EXPECT_EQ(collected.pixels, 64u * 32u);
}

TEST(StillJob, CancelledBeforeAnythingIsDoneItHasNoPicture) {
    StillJob waiting({}, sized(64, 64));
    waiting.cancel();
    EXPECT_EQ(waiting.status().phase, StillPhase::cancelled);
    waiting.run([](const auto&, const auto&, const auto&) -> Still { throw std::logic_error("run"); }, {});
    EXPECT_EQ(waiting.status().phase, StillPhase::cancelled);
    EXPECT_EQ(waiting.still(), nullptr);

    StillJob early({}, sized(64, 64));
    early.run(
        [&](const scene::Camera& camera, const StillOptions& options, const StillCallbacks& callbacks) {
            early.cancel();
            return countPixels(camera, options, callbacks);
        },
        {});
    EXPECT_EQ(early.status().phase, StillPhase::cancelled);
    EXPECT_EQ(early.still(), nullptr);
}

TEST(StillJob, FailureIsToldAndHurtsNobodyElse) {
    StillJob job({}, sized(64, 64));
    job.run([](const auto&, const auto&, const auto&) -> Still { throw std::bad_alloc(); }, {});
    EXPECT_EQ(job.status().phase, StillPhase::failed);
    EXPECT_FALSE(job.status().failure.empty());
    EXPECT_EQ(job.still(), nullptr);
}

}  // namespace
}  // namespace fluxwalk::session
