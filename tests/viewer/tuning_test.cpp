#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/scene/builders.h"
#include "core/solve/options_table.h"
#include "core/solve/turn.h"
#include "viewer/session/solver_session.h"
#include "viewer/ui/light_control.h"

// A real solver behind the session while everything is turned that the panel offers.

namespace fluxwalk::session {
namespace {

using namespace std::chrono_literals;
using base::Rgb;
using solve::Options;

struct Bench {
    std::shared_ptr<const scene::Scene> scene =
        std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    std::shared_ptr<std::atomic<int>> made = std::make_shared<std::atomic<int>>(0);

    Solving solving() const {
        SolverSource source;
        source.make = [scene = scene, made = made](const Options& options) {
            ++*made;
            return std::make_unique<solve::Solver>(scene, options, 1);
        };
        return solveWith(source);
    }
};

Options rough() {
    Options options;
    options.error = 0.3;
    return options;
}

/// Waits for something that must come; a test that waits for ever is killed by ctest.
template <class Condition>
void waitFor(const Condition& condition) {
    while (!condition()) {
        std::this_thread::sleep_for(200us);
    }
}

TEST(Tuning, ALightIsSwitchedOffAndOn) {
    const Bench bench;
    SolverSession session(bench.solving(), rough(), {});
    session.wait();
    const double mean = session.latest()->statistics.meanIrradiance;
    Options options = rough();
    const scene::LightSource lamp = scene::listLightSources(*bench.scene).at(0);
    scene::setFactor(options.lighting, lamp, Rgb(0.0f));
    session.setOptions(options);
    waitFor([&] { return session.latest()->lighting == options.lighting; });
    EXPECT_LT(session.latest()->statistics.meanIrradiance, 0.6 * mean);
    session.wait();
    EXPECT_EQ(session.latest()->statistics.meanIrradiance, 0.0);
    session.setOptions(rough());
    session.wait();
    EXPECT_NEAR(session.latest()->statistics.meanIrradiance, mean, 0.01 * mean);
    EXPECT_EQ(*bench.made, 1);
}

TEST(Tuning, WhatIsFixedMakesANewSolverWhileThePictureStays) {
    const Bench bench;
    SolverSession session(bench.solving(), rough(), {});
    session.wait();
    Options options = rough();
    options.clusters = solve::TreeBuilder::hybrid;
    session.setOptions(options);
    EXPECT_NE(session.latest(), nullptr);
    session.wait();
    EXPECT_EQ(*bench.made, 2);
    EXPECT_TRUE(session.latest()->finished);
    // While it solves, too: the one at work is left.
    options.error = 0.01;
    session.setOptions(options);
    options.seed = 5;
    session.setOptions(options);
    options.error = 0.3;
    session.setOptions(options);
    session.wait();
    EXPECT_EQ(*bench.made, 3);
    EXPECT_TRUE(session.latest()->finished);
}

TEST(Tuning, AnOptionTurnedBackIsNotForgotten) {
    const Bench bench;
    SolverSession session(bench.solving(), rough(), {});
    Options options = rough();
    options.seed = 2;
    session.setOptions(options);
    session.setOptions(rough());
    EXPECT_EQ(session.wait().phase, Phase::finished);
    EXPECT_EQ(session.options().seed, rough().seed);
}

/// Every option of the table and every light, at random, while it solves: what is shown is always of lights
/// that were asked for, and what is asked last is what it ends with.
TEST(Tuning, Stress) {
    const Bench bench;
    SolverSession session(bench.solving(), rough(), {});
    base::RandomStream random(11);
    const std::vector<scene::LightSource> sources = scene::listLightSources(*bench.scene);
    Options options = rough();
    constexpr int kCommands = 600;
    for (int i = 0; i < kCommands; ++i) {
        const double choice = random.next();
        if (choice < 0.3) {
            const auto source = static_cast<std::size_t>(random.next() * static_cast<double>(sources.size()));
            scene::setFactor(
                options.lighting, sources[source],
                random.next() < 0.3 ? Rgb(0.0f) : Rgb(0.5f, 1.0f, 2.0f * static_cast<float>(random.next())));
            session.setOptions(options);
        } else if (choice < 0.7) {
            const auto table = solve::optionsTable();
            const solve::OptionInfo& option =
                table[static_cast<std::size_t>(random.next() * static_cast<double>(table.size()))];
            if (option.name == "memory-limit" || option.name == "time-limit" || option.name == "link-limit") {
                continue;
            }
            // Rough values, so that each solve is short.
            double value = option.defaultValue();
            if (option.name == "error") {
                value = 0.2 + 0.5 * random.next();
            } else if (option.name == "seed") {
                value = random.next() < 0.1 ? 2.0 : 1.0;
            } else if (option.kind == solve::OptionKind::choice || option.kind == solve::OptionKind::flag) {
                const bool isStrict = option.name == "oracle";
                value = std::floor(random.next() * (isStrict ? 3.0 : option.maximum + 1.0));
            } else if (option.name == "threshold") {
                value = random.next() < 0.5 ? 0.0 : 1.0 + 10.0 * random.next();
            } else if (option.name == "min-area") {
                value = random.next() < 0.5 ? 0.0 : 0.1 * random.next();
            } else if (option.name == "display-angle") {
                value = 2.0 + 20.0 * random.next();
            } else if (option.name == "curvature-weight") {
                value = 2.0 * random.next();
            }
            option.set(options, value);
            session.setOptions(options);
        } else if (choice < 0.75) {
            session.setPaused(true);
        } else if (choice < 0.85) {
            session.setPaused(false);
        } else if (choice < 0.9) {
            session.step();
        } else if (const auto snapshot = session.latest()) {
            for (const auto& mesh : snapshot->meshes) {
                for (const Rgb& e : mesh->irradiance) {
                    ASSERT_TRUE(e.r >= 0.0f && e.g >= 0.0f && e.b >= 0.0f);
                }
            }
        }
        if (i % 8 == 0) {
            std::this_thread::sleep_for(1ms);
        }
        ASSERT_NE(session.status().phase, Phase::failed);
    }
    options.threshold = 0.0;
    options.error = 0.3;
    options.minArea = 0.0;
    session.setOptions(options);
    session.setPaused(false);
    const Status status = session.wait();
    EXPECT_EQ(status.phase, Phase::finished);
    EXPECT_TRUE(session.latest()->lighting == options.lighting);
    // The same as one who was asked for nothing else.
    solve::Solver fresh(bench.scene, options, 1);
    fresh.solve({});
    const double mean = fresh.statistics().meanIrradiance;
    EXPECT_NEAR(session.latest()->statistics.meanIrradiance, mean, 0.1 * mean);
}

TEST(LightControl, OutlastsBeingSwitchedOff) {
    ui::LightControl control = ui::controlOf(Rgb(0.5f, 0.25f, 0.0f));
    EXPECT_TRUE(control.isOn);
    EXPECT_EQ(control.level, 0.5);
    EXPECT_EQ(control.color, Rgb(1.0f, 0.5f, 0.0f));
    control.isOn = false;
    EXPECT_EQ(control.factor(), Rgb(0.0f));
    control.isOn = true;
    EXPECT_EQ(control.factor(), Rgb(0.5f, 0.25f, 0.0f));
    EXPECT_FALSE(ui::controlOf(Rgb(0.0f)).isOn);
}

}  // namespace
}  // namespace fluxwalk::session
