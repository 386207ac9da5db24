#include <gtest/gtest.h>

#include "core/scene/polygons.h"
#include "core/solve/point_gather.h"
#include "tests/support/solving.h"

// Check 20 (CIE 171:2006, 5.4): the flux through an unglazed opening is what the black room behind it
// receives.

namespace fluxwalk {
namespace {

using test::Problem;

constexpr double kRoom = 3.0;  // side of both rooms
constexpr double kLow = 1.0;   // the opening: a square from here
constexpr double kHigh = 2.2;  // to here in y and z, in the plane x = kRoom

// Side of the dividing wall (no thickness: its other side is black) around the opening.
scene::Quads wallAround(bool facesMinusX) {
    const std::array<double, 4> at{0.0, kLow, kHigh, kRoom};
    scene::Quads parts;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (i != 1 || j != 1) {
                const double x = facesMinusX ? kRoom : kRoom + 0.05;
                parts.push_back(scene::boxFaces({x, at[j], at[i]}, {x, at[j + 1], at[i + 1]},
                                                facesMinusX ? scene::kLeft : scene::kRight)
                                    .front());
            }
        }
    }
    return parts;
}

scene::Scene litAndBlackRoom(float reflectance) {
    using scene::boxFaces;
    scene::Scene scene;
    const std::uint32_t paint = scene::addMaterial(scene, "paint", base::Rgb(reflectance));
    const std::uint32_t black = scene::addMaterial(scene, "black", base::Rgb(0.0f));
    const std::uint32_t lamp = scene::addMaterial(scene, "lamp", base::Rgb(0.0f), base::Rgb(5000.0f));
    scene::addPolygons(scene, "lit room", paint,
                       scene::join({boxFaces({0, 0, 0}, {kRoom, kRoom, kRoom},
                                             scene::kAllFaces & ~static_cast<unsigned>(scene::kRight), true),
                                    wallAround(true)}));
    scene::addPolygons(scene, "lamp", lamp, boxFaces({.6, 2.6, .9}, {1.4, 2.6, 1.7}, scene::kBottom));
    // The reveal is black and part of the black room.
    const double x = kRoom + 0.05;
    scene::addPolygons(
        scene, "black room", black,
        scene::join({boxFaces({x, 0, 0}, {x + kRoom, kRoom, kRoom},
                              scene::kAllFaces & ~static_cast<unsigned>(scene::kLeft), true),
                     wallAround(false),
                     boxFaces({kRoom, kLow, kLow}, {x, kHigh, kHigh},
                              scene::kTop | scene::kBottom | scene::kNear | scene::kFar, true)}));
    return scene;
}

double receivedBy(const Problem& problem, std::uint32_t object) {
    double flux = 0.0;
    for (std::uint32_t p = 0; p < problem.scene->objects[object].surface->patchCount(); ++p) {
        flux += test::arrivingFlux(problem, object, p, false).y;
    }
    return flux;
}

// Irradiance that comes from the lit room, over points of the opening.
double throughOpening(const Problem& problem) {
    constexpr int kSide = 16;
    const double step = (kHigh - kLow) / kSide;
    double flux = 0.0;
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            const base::Vec3d at(kRoom, kLow + (i + .5) * step, kLow + (j + .5) * step);
            flux +=
                step * step * static_cast<double>(solve::gatherInSpace(problem, at, base::Vec3d(-1, 0, 0)).y);
        }
    }
    return flux;
}

TEST(Opening, theBlackRoomReceivesWhatPassesThrough) {
    for (const float reflectance : {0.0f, .5f, .8f}) {
        const auto problem = test::makeProblem(litAndBlackRoom(reflectance));
        // Light that has arrived by one solution refines the next.
        for (const double threshold : {1.0, .1, .01, 1e-3}) {
            test::refine(*problem, threshold);
            test::converge(*problem);
        }
        problem->statistics.meanIrradiance = 100.0;
        const double received = receivedBy(*problem, 2);
        const double through = throughOpening(*problem);
        EXPECT_NEAR(received / through, 1.0, .005) << reflectance;
    }
}

}  // namespace
}  // namespace fluxwalk
