#include "core/image/part_light.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/image/sight.h"
#include "core/reference/path_tracer.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"

namespace fluxwalk {
namespace {

using base::Vec3d;

struct Gathered {
    double light = 0.0;
    double truth = 0.0;
};

// Light of the channels at points of a picture's column `x` in [0, 1), between two heights above the floor.
std::vector<Gathered> gatherUpFrom(const solve::Problem& problem, const Vec3d& foot, const Vec3d& outwards,
                                   image::NearLight nearLight) {
    image::SourcePoints cache(problem.hierarchy);
    image::SourceFinder finder(problem, cache, nearLight);
    image::PixelGather gather(problem, {512, 512, 512});
    std::vector<Gathered> result;
    std::vector<scene::Sensor> sensors;
    const Vec3d along = glm::normalize(glm::cross(outwards, Vec3d(0, 1, 0)));
    for (int i = 0; i < 12; ++i) {
        const Vec3d eye = foot + 0.1 * outwards + (0.01 * (i / 3) - 0.015) * along +
                          std::array{0.004, 0.008, 0.016}[static_cast<std::size_t>(i % 3)] * Vec3d(0, 1, 0);
        const auto seen = image::lookAlong(problem, eye, -outwards);
        if (!seen) {
            continue;
        }
        image::PixelLight light;
        gather.gather(finder.find(seen->leaf), {&seen->point, 1}, {&light, 1});
        result.push_back({static_cast<double>(base::channelMean(light.sum())), 0.0});
        sensors.push_back({seen->point.position, seen->point.shading});
    }
    const reference::PathResult traced =
        reference::traceIrradiance(*problem.scene, problem.rays, problem.executor, sensors, {5, 65536});
    for (std::size_t i = 0; i < result.size(); ++i) {
        const Vec3d& mean = traced.irradiance[i].mean;
        result[i].truth = (mean.x + mean.y + mean.z) / 3.0;
    }
    return result;
}

double relativeRms(const std::vector<Gathered>& points) {
    double squares = 0.0;
    double mean = 0.0;
    for (const Gathered& p : points) {
        squares += (p.light - p.truth) * (p.light - p.truth);
        mean += p.truth;
    }
    const auto n = static_cast<double>(points.size());
    return std::sqrt(squares / n) / (mean / n);
}

// The foot of Cornell's tall block, a few millimetres above the floor: half of what it sees is a hand's
// breadth of floor, cut by the block and darker towards it.
TEST(PartLight, AFootIsLitByTheFloorBesideIt) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    solve::Options options;
    options.error = 0.03;
    options.errorOf = solve::ErrorOf::gathered;
    solve::Solver solver(scene, options, 2);
    solver.solve({});
    const Vec3d outwards = glm::normalize(Vec3d(-0.30, 0.0, -0.96));
    const Vec3d foot(0.344, 0.0, 0.2715);
    const auto gathered = gatherUpFrom(solver.problem(), foot, outwards, image::NearLight::gathered);
    ASSERT_EQ(gathered.size(), 12u);
    const double error = relativeRms(gathered);
    EXPECT_LE(error, 0.025);
    const double before =
        relativeRms(gatherUpFrom(solver.problem(), foot, outwards, image::NearLight::solved));
    EXPECT_LE(error, 0.7 * before);
}

// What a leaf's parts send, against paths.
TEST(PartLight, AgreesWithThePathTracer) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    solve::Options options;
    options.error = 0.05;
    solve::Solver solver(scene, options, 2);
    solver.solve({});
    const solve::Problem& problem = solver.problem();
    const hierarchy::Hierarchy& h = problem.hierarchy;
    image::SourcePoints cache(h);
    image::PartLight partLight(problem, cache);
    std::vector<base::NodeId> leaves;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const base::NodeId id{i};
        if (h.kind(id) == hierarchy::NodeKind::element && h.isLeaf(id) &&
            h.shape(id).exposedCells == 0xffff && base::channelMean(h.light(id).emission) == 0.0f &&
            i % 97 == 0) {
            leaves.push_back(id);
        }
    }
    ASSERT_GT(leaves.size(), 6u);
    double squares = 0.0;
    double sum = 0.0;
    double noise = 0.0;
    for (const base::NodeId id : leaves) {
        const image::CellLight& light = partLight.of(id);
        std::vector<scene::Sensor> sensors;
        for (unsigned cell = 0; cell < image::kCells; ++cell) {
            const surface::Path path =
                surface::childPath(surface::childPath(surface::kRootPath, cell / 4), cell % 4);
            const transport::ElementPoints part =
                transport::makeRegionPoints(h, id, transport::partRegion(h.region(id), path));
            sensors.push_back({part.center, Vec3d(h.shape(id).axis)});
        }
        const reference::PathResult traced =
            reference::traceIrradiance(*scene, problem.rays, problem.executor, sensors, {5, 16384});
        for (std::size_t cell = 0; cell < image::kCells; ++cell) {
            for (int c = 0; c < 3; ++c) {
                const auto reflectance = static_cast<double>(h.light(id).reflectance[c]);
                const double truth = reflectance * traced.irradiance[cell].mean[c];
                squares += std::pow(static_cast<double>(light[cell][c]) - truth, 2.0);
                noise += std::pow(reflectance * traced.irradiance[cell].standardError[c], 2.0);
                sum += truth;
            }
        }
    }
    const double n = 3.0 * image::kCells * static_cast<double>(leaves.size());
    EXPECT_LE(std::sqrt(std::max(0.0, squares - noise) / n) / (sum / n), 0.04);
}

}  // namespace
}  // namespace fluxwalk
