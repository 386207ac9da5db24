#include "core/image/display_gather.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "core/display/interpolate.h"
#include "core/reference/path_tracer.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/solve/probes.h"
#include "core/solve/solver.h"
#include "core/surface/disk.h"
#include "tests/analytic/closed_forms.h"

namespace fluxwalk::image {
namespace {

using Clock = DisplayGather::Clock;
constexpr double kAngle = 0.0698;

void gatherAll(DisplayGather& gather, const std::optional<Look>& look = std::nullopt) {
    while (!gather.isDone()) {
        gather.work(look, Clock::now() + std::chrono::milliseconds(50));
    }
}

double relativeRms(const std::vector<Rgb>& shown, const reference::PathResult& traced) {
    double squares = 0.0;
    double noise = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            squares += std::pow(static_cast<double>(shown[i][c]) - traced.irradiance[i].mean[c], 2.0);
            noise += std::pow(traced.irradiance[i].standardError[c], 2.0);
            sum += traced.irradiance[i].mean[c];
        }
    }
    const double n = 3.0 * static_cast<double>(shown.size());
    return std::sqrt(std::max(0.0, squares - noise) / n) / (sum / n);
}

std::unique_ptr<solve::Solver> solveFor(const std::shared_ptr<const scene::Scene>& scene, double error,
                                        unsigned threads = 2) {
    solve::Options options;
    options.error = error;
    auto solver = std::make_unique<solve::Solver>(scene, options, threads);
    solver->solve({});
    return solver;
}

constexpr double kLampRadius = 0.05;
constexpr double kLampHeight = 2.0;
constexpr double kDiscRadius = 0.3;
constexpr double kDiscHeight = 0.5;
constexpr float kExitance = 1000.0f;
constexpr double kFloorHalf = 1.5;

/// A black disc between a small round lamp and a black floor.
std::shared_ptr<const scene::Scene> makeShadow() {
    auto scene = std::make_shared<scene::Scene>();
    const std::uint32_t black = scene::addMaterial(*scene, "black", Rgb(0.0f));
    const std::uint32_t lamp = scene::addMaterial(*scene, "lamp", Rgb(0.0f), Rgb(kExitance));
    const double s = kFloorHalf;
    scene::addPolygons(*scene, "floor", black, {{{{-s, 0, -s}, {-s, 0, s}, {s, 0, s}, {s, 0, -s}}}});
    const auto at = [](double height) { return glm::translate(base::Mat4d(1.0), Vec3d(0.0, height, 0.0)); };
    scene->objects.push_back({"disc", std::make_shared<surface::Disk>(at(kDiscHeight), kDiscRadius), black});
    scene->objects.push_back(
        {"lamp", std::make_shared<surface::Disk>(at(kLampHeight), kLampRadius, 0.0, true), lamp});
    return scene;
}

/// What is shown on the floor of the shadow's scene, along a line that no cell follows.
class FloorLine {
  public:
    FloorLine(const scene::Scene& scene, const display::DisplayMeshes& meshes)
        : surface_(*scene.objects[0].surface), lookup_(surface_, meshes) {}

    double at(double radius) const {
        const Vec3d p(radius * std::cos(0.37), 0.0, radius * std::sin(0.37));
        return static_cast<double>(lookup_.irradiance(0, false, surface_.locate(0, p))->r);
    }

    /// Metres from a tenth to nine tenths of what the lamp brings.
    double shadowWidth() const {
        double dark = 0.0;
        double bright = 0.0;
        for (double r = 0.1; r < 1.0; r += 0.0005) {
            const double part = at(r) / lampAt(r);
            dark = part < 0.1 ? r : dark;
            bright = bright <= 0.0 && part > 0.9 ? r : bright;
        }
        return bright - dark;
    }

    static double lampAt(double radius) {
        return static_cast<double>(kExitance) *
               fluxwalk::closed_forms::pointParallelDisc(kLampRadius, kLampHeight, radius);
    }

  private:
    const surface::Surface& surface_;
    display::DisplayLookup lookup_;
};

TEST(DisplayGather, ShadowOfADiscIsAsSharpAsItIs) {
    const auto scene = makeShadow();
    const auto solver = solveFor(scene, 0.1);
    DisplayGather gather(solver->problem());
    gather.meshes(kAngle);
    const FloorLine before(*scene, gather.meshesOf(0));
    const double interpolated = before.shadowWidth();
    double interpolatedError = 0.0;
    // Half shadow lies between these two circles.
    const double spread = kDiscHeight / (kLampHeight - kDiscHeight);
    const double umbra = kDiscRadius + (kDiscRadius - kLampRadius) * spread;
    const double lit = kDiscRadius + (kDiscRadius + kLampRadius) * spread;
    const auto errorOf = [&](const FloorLine& line) {
        double worst = 0.0;
        for (double r = 0.05; r < 1.2; r += 0.0137) {
            if (r < umbra - 0.03 || r > lit + 0.03) {
                const double truth = r < umbra ? 0.0 : FloorLine::lampAt(r);
                worst = std::max(worst, std::abs(line.at(r) - truth) / FloorLine::lampAt(r));
            }
        }
        return worst;
    };
    interpolatedError = errorOf(before);
    gatherAll(gather);
    gather.meshes(kAngle);
    const FloorLine after(*scene, gather.meshesOf(0));
    // From 10 to 90 % a uniform disc takes .69 of the half shadow.
    const double truth = 0.69 * (lit - umbra);
    EXPECT_GT(interpolated, 2.0 * truth);
    EXPECT_GT(after.shadowWidth(), 0.7 * truth);
    EXPECT_LT(after.shadowWidth(), 1.5 * truth);
    EXPECT_LT(errorOf(after), 0.01);
    EXPECT_GT(interpolatedError, 2.0 * errorOf(after));
}

// Measured: 3.6 % and 1.3 % on the Cornell box, 20 % and 4.6 % in the gallery.
TEST(DisplayGather, IsNearerToThePathTracer) {
    for (const char* name : {"cornell-box", "gallery"}) {
        const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene(name));
        const auto solver = solveFor(scene, name[0] == 'c' ? 0.1 : 0.3);
        const std::vector<solve::Probe> probes = solve::drawProbes(solver->problem(), 300, 5);
        std::vector<scene::Sensor> sensors;
        for (const solve::Probe& p : probes) {
            sensors.push_back({p.position, p.normal});
        }
        const reference::PathResult traced = reference::traceIrradiance(
            *scene, solver->problem().rays, solver->problem().executor, sensors, {3, 2048});
        DisplayGather gather(solver->problem());
        const auto error = [&] {
            gather.meshes(kAngle);
            std::vector<Rgb> shown;
            for (const solve::Probe& p : probes) {
                const display::DisplayLookup lookup(*scene->objects[p.object].surface,
                                                    gather.meshesOf(p.object));
                shown.push_back(lookup.irradiance(p.patch, p.back, p.uv).value_or(Rgb(0.0f)));
            }
            return relativeRms(shown, traced);
        };
        const double interpolated = error();
        gatherAll(gather);
        const double gathered = error();
        EXPECT_LT(gathered, 0.5 * interpolated) << name;
    }
}

TEST(DisplayGather, DoesNotDependOnThreadsAndCameras) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    std::vector<scene::LitMeshes> all;
    for (const unsigned threads : {1u, 3u}) {
        const auto solver = solveFor(scene, 0.3, threads);
        DisplayGather gather(solver->problem());
        if (threads > 1) {
            // From two places, with looks at what there is by then.
            scene::Camera camera = scene->cameras.front();
            for (int i = 0; i < 4 && !gather.isDone(); ++i) {
                camera.position += Vec3d(0.02, 0.0, 0.0);
                gather.work(Look{camera, 1.0}, Clock::now() + std::chrono::milliseconds(5));
                gather.meshes(kAngle);
            }
        }
        gatherAll(gather);
        all.push_back(gather.meshes(kAngle));
    }
    ASSERT_EQ(all[0].size(), all[1].size());
    for (std::size_t m = 0; m < all[0].size(); ++m) {
        EXPECT_EQ(all[0][m]->positions, all[1][m]->positions);
        EXPECT_EQ(all[0][m]->triangles, all[1][m]->triangles);
        EXPECT_EQ(all[0][m]->irradiance, all[1][m]->irradiance);
    }
}

TEST(DisplayGather, WhatIsSeenComesFirst) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    const auto solver = solveFor(scene, 0.3);
    DisplayGather gather(solver->problem());
    EXPECT_EQ(gather.doneCount(), 0u);
    const Look look{scene->cameras.front(), 1.0};
    gather.work(look, Clock::now());
    EXPECT_EQ(gather.doneCount(), 0u);
    // The backs of the boxes and the outer faces are not seen.
    EXPECT_GT(gather.seenPending(), gather.leafCount() / 8);
    EXPECT_LT(gather.seenPending(), gather.leafCount());
    EXPECT_EQ(gather.seenPending(), gather.seenCount());
    const std::size_t seen = gather.seenPending();
    while (gather.seenPending() > 0) {
        gather.workOnSeen(look, Clock::now() + std::chrono::milliseconds(2));
    }
    const std::size_t done = gather.doneCount();
    EXPECT_EQ(done, seen);
    gather.work(look, Clock::now() + std::chrono::milliseconds(20));
    EXPECT_GE(gather.doneCount(), done);
    EXPECT_EQ(gather.seenPending(), 0u);
}

TEST(DisplayGather, DigestTellsOneSolutionFromAnother) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    const auto rough = solveFor(scene, 0.4);
    const auto same = solveFor(scene, 0.4, 1);
    const auto fine = solveFor(scene, 0.1);
    EXPECT_EQ(digestLight(rough->problem()), digestLight(same->problem()));
    EXPECT_NE(digestLight(rough->problem()), digestLight(fine->problem()));
    const std::uint64_t before = digestLight(rough->problem());
    solve::Options options = rough->options();
    scene::setFactor(options.lighting, scene::listLightSources(*scene).front(), Rgb(0.5f));
    rough->setOptions(options);
    rough->solve({});
    EXPECT_NE(digestLight(rough->problem()), before);
}

}  // namespace
}  // namespace fluxwalk::image
