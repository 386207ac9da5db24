#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/image/sensors.h"
#include "core/scene/builders.h"
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
    explicit FakeSolver(int waves,
                        std::shared_ptr<std::uint64_t> sequence = std::make_shared<std::uint64_t>(0))
        : waves_(waves), sequence_(std::move(sequence)) {}

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
            callbacks.settled();
            if (wave % 8 == 7) {
                callbacks.resumable(solve::Moment::level);
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
        snapshot->sequence = ++*sequence_;
        auto mesh = std::make_shared<scene::LitMesh>();
        mesh->irradiance.assign(16, base::Rgb(static_cast<float>(*sequence_)));
        snapshot->meshes.push_back(std::move(mesh));
        snapshot->statistics.threshold = options.error;
        snapshot->finished = isLast;
        if (callbacks.detail().elements) {
            snapshot->elements.push_back(std::make_shared<solve::MeshElements>());
        }
        callbacks.publish(std::move(snapshot));
    }

    int waves_;
    std::shared_ptr<std::uint64_t> sequence_;
};

/// Looks that answer with what was asked: the object is the ray's x.
Solving withLooks(int waves) {
    Solving solving;
    const auto sequence = std::make_shared<std::uint64_t>(0);
    solving.solve = FakeSolver(waves, sequence);
    solving.look.inspect = [](const rays::Ray& ray) {
        image::Inspection inspection;
        inspection.object = static_cast<std::uint32_t>(ray.origin.x);
        return std::optional(inspection);
    };
    solving.look.show = [sequence](const solve::Detail& detail) {
        auto snapshot = std::make_shared<solve::Snapshot>();
        snapshot->sequence = ++*sequence;
        auto mesh = std::make_shared<scene::LitMesh>();
        mesh->irradiance.assign(16, base::Rgb(static_cast<float>(snapshot->sequence)));
        snapshot->meshes.push_back(std::move(mesh));
        if (detail.elements) {
            snapshot->elements.push_back(std::make_shared<solve::MeshElements>());
        }
        return snapshot;
    };
    solving.look.isFitForStill = [] { return true; };
    solving.look.takeStill = [](const scene::Camera&, const image::StillOptions& asked,
                                const image::StillCallbacks& callbacks) {
        image::Still still;
        still.width = asked.width;
        still.height = asked.height;
        still.luminance.assign(std::size_t{3} * asked.width * asked.height, 1.0f);
        callbacks.tileDone(still, {0, 0, asked.width, asked.height});
        callbacks.progress(1.0);
        still.rowsDone = callbacks.shouldStop() ? 0 : asked.height;
        return still;
    };
    return solving;
}

rays::Ray rayFrom(float x) {
    rays::Ray ray;
    ray.origin.x = x;
    return ray;
}

bool isAnswered(const SolverSession& session, std::uint32_t x) {
    const auto finding = session.finding();
    return finding != nullptr && finding->inspection && finding->inspection->object == x;
}

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

TEST(SolverSession, QuestionsAreAnsweredWhileItSolves) {
    SolverSession session(withLooks(1 << 30), Options{}, {});
    EXPECT_EQ(session.finding(), nullptr);
    for (const std::uint32_t x : {3u, 4u, 5u}) {
        session.ask(rayFrom(static_cast<float>(x)));
        waitFor([&] { return isAnswered(session, x); });
        EXPECT_EQ(session.finding()->ray.origin.x, static_cast<float>(x));
    }
    EXPECT_EQ(session.status().phase, Phase::solving);
    session.setDetail({.elements = true});
    waitFor([&] { return !session.latest()->elements.empty(); });
}

TEST(SolverSession, QuestionsAreAnsweredAtRest) {
    for (const bool isPausing : {false, true}) {
        SolverSession session(withLooks(isPausing ? 1 << 30 : 2), Options{}, {});
        session.setPaused(isPausing);
        const Phase rest = isPausing ? Phase::paused : Phase::finished;
        waitFor([&] { return session.status().phase == rest; });
        session.ask(rayFrom(7.0f));
        waitFor([&] { return isAnswered(session, 7); });
        session.setDetail({.elements = true});
        waitFor([&] { return session.latest() != nullptr && !session.latest()->elements.empty(); });
        // Asked once, shown once.
        const auto shown = session.latest();
        session.setDetail({.elements = true});
        std::this_thread::sleep_for(5ms);
        EXPECT_EQ(session.latest(), shown);
        session.setDetail({});
        waitFor([&] { return session.latest()->elements.empty(); });
        EXPECT_EQ(session.status().phase, rest);
    }
}

TEST(SolverSession, WithoutLooksNothingIsMet) {
    SolverSession session(FakeSolver(2), Options{}, {});
    session.wait();
    session.ask(rayFrom(1.0f));
    waitFor([&] { return session.finding() != nullptr; });
    EXPECT_FALSE(session.finding()->inspection);
}

TEST(SolverSession, StepsGoOnToTheEndOfALevel) {
    SolverSession session(FakeSolver(1 << 30), Options{}, {});
    session.setPaused(true);
    waitFor([&] { return session.status().phase == Phase::paused; });
    std::uint64_t before = session.latest() ? session.latest()->sequence : 0;
    for (int i = 0; i < 3; ++i) {
        session.step();
        waitFor([&] {
            const auto newest = session.latest();
            return newest && newest->sequence > before + 8 && session.status().phase == Phase::paused;
        });
        EXPECT_FALSE(session.status().isStepping);
        // The solver of this test begins anew after each pause: eight waves, and one more that stops it.
        EXPECT_EQ(session.latest()->sequence, before + 9);
        before = session.latest()->sequence;
    }
    session.setPaused(false);
    waitFor([&] { return session.latest()->sequence > before + 50; });
}

TEST(SolverSession, PointsOfARealSolutionAreThoseOfMeasure) {
    auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    std::shared_ptr<solve::Solver> solver;
    SolverSource source;
    source.make = [&](const Options& options) {
        auto made = std::make_unique<solve::Solver>(scene, options, 1);
        solver = std::shared_ptr<solve::Solver>(std::shared_ptr<void>(), made.get());
        return made;
    };
    Options options;
    options.error = 0.3;
    SolverSession session(solveWith(source), options, {});
    const base::Vec3d middle = scene->bounds().center();
    rays::Ray ray{base::Vec3(middle), 0.0f, base::Vec3(0.2f, -1.0f, 0.1f), std::numeric_limits<float>::max()};
    session.ask(ray);
    session.wait();
    waitFor([&] { return session.finding() != nullptr; });
    // What was answered on the way may be of an earlier state; the solver rests now.
    ray.direction.x = 0.21f;
    session.ask(ray);
    waitFor([&] { return session.finding()->ray.direction.x == 0.21f; });
    const auto finding = session.finding();
    ASSERT_TRUE(finding->inspection);
    // The normal as it is printed, made unit as a table of sensors is read.
    scene::Sensor sensor = finding->inspection->point;
    const base::Vec3d size = glm::abs(sensor.normal);
    sensor.normal = glm::normalize(sensor.normal / std::max({size.x, size.y, size.z}));
    const std::vector<scene::Sensor> sensors{sensor};
    EXPECT_EQ(image::measure(*solver, sensors)[0], finding->inspection->irradiance);
    session.setDetail({.elements = true, .residuals = true, .clusters = true});
    waitFor([&] { return session.latest()->clusters != nullptr; });
    EXPECT_EQ(session.latest()->elements.size(), session.latest()->meshes.size());
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
    SolverSession session(withLooks(50), Options{}, [&] { ++wakes; });
    const auto drive = [&](std::uint64_t seed) {
        base::RandomStream random(seed);
        image::StillOptions small;
        small.width = small.height = 4;
        std::shared_ptr<StillJob> still;
        std::uint64_t newest = 0;
        for (int i = 0; i < 5000; ++i) {
            const double choice = random.next();
            if (i % 32 == 0) {
                std::this_thread::sleep_for(50us);
            }
            if (choice < 0.3) {
                Options options;
                options.error = random.next();
                options.seed = random.next() < 0.05 ? 2 : 1;
                options.lighting.lights.assign(static_cast<std::size_t>(4.0 * random.next()),
                                               base::Rgb(static_cast<float>(random.next())));
                session.setOptions(options);
            } else if (choice < 0.4) {
                session.setPaused(random.next() < 0.5);
            } else if (choice < 0.5) {
                session.step();
            } else if (choice < 0.6) {
                session.ask(rayFrom(static_cast<float>(i)));
            } else if (choice < 0.7) {
                session.setDetail({.elements = random.next() < 0.5, .clusters = random.next() < 0.5});
            } else if (choice < 0.74) {
                still = std::make_shared<StillJob>(scene::Camera{}, small);
                session.take(still);
            } else if (still && choice < 0.76) {
                ASSERT_LE(still->takeParts().size(), 1u);
                ASSERT_NE(still->status().phase, StillPhase::failed);
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
