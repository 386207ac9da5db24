#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

// Stops and limits take effect at wave boundaries and keep what is solved.

namespace fluxwalk {

namespace {

using solve::Outcome;
using solve::Snapshot;
using solve::Solver;

Solver makeSolver(const solve::Options& options) {
    return {std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box-unit")), options, 2};
}

// A snapshot of a solution that is rough but whole: all sides that light reaches, no darkness.
void expectUsable(const Snapshot& snapshot) {
    EXPECT_TRUE(snapshot.finished);
    std::vector<bool> shown(8, false);
    for (const auto& mesh : snapshot.meshes) {
        shown[mesh->object] = true;
        EXPECT_FALSE(mesh->triangles.empty());
        double sum = 0.0;
        for (const base::Rgb& e : mesh->irradiance) {
            EXPECT_TRUE(std::isfinite(e.r) && e.r >= 0.0f);
            sum += static_cast<double>(e.r);
        }
        EXPECT_GT(sum, 0.0);
    }
    EXPECT_EQ(std::count(shown.begin(), shown.end(), true), 8);
    EXPECT_GT(snapshot.statistics.counters.sweeps, 0u);
}

}  // namespace

TEST(Stop, keepsWhatIsSolved) {
    for (const int allowed : {0, 1, 3, 10}) {
        solve::Options options;
        options.error = .005;
        Solver solver = makeSolver(options);
        std::shared_ptr<const Snapshot> last;
        int asked = 0;
        solve::Callbacks callbacks;
        callbacks.shouldStop = [&] { return asked++ >= allowed; };
        callbacks.publish = [&](std::shared_ptr<const Snapshot> snapshot) { last = std::move(snapshot); };
        EXPECT_EQ(solver.solve(callbacks), Outcome::stopped);
        ASSERT_TRUE(last);
        expectUsable(*last);
        // Floor of table 3.10, as far as it got.
        EXPECT_NEAR(test::meanIrradiance(solver.problem(), 0).x / .009044, 1.0, .3) << allowed;
    }
}

// Whoever looks at the solution, for as long as it takes, uses up no time of the solve's limit.
TEST(Stop, timeOfThoseWhoLookDoesNotCount) {
    using Clock = std::chrono::steady_clock;
    solve::Options options;
    options.error = .1;
    Solver solver = makeSolver(options);
    Clock::duration looked{};
    solve::Callbacks callbacks;
    callbacks.settled = [&] {
        const Clock::time_point start = Clock::now();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        looked += Clock::now() - start;
    };
    const double before = solver.statistics().times.total;
    const Clock::time_point start = Clock::now();
    solver.solve(callbacks);
    const Clock::duration passed = Clock::now() - start;
    EXPECT_GT(looked.count(), 0);
    EXPECT_LE(solver.statistics().times.total - before,
              std::chrono::duration<double>(passed - looked).count());
}

TEST(Stop, timeLimit) {
    solve::Options options;
    options.error = 1e-4;
    options.timeLimit = .3;
    Solver solver = makeSolver(options);
    std::shared_ptr<const Snapshot> last;
    solve::Callbacks callbacks;
    callbacks.publish = [&](std::shared_ptr<const Snapshot> snapshot) { last = std::move(snapshot); };
    EXPECT_EQ(solver.solve(callbacks), Outcome::reachedTimeLimit);
    ASSERT_TRUE(last);
    expectUsable(*last);
}

// A stopped solver goes on from where it is.
TEST(Stop, goesOn) {
    solve::Options options;
    options.error = .02;
    Solver solver = makeSolver(options);
    solve::Callbacks stopSoon;
    int asked = 0;
    stopSoon.shouldStop = [&] { return asked++ >= 4; };
    EXPECT_EQ(solver.solve(stopSoon), Outcome::stopped);
    const std::uint64_t links = solver.statistics().counters.links;
    EXPECT_EQ(solver.solve({}), Outcome::reachedError);
    EXPECT_GE(solver.statistics().counters.links, links);
    EXPECT_LE(solver.statistics().estimatedError, .02);
    EXPECT_NEAR(test::meanIrradiance(solver.problem(), 0).x / .009044, 1.0, .01);
}

TEST(Stop, snapshotsComeInOrder) {
    solve::Options options;
    options.error = .03;
    Solver solver = makeSolver(options);
    std::vector<std::uint64_t> sequences;
    std::size_t finished = 0;
    solve::Callbacks callbacks;
    callbacks.publish = [&](std::shared_ptr<const Snapshot> snapshot) {
        sequences.push_back(snapshot->sequence);
        finished += snapshot->finished ? 1u : 0u;
    };
    EXPECT_EQ(solver.solve(callbacks), Outcome::reachedError);
    EXPECT_EQ(finished, 1u);
    for (std::size_t i = 1; i < sequences.size(); ++i) {
        EXPECT_LT(sequences[i - 1], sequences[i]);
    }
}

}  // namespace fluxwalk
