#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/scene/builders.h"
#include "core/scene/lighting.h"
#include "core/solve/state.h"
#include "tests/viewer/plain_stills.h"
#include "viewer/session/solver_session.h"

namespace fluxwalk::session {
namespace {

using namespace std::chrono_literals;
using image::Still;
using image::StillCallbacks;
using image::StillOptions;
using solve::Options;
using testing::Collected;
using testing::countPixels;
using testing::emptyStill;
using testing::sized;
using testing::waitFor;

/// Stills of a session whose solver only counts.
Solving counting(int waves, std::atomic<bool>& isFit) {
    Solving solving;
    solving.solve = [waves](const Options&, const solve::Callbacks& callbacks) {
        for (int wave = 0; wave < waves; ++wave) {
            if (callbacks.shouldStop()) {
                return solve::Outcome::stopped;
            }
            callbacks.settled();
        }
        return solve::Outcome::reachedError;
    };
    solving.look.takeStill = countPixels;
    solving.look.isFitForStill = [&isFit] { return isFit.load(); };
    solving.look.inspect = [](const rays::Ray& ray) {
        image::Inspection inspection;
        inspection.object = static_cast<std::uint32_t>(ray.origin.x);
        return std::optional(inspection);
    };
    return solving;
}

TEST(SessionStills, WaitForALightThatIsFit) {
    std::atomic<bool> isFit = false;
    SolverSession session(counting(1 << 30, isFit), Options{}, {});
    const auto job = std::make_shared<StillJob>(scene::Camera{}, sized(64, 64));
    session.take(job);
    std::this_thread::sleep_for(5ms);
    EXPECT_EQ(job->status().phase, StillPhase::waiting);
    isFit = true;
    waitFor([&] { return job->status().isOver(); });
    EXPECT_EQ(job->status().phase, StillPhase::done);
    EXPECT_EQ(session.status().phase, Phase::solving);
}

TEST(SessionStills, AreTakenAtRestOfWhatThereIs) {
    std::atomic<bool> isFit = false;
    for (const bool isPausing : {false, true}) {
        std::atomic<bool> hasBegun = false;
        Solving solving = counting(isPausing ? 1 << 30 : 3, isFit);
        solving.solve = [&hasBegun, inner = solving.solve](const Options& options,
                                                           const solve::Callbacks& callbacks) {
            hasBegun = true;
            return inner(options, callbacks);
        };
        SolverSession session(std::move(solving), Options{}, {});
        waitFor([&] { return hasBegun.load(); });
        session.setPaused(isPausing);
        const Phase rest = isPausing ? Phase::paused : Phase::finished;
        waitFor([&] { return session.status().phase == rest; });
        const auto job = std::make_shared<StillJob>(scene::Camera{}, sized(64, 64));
        session.take(job);
        waitFor([&] { return job->status().isOver(); });
        EXPECT_EQ(job->status().phase, StillPhase::done);
        EXPECT_EQ(session.status().phase, rest);
    }
}

TEST(SessionStills, ALaterOneTakesThePlaceOfOneThatWaits) {
    std::atomic<bool> isFit = false;
    SolverSession session(counting(1 << 30, isFit), Options{}, {});
    const auto first = std::make_shared<StillJob>(scene::Camera{}, sized(64, 64));
    const auto second = std::make_shared<StillJob>(scene::Camera{}, sized(64, 64));
    session.take(first);
    session.take(second);
    EXPECT_EQ(first->status().phase, StillPhase::cancelled);
    isFit = true;
    waitFor([&] { return second->status().isOver(); });
    EXPECT_EQ(second->status().phase, StillPhase::done);
    EXPECT_EQ(first->still(), nullptr);
}

TEST(SessionStills, QuestionsAreAnsweredBetweenStrips) {
    std::atomic<bool> isFit = true;
    Solving solving = counting(3, isFit);
    std::atomic<bool> isAnswered = false;
    solving.look.takeStill = [&](const scene::Camera&, const StillOptions& options,
                                 const StillCallbacks& callbacks) {
        Still still = emptyStill(options);
        // Ends when the question is answered, and not before.
        while (!isAnswered && !callbacks.shouldStop()) {
            callbacks.progress(0.5);
        }
        still.rowsDone = isAnswered ? still.height : 0;
        return still;
    };
    SolverSession session(std::move(solving), Options{}, {});
    const auto job = std::make_shared<StillJob>(scene::Camera{}, sized(64, 64));
    session.take(job);
    waitFor([&] { return job->status().phase == StillPhase::running; });
    rays::Ray ray;
    ray.origin.x = 7.0f;
    session.ask(ray);
    waitFor([&] { return session.finding() != nullptr; });
    EXPECT_EQ(session.finding()->inspection->object, 7u);
    isAnswered = true;
    waitFor([&] { return job->status().isOver(); });
    EXPECT_EQ(job->status().phase, StillPhase::done);
}

TEST(SessionStills, EndWithTheSession) {
    std::atomic<bool> isFit = true;
    base::RandomStream random(5);
    for (int i = 0; i < 50; ++i) {
        const auto job = std::make_shared<StillJob>(scene::Camera{}, sized(320, 320));
        {
            SolverSession session(counting(i % 2 == 0 ? 1 << 30 : 2, isFit), Options{}, {});
            session.take(job);
            std::this_thread::sleep_for(std::chrono::microseconds(static_cast<int>(2000.0 * random.next())));
            if (i % 3 == 0) {
                session.setOptions(Options{});
            }
            if (i % 7 == 0) {
                session.setPaused(true);
            }
        }
        // Done by then, or cancelled; nobody is left to make it.
        EXPECT_TRUE(job->status().isOver());
        SolverSession ended(counting(1, isFit), Options{}, {});
        ended.stop();
        const auto late = std::make_shared<StillJob>(scene::Camera{}, sized(64, 64));
        ended.take(late);
        EXPECT_EQ(late->status().phase, StillPhase::cancelled);
    }
}

/// A session over a real solver that can be looked into.
struct RealSession {
    explicit RealSession(double error) {
        scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
        SolverSource source;
        source.make = [this](const Options& asked) {
            auto made = std::make_unique<solve::Solver>(scene, asked, 2);
            solver = made.get();
            return made;
        };
        solving = solveWith(source);
        options.error = error;
        still = sized(64, 70);
    }

    std::shared_ptr<const scene::Scene> scene;
    const solve::Solver* solver = nullptr;
    Solving solving;
    Options options;
    StillOptions still;
};

void expectSame(const Still& a, const Still& b) {
    EXPECT_EQ(a.luminance, b.luminance);
    EXPECT_EQ(a.irradiance, b.irradiance);
    EXPECT_EQ(a.albedo, b.albedo);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.object, b.object);
    EXPECT_EQ(a.rowsDone, b.rowsDone);
    EXPECT_EQ(a.rays, b.rays);
}

TEST(SessionStills, AreThoseOfTheSolution) {
    RealSession real(0.2);
    SolverSession session(real.solving, real.options, {});
    session.wait();
    const auto job = std::make_shared<StillJob>(real.scene->cameras.front(), real.still);
    session.take(job);
    waitFor([&] { return job->status().isOver(); });
    ASSERT_EQ(job->status().phase, StillPhase::done);
    StillOptions same = real.still;
    same.seed = real.options.seed;
    const Still expected = image::takeStill(real.solver->problem(), real.scene->cameras.front(), same);
    ASSERT_NE(job->still(), nullptr);
    expectSame(*job->still(), expected);
    Collected collected(64, 70);
    collected.add(job->takeParts());
    EXPECT_EQ(collected.luminance, expected.luminance);
}

TEST(SessionStills, TurnedLightsWaitForThem) {
    RealSession real(0.2);
    SolverSession session(real.solving, real.options, {});
    session.wait();
    const double before = session.latest()->statistics.meanIrradiance;
    StillOptions same = real.still;
    same.seed = real.options.seed;
    const Still expected = image::takeStill(real.solver->problem(), real.scene->cameras.front(), same);
    const auto job = std::make_shared<StillJob>(real.scene->cameras.front(), real.still);
    session.take(job);
    waitFor([&] { return job->status().phase != StillPhase::waiting; });
    Options dimmed = real.options;
    for (const scene::LightSource& source : scene::listLightSources(*real.scene)) {
        scene::setFactor(dimmed.lighting, source, base::Rgb(0.5f));
    }
    session.setOptions(dimmed);
    waitFor([&] { return job->status().isOver(); });
    ASSERT_NE(job->still(), nullptr);
    expectSame(*job->still(), expected);
    session.wait();
    EXPECT_NEAR(session.latest()->statistics.meanIrradiance, 0.5 * before, 0.02 * before);
}

TEST(SessionStills, LeaveTheSolveAsItIs) {
    RealSession plain(0.1);
    SolverSession undisturbed(plain.solving, plain.options, {});
    undisturbed.wait();
    RealSession disturbed(0.1);
    // Stills while it solves, one after the other, each compared with another one of the same moment.
    std::atomic<bool> isSolving = false;
    std::atomic<int> whileSolving = 0;
    const Solving real = disturbed.solving;
    Solving watched = real;
    watched.solve = [&](const Options& options, const solve::Callbacks& callbacks) {
        isSolving = true;
        const solve::Outcome outcome = real.solve(options, callbacks);
        isSolving = false;
        return outcome;
    };
    watched.look.takeStill = [&](const scene::Camera& camera, const StillOptions& options,
                                 const StillCallbacks& callbacks) {
        Still still = real.look.takeStill(camera, options, callbacks);
        if (isSolving && still.rowsDone == still.height) {
            ++whileSolving;
            expectSame(real.look.takeStill(camera, options, {}), still);
        }
        return still;
    };
    SolverSession session(watched, disturbed.options, {});
    for (int i = 0; i < 12 && session.status().phase == Phase::solving; ++i) {
        const auto job = std::make_shared<StillJob>(disturbed.scene->cameras.front(), disturbed.still);
        session.take(job);
        if (i % 3 == 2) {
            waitFor([&] { return !job->takeParts().empty() || job->status().isOver(); });
            job->cancel();
        }
        waitFor([&] { return job->status().isOver(); });
        EXPECT_NE(job->status().phase, StillPhase::failed);
    }
    session.wait();
    EXPECT_GT(whileSolving, 0);
    const solve::Snapshot& snapshot = *session.latest();
    const scene::LitMeshes expected = plain.solver->litMeshes();
    ASSERT_EQ(snapshot.meshes.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(snapshot.meshes[i]->positions, expected[i]->positions);
        EXPECT_EQ(snapshot.meshes[i]->irradiance, expected[i]->irradiance);
    }
    const hierarchy::Hierarchy& nodes = disturbed.solver->problem().hierarchy;
    const hierarchy::Hierarchy& plainNodes = plain.solver->problem().hierarchy;
    ASSERT_EQ(nodes.nodeCount(), plainNodes.nodeCount());
    for (std::uint32_t i = 0; i < nodes.nodeCount(); ++i) {
        ASSERT_EQ(nodes.light(base::NodeId{i}).radiosity, plainNodes.light(base::NodeId{i}).radiosity);
        ASSERT_EQ(nodes.light(base::NodeId{i}).irradiance, plainNodes.light(base::NodeId{i}).irradiance);
    }
    const solve::Statistics& a = snapshot.statistics;
    const solve::Statistics& b = plain.solver->statistics();
    EXPECT_EQ(a.counters.links, b.counters.links);
    EXPECT_EQ(a.counters.nodes, b.counters.nodes);
    EXPECT_EQ(a.counters.rays, b.counters.rays);
    EXPECT_EQ(a.estimatedError, b.estimatedError);
    EXPECT_EQ(a.residual, b.residual);
    EXPECT_EQ(a.history.size(), b.history.size());
}

}  // namespace
}  // namespace fluxwalk::session
