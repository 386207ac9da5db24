#include <atomic>
#include <chrono>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "viewer/session/solver_session.h"

namespace fluxwalk::session {
namespace {

using namespace std::chrono_literals;
using solve::Callbacks;
using solve::Options;
using solve::Outcome;

/// A solve of so many waves that does what a solver does at each: asks, reports, publishes. Each snapshot's
/// parts are made from its number, so that a torn one would show.
class FakeSolver {
  public:
    explicit FakeSolver(int waves) : waves_(waves) {}

    Outcome operator()(const Options& options, const Callbacks& callbacks) {
        Options present = options;
        for (int wave = 0; wave < waves_; ++wave) {
            if (const auto changed = callbacks.newOptions()) {
                present = *changed;
            }
            if (callbacks.shouldStop()) {
                publish(present, callbacks, false);
                return Outcome::stopped;
            }
            callbacks.progress(static_cast<double>(wave) / waves_, wave % 2 == 0 ? "refine" : "sweep");
            publish(present, callbacks, false);
        }
        publish(present, callbacks, true);
        return Outcome::reachedError;
    }

  private:
    void publish(const Options& options, const Callbacks& callbacks, bool isLast) {
        auto snapshot = std::make_shared<solve::Snapshot>();
        snapshot->sequence = ++sequence_;
        auto mesh = std::make_shared<scene::LitMesh>();
        mesh->irradiance.assign(16, base::Rgb(static_cast<float>(sequence_)));
        snapshot->meshes.push_back(std::move(mesh));
        snapshot->statistics.threshold = options.error;
        snapshot->finished = isLast;
        callbacks.publish(std::move(snapshot));
    }

    int waves_;
    std::uint64_t sequence_ = 0;
};

/// Waits for something that must come; a test that waits for ever is killed by ctest.
template <class Condition>
void waitFor(const Condition& condition) {
    while (!condition()) {
        std::this_thread::sleep_for(200us);
    }
}

TEST(SolverSession, SolvesToTheEnd) {
    std::atomic<int> wakes = 0;
    SolverSession session(FakeSolver(5), Options{}, [&] { ++wakes; });
    const Status status = session.wait();
    EXPECT_EQ(status.phase, Phase::finished);
    EXPECT_EQ(status.outcome, Outcome::reachedError);
    ASSERT_NE(session.latest(), nullptr);
    EXPECT_EQ(session.latest()->sequence, 6u);
    EXPECT_TRUE(session.latest()->finished);
    EXPECT_GE(wakes, 6);
}

TEST(SolverSession, NewOptionsReachARunningSolve) {
    SolverSession session(FakeSolver(1 << 30), Options{}, {});
    waitFor([&] { return session.latest() != nullptr; });
    Options options;
    options.error = 0.25;
    session.setOptions(options);
    waitFor([&] { return session.latest()->statistics.threshold == 0.25; });
    EXPECT_EQ(session.options().error, 0.25);
    EXPECT_EQ(session.status().phase, Phase::solving);
}

TEST(SolverSession, NewOptionsMakeAFinishedSolveGoOn) {
    SolverSession session(FakeSolver(3), Options{}, {});
    session.wait();
    const std::uint64_t before = session.latest()->sequence;
    Options options;
    options.error = 0.005;
    session.setOptions(options);
    EXPECT_EQ(session.wait().phase, Phase::finished);
    EXPECT_GT(session.latest()->sequence, before);
    EXPECT_EQ(session.latest()->statistics.threshold, 0.005);
}

TEST(SolverSession, PausesAndGoesOnFromThere) {
    SolverSession session(FakeSolver(1 << 30), Options{}, {});
    waitFor([&] { return session.latest() != nullptr; });
    session.setPaused(true);
    waitFor([&] { return session.status().phase == Phase::paused; });
    const auto held = session.latest();
    std::this_thread::sleep_for(20ms);
    EXPECT_EQ(session.latest(), held);
    // Options while paused wait with the rest.
    Options options;
    options.error = 0.125;
    session.setOptions(options);
    std::this_thread::sleep_for(5ms);
    EXPECT_EQ(session.latest(), held);
    session.setPaused(false);
    waitFor([&] { return session.latest()->statistics.threshold == 0.125; });
    EXPECT_GT(session.latest()->sequence, held->sequence);
}

TEST(SolverSession, PausingAFinishedSolveChangesNothing) {
    SolverSession session(FakeSolver(2), Options{}, {});
    session.wait();
    session.setPaused(true);
    std::this_thread::sleep_for(5ms);
    EXPECT_EQ(session.status().phase, Phase::finished);
    session.setOptions(Options{});
    EXPECT_EQ(session.status().phase, Phase::paused);
    session.setPaused(false);
    EXPECT_EQ(session.wait().phase, Phase::finished);
}

TEST(SolverSession, StopEndsItForGood) {
    SolverSession session(FakeSolver(1 << 30), Options{}, {});
    session.stop();
    EXPECT_EQ(session.wait().phase, Phase::stopped);
    session.setOptions(Options{});
    session.setPaused(false);
    EXPECT_EQ(session.status().phase, Phase::stopped);
}

TEST(SolverSession, FailureIsKept) {
    SolverSession session(
        [](const Options&, const Callbacks&) -> Outcome { throw std::runtime_error("no light"); }, Options{},
        {});
    const Status status = session.wait();
    EXPECT_EQ(status.phase, Phase::failed);
    EXPECT_THROW(std::rethrow_exception(status.failure), std::runtime_error);
    EXPECT_EQ(session.latest(), nullptr);
}

TEST(SolverSession, JoinsAtAnyMoment) {
    base::RandomStream random(7);
    for (int i = 0; i < 300; ++i) {
        SolverSession session(FakeSolver(static_cast<int>(20.0 * random.next())), Options{}, {});
        if (i % 3 == 0) {
            std::this_thread::sleep_for(std::chrono::microseconds(static_cast<int>(300.0 * random.next())));
        }
        if (i % 5 == 0) {
            session.setPaused(true);
        }
    }
}

/// Everything at once from two threads, under ThreadSanitizer in CI.
TEST(SolverSession, Stress) {
    std::atomic<std::uint64_t> wakes = 0;
    SolverSession session(FakeSolver(50), Options{}, [&] { ++wakes; });
    const auto drive = [&](std::uint64_t seed) {
        base::RandomStream random(seed);
        std::uint64_t newest = 0;
        for (int i = 0; i < 2000; ++i) {
            const double choice = random.next();
            if (choice < 0.3) {
                Options options;
                options.error = random.next();
                session.setOptions(options);
            } else if (choice < 0.5) {
                session.setPaused(random.next() < 0.5);
            } else if (const auto snapshot = session.latest()) {
                ASSERT_GE(snapshot->sequence, newest);
                newest = snapshot->sequence;
                for (const base::Rgb& value : snapshot->meshes[0]->irradiance) {
                    ASSERT_EQ(value.g, static_cast<float>(newest));
                }
            }
            const Status status = session.status();
            ASSERT_NE(status.phase, Phase::failed);
            ASSERT_GE(status.progress, 0.0);
            ASSERT_LE(status.progress, 1.0);
        }
    };
    std::thread other([&] { drive(1); });
    drive(2);
    other.join();
    session.setPaused(false);
    EXPECT_EQ(session.wait().phase, Phase::finished);
    EXPECT_GT(wakes, 0u);
}

}  // namespace
}  // namespace fluxwalk::session
