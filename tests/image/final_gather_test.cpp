#include "core/image/final_gather.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/support/still_errors.h"

namespace fluxwalk {
namespace {

std::unique_ptr<solve::Solver> solveFor(const std::shared_ptr<const scene::Scene>& scene, double error,
                                        unsigned threads = 2) {
    solve::Options options;
    options.error = error;
    options.errorOf = solve::ErrorOf::gathered;
    auto solver = std::make_unique<solve::Solver>(scene, options, threads);
    solver->solve({});
    return solver;
}

image::StillOptions sized(std::uint32_t width, std::uint32_t height, unsigned samples) {
    image::StillOptions options;
    options.width = width;
    options.height = height;
    options.samples = samples;
    return options;
}

TEST(FinalGather, AgreesWithThePathTracer) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    const auto solver = solveFor(scene, 0.02);
    const image::StillOptions options = sized(160, 160, 1);
    const image::Still still = image::takeStill(solver->problem(), scene->cameras.front(), options);
    const test::StillPoints points =
        test::findStillPoints(solver->problem(), scene->cameras.front(), options, 8);
    ASSERT_GT(points.sensors.size(), 200u);
    const test::StillErrors errors = test::compareStill(solver->problem(), still, points, 32768);
    EXPECT_LE(errors.standardError, 0.015);
    EXPECT_LE(errors.error, 0.02);
    EXPECT_LE(std::abs(errors.bias), 0.005);
    EXPECT_EQ(still.rowsDone, 160u);
}

/// Mean and RMS deviation from 1 of what a still shows of the light, relative to the truth.
struct Flatness {
    double mean = 0.0;
    double deviation = 0.0;
};

// A closed room where the light is E = M / (1 - rho) everywhere.
Flatness measureFurnace(const solve::Problem& problem, const scene::Scene& scene) {
    const image::StillOptions options = sized(64, 48, 1);
    const image::Still still = image::takeStill(problem, scene.cameras.front(), options);
    const scene::Material& material = scene.materials[scene.objects.front().material];
    Flatness result;
    const auto n = static_cast<double>(still.irradiance.size());
    for (std::size_t i = 0; i < still.irradiance.size(); ++i) {
        const int c = static_cast<int>(i % 3);
        const float truth = material.emission[c] / (1.0f - material.reflectance[c]);
        const double off = static_cast<double>(still.irradiance[i] / truth) - 1.0;
        result.mean += off / n;
        result.deviation += off * off / n;
    }
    result.deviation = std::sqrt(result.deviation);
    return result;
}

TEST(FinalGather, TheFurnaceIsFlat) {
    for (const char* name : {"furnace", "furnace-planar"}) {
        const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene(name));
        const auto solver = solveFor(scene, 0.01);
        const Flatness flat = measureFurnace(solver->problem(), *scene);
        EXPECT_LE(std::abs(flat.mean), 0.001) << name;
        EXPECT_LE(flat.deviation, 0.002) << name;
    }
}

TEST(FinalGather, ThreadsDoNotMatter) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    const auto one = solveFor(scene, 0.05, 1);
    const auto three = solveFor(scene, 0.05, 3);
    const image::StillOptions options = sized(100, 70, 4);
    const image::Still a = image::takeStill(one->problem(), scene->cameras.front(), options);
    const image::Still b = image::takeStill(three->problem(), scene->cameras.front(), options);
    EXPECT_EQ(a.luminance, b.luminance);
    EXPECT_EQ(a.irradiance, b.irradiance);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.object, b.object);
    EXPECT_EQ(a.rays, b.rays);
}

TEST(FinalGather, HandsOutEveryTileOnceWithItsFinalPixels) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    const auto solver = solveFor(scene, 0.1, 3);
    const image::StillOptions options = sized(100, 70, 2);
    std::mutex mutex;
    std::vector<float> handedOut(3 * 100 * 70, -1.0f);
    image::StillCallbacks callbacks;
    callbacks.tileDone = [&](const image::Still& still, const image::StillTile& tile) {
        const std::lock_guard lock(mutex);
        EXPECT_EQ(tile.left % image::kTile, 0u);
        EXPECT_EQ(tile.top % image::kTile, 0u);
        for (std::uint32_t y = tile.top; y < tile.top + tile.height; ++y) {
            for (std::size_t i = 3 * (100 * y + tile.left); i < 3 * (100 * y + tile.left + tile.width); ++i) {
                EXPECT_EQ(handedOut[i], -1.0f);
                handedOut[i] = still.luminance[i];
            }
        }
    };
    const image::Still still =
        image::takeStill(solver->problem(), scene->cameras.front(), options, callbacks);
    EXPECT_EQ(handedOut, still.luminance);
    EXPECT_EQ(still.luminance,
              image::takeStill(solver->problem(), scene->cameras.front(), options).luminance);
}

TEST(FinalGather, StopsWithWhatIsDone) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    const auto solver = solveFor(scene, 0.1, 1);
    unsigned asked = 0;
    image::StillCallbacks callbacks;
    callbacks.shouldStop = [&asked] { return ++asked > 13; };
    std::vector<double> fractions;
    callbacks.progress = [&fractions](double fraction) { fractions.push_back(fraction); };
    const image::Still still =
        image::takeStill(solver->problem(), scene->cameras.front(), sized(64, 128, 1), callbacks);
    EXPECT_GT(still.rowsDone, 0u);
    EXPECT_LT(still.rowsDone, 128u);
    ASSERT_FALSE(fractions.empty());
    EXPECT_LT(fractions.back(), 1.0);
    const std::size_t last = 3 * std::size_t{still.rowsDone} * 64;
    EXPECT_GT(*std::max_element(still.luminance.begin(), still.luminance.begin() + static_cast<long>(last)),
              0.0f);
    EXPECT_EQ(*std::max_element(still.luminance.begin() + static_cast<long>(last), still.luminance.end()),
              0.0f);
}

// Edges are mixed of what lies on both sides; the middle of a surface is as without.
TEST(FinalGather, EdgesAreSmoothed) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    const auto solver = solveFor(scene, 0.1);
    const image::Still rough = image::takeStill(solver->problem(), scene->cameras.front(), sized(80, 80, 1));
    const image::Still fine = image::takeStill(solver->problem(), scene->cameras.front(), sized(80, 80, 8));
    EXPECT_EQ(rough.object, fine.object);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < rough.luminance.size(); i += 3) {
        changed += rough.albedo[i] != fine.albedo[i] ? 1u : 0u;
    }
    EXPECT_GT(changed, 100u);
    EXPECT_LT(changed, 80u * 80u / 4u);
}

}  // namespace
}  // namespace fluxwalk
