#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/reference/path_tracer.h"
#include "core/scene/polygons.h"
#include "core/solve/probes.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

// Narrow gaps between surfaces (hierarchy/exposure.h) against the path tracer.

namespace fluxwalk {
namespace {

using base::Rgb;
using base::Vec3d;
using scene::boxFaces;

/// A closed room of 4 m x 3 m x 4 m; a chest of 2 m x 2 m stands on blocks of 2 cm in its middle.
scene::Scene roomWithChest() {
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", Rgb(0.6f));
    const std::uint32_t lamp = scene::addMaterial(scene, "lamp", Rgb(0.0f), Rgb(1000.0f));
    scene::addPolygons(scene, "room", grey, boxFaces({0, 0, 0}, {4, 3, 4}, scene::kAllFaces, true));
    scene::addPolygons(scene, "lamp", lamp, boxFaces({.5, 2.9, .5}, {1.5, 2.9, 1.5}, scene::kBottom));
    scene::addPolygons(scene, "chest", grey, boxFaces({1, .02, 1}, {3, .8, 3}));
    return scene;
}

std::vector<scene::Sensor> onFloor(double from, double to, int count) {
    std::vector<scene::Sensor> sensors;
    for (int i = 0; i < count; ++i) {
        const double along = 4.0 * (i + .5) / count;
        sensors.push_back({{from + (to - from) * (i + .5) / count, 0.0, 1.0 + .5 * along}, {0, 1, 0}});
    }
    return sensors;
}

double meanOf(const std::vector<Rgb>& values) {
    double sum = 0.0;
    for (const Rgb& e : values) {
        sum += static_cast<double>(base::channelMean(e));
    }
    return sum / static_cast<double>(values.size());
}

TEST(Gap, isDarkAndTakesNoLightFromTheRoom) {
    // Deep in the gap, and on the open floor.
    const std::vector<scene::Sensor> inside = onFloor(1.4, 2.6, 12);
    const std::vector<scene::Sensor> outside = onFloor(.1, .9, 12);
    for (const double error : {.3, .05}) {
        solve::Options options;
        options.error = error;
        options.errorOf = solve::ErrorOf::gathered;
        solve::Solver solver(std::make_shared<const scene::Scene>(roomWithChest()), options, 2);
        solver.solve({});
        const test::Problem& problem = solver.problem();
        const auto leafValues = [&](const std::vector<scene::Sensor>& sensors) {
            std::vector<Rgb> values;
            for (const scene::Sensor& s : sensors) {
                values.emplace_back(0.0f);  // no leaf is exposed there
                for (const base::NodeId id : test::leavesOf(problem.hierarchy)) {
                    const hierarchy::Shape& shape = problem.hierarchy.shape(id);
                    const auto& c = shape.corners;
                    const base::Vec3 p(s.position);
                    if (shape.axis.y > .99f && std::abs(c[0].y) < 1e-6f &&
                        glm::all(glm::lessThanEqual(glm::min(c[0], c[2]), p)) &&
                        glm::all(glm::greaterThanEqual(glm::max(c[0], c[2]), p))) {
                        // What the leaf's whole area gets: hidden parts get nothing.
                        values.back() = problem.hierarchy.light(id).irradiance * shape.exposed;
                        break;
                    }
                }
            }
            return values;
        };
        const double bright = meanOf(leafValues(outside));
        EXPECT_LT(meanOf(leafValues(inside)), .02 * bright) << error;
        EXPECT_LT(problem.statistics.audit.relativeDefect(), .01) << error;
        const auto traced = reference::traceIrradiance(*problem.scene, problem.rays, problem.executor,
                                                       outside, {.paths = 16384});
        double truth = 0.0;
        for (const auto& estimate : traced.irradiance) {
            truth += (estimate.mean.x + estimate.mean.y + estimate.mean.z) / 3.0 / 12.0;
        }
        EXPECT_NEAR(bright / truth, 1.0, error) << bright << " " << truth;
    }
}

TEST(Probes, lampsDoNotHideTheRest) {
    std::vector<Rgb> reference(100, Rgb(10.0f));
    std::vector<Rgb> values(100, Rgb(11.0f));
    EXPECT_NEAR(solve::relativeRms(values, reference), .1, 1e-6);
    EXPECT_NEAR(solve::relativeRmsOffLamps(values, reference), .1, 1e-6);
    for (const std::size_t i : {3u, 70u}) {
        reference[i] = values[i] = Rgb(1e5f);
    }
    EXPECT_LT(solve::relativeRms(values, reference), .001);
    EXPECT_NEAR(solve::relativeRmsOffLamps(values, reference), .1, 1e-6);
    // Darkness is no reason to leave out what is lit.
    std::fill(reference.begin(), reference.begin() + 60, Rgb(0.0f));
    std::fill(values.begin(), values.begin() + 60, Rgb(0.0f));
    EXPECT_NEAR(solve::relativeRmsOffLamps(values, reference), std::sqrt(39.0 / 99.0) / (390.0 / 99.0), 1e-6);
    EXPECT_EQ(solve::relativeRmsOffLamps({}, {}), 0.0);
}

}  // namespace
}  // namespace fluxwalk
