#include "viewer/session/still_job.h"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/scene/builders.h"
#include "core/scene/lighting.h"
#include "core/solve/state.h"
#include "viewer/session/solver_session.h"

namespace fluxwalk::session {
namespace {

using namespace std::chrono_literals;
using image::Still;
using image::StillCallbacks;
using image::StillOptions;
using solve::Options;

template <class Condition>
void waitFor(const Condition& condition) {
    while (!condition()) {
        std::this_thread::sleep_for(200us);
    }
}

StillOptions sized(std::uint32_t width, std::uint32_t height) {
    StillOptions options;
    options.width = width;
    options.height = height;
    options.samples = 2;
    options.rays.weak = 8;
    return options;
}

Still emptyStill(const StillOptions& options) {
    const std::size_t pixels = std::size_t{options.width} * options.height;
    Still still;
    still.width = options.width;
    still.height = options.height;
    still.luminance.resize(3 * pixels);
    still.irradiance.resize(3 * pixels);
    still.albedo.resize(3 * pixels);
    still.normal.resize(3 * pixels);
    still.object.resize(pixels);
    return still;
}

/// A still whose pixels are their numbers, made by two threads, row of tiles by row of tiles.
Still countPixels(const scene::Camera& /*camera*/, const StillOptions& options,
                  const StillCallbacks& callbacks) {
    Still still = emptyStill(options);
    std::atomic<bool> isStopped = false;
    const auto fill = [&](std::uint32_t top, std::uint32_t first) {
        for (std::uint32_t left = first * image::kTile; left < still.width; left += 2 * image::kTile) {
            if (callbacks.shouldStop()) {
                isStopped = true;
                return;
            }
            const image::StillTile tile{left, top, std::min(image::kTile, still.width - left),
                                        std::min(image::kTile, still.height - top)};
            for (std::uint32_t y = top; y < top + tile.height; ++y) {
                for (std::uint32_t x = left; x < left + tile.width; ++x) {
                    const std::size_t pixel = std::size_t{y} * still.width + x;
                    for (std::size_t c = 0; c < 3; ++c) {
                        still.luminance[3 * pixel + c] = static_cast<float>(pixel);
                    }
                }
            }
            callbacks.tileDone(still, tile);
        }
    };
    for (std::uint32_t top = 0; top < still.height; top += image::kTile) {
        std::thread other([&] { fill(top, 1); });
        fill(top, 0);
        other.join();
        if (isStopped) {
            break;
        }
        still.rowsDone = std::min(still.height, top + image::kTile);
        callbacks.progress(static_cast<double>(still.rowsDone) / still.height);
    }
    return still;
}

/// The picture that parts make, and how many of its pixels they cover.
struct Collected {
    std::vector<float> luminance;
    std::size_t pixels = 0;

    Collected(std::uint32_t width, std::uint32_t height)
        : luminance(std::size_t{3} * width * height), width_(width) {}
    void add(const std::vector<StillPart>& parts) {
        for (const StillPart& part : parts) {
            ASSERT_EQ(part.luminance.size(), std::size_t{3} * part.place.width * part.place.height);
            pixels += std::size_t{part.place.width} * part.place.height;
            for (std::uint32_t y = 0; y < part.place.height; ++y) {
                const std::size_t to = 3 * (std::size_t{part.place.top + y} * width_ + part.place.left);
                std::copy_n(&part.luminance[std::size_t{3} * y * part.place.width], 3 * part.place.width,
                            &luminance[to]);
            }
        }
    }

  private:
    std::uint32_t width_;
};

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
