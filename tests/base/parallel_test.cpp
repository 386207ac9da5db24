#include "core/base/parallel.h"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace fluxwalk::base {
namespace {

class ParallelTest : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Threads, ParallelTest, testing::Values(1u, 2u, 5u));

TEST_P(ParallelTest, CoversEveryIndexOnce) {
    const Executor executor(GetParam());
    EXPECT_EQ(executor.threadCount(), GetParam());
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
        for (const std::size_t grain : {std::size_t{0}, std::size_t{1}, std::size_t{64}, std::size_t{5000}}) {
            std::vector<int> visits(count, 0);
            executor.forRange(count, grain, [&](std::size_t begin, std::size_t end) {
                ASSERT_LT(begin, end);
                for (std::size_t i = begin; i < end; ++i) {
                    ++visits[i];
                }
            });
            EXPECT_EQ(visits, std::vector<int>(count, 1)) << "count " << count << " grain " << grain;
        }
    }
}

TEST_P(ParallelTest, RangesStartAtMultiplesOfTheGrain) {
    const Executor executor(GetParam());
    std::atomic<int> ranges{0};
    executor.forRange(100, 32, [&](std::size_t begin, std::size_t end) {
        EXPECT_EQ(begin % 32, 0u);
        EXPECT_EQ(end, std::min<std::size_t>(100, begin + 32));
        ++ranges;
    });
    EXPECT_EQ(ranges, 4);
}

TEST(Parallel, aLargeTeamAfterASmallOneIsReallyLarge) {
    constexpr unsigned kTeam = 8;
    const Executor alone(1);
    alone.forRange(2, 1, [](std::size_t, std::size_t) {});
    const Executor team(kTeam);
    std::atomic<unsigned> present{0};
    std::atomic<unsigned> met{0};
    // Each body waits for the other seven: with fewer threads than bodies they never meet.
    team.forRange(kTeam, 1, [&](std::size_t, std::size_t) {
        ++present;
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (present < kTeam && std::chrono::steady_clock::now() < deadline) {
            std::this_thread::yield();
        }
        met += present == kTeam ? 1 : 0;
    });
    EXPECT_EQ(met, kTeam);
}

TEST_P(ParallelTest, RethrowsAnExceptionOfABody) {
    const Executor executor(GetParam());
    EXPECT_THROW(executor.forRange(1000, 1,
                                   [](std::size_t begin, std::size_t) {
                                       if (begin == 500) {
                                           throw std::runtime_error("body");
                                       }
                                   }),
                 std::runtime_error);
    int sum = 0;
    executor.forRange(1, 1, [&](std::size_t, std::size_t) { ++sum; });
    EXPECT_EQ(sum, 1) << "the executor works on after a failure";
}

TEST_P(ParallelTest, WritesToDisjointOutputsArriveBeforeItReturns) {
    const Executor executor(GetParam());
    std::vector<std::size_t> squares(10000);
    executor.forRange(squares.size(), 100, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            squares[i] = i * i;
        }
    });
    for (std::size_t i = 0; i < squares.size(); ++i) {
        ASSERT_EQ(squares[i], i * i);
    }
}

TEST_P(ParallelTest, WithinRunsTheWorkBeforeItReturns) {
    const Executor executor(GetParam());
    bool done = false;
    executor.within([&] { done = true; });
    EXPECT_TRUE(done);
}

TEST(Parallel, ZeroMeansTheHardware) {
    EXPECT_GE(Executor(0).threadCount(), 1u);
}

}  // namespace
}  // namespace fluxwalk::base
