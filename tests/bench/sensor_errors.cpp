#include "tests/bench/sensor_errors.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/image/sensors.h"
#include "core/solve/point_gather.h"
#include "tests/bench/mesh_lookup.h"

namespace fluxwalk::bench {

namespace {

/// As parts of the scene's extent: how far a sensor may lie off its surface, and a triangle of the display
/// off the exact object.
constexpr double kSensorReach = 1e-4;
constexpr double kMeshReach = 5e-3;
constexpr double kDark = 0.1;  ///< of the mean: local relative errors are not taken below

}  // namespace

NoiseFigures noiseOf(const std::vector<ReferencePoint>& reference) {
    const double mean = meanIrradiance(reference);
    NoiseFigures figures;
    figures.rms = std::sqrt(noiseSquare(reference)) / mean;
    figures.bias = figures.rms / std::sqrt(static_cast<double>(reference.size()));
    std::vector<double> deviations;  // of the local relative errors, which are normal
    for (const ReferencePoint& point : reference) {
        for (int c = 0; c < 3; ++c) {
            if (point.irradiance[c] > kDark * mean) {
                deviations.push_back(std::max(point.standardError[c] / point.irradiance[c], 1e-9));
            }
        }
    }
    // 95 % of the mixture lie below the size where the mean of the distributions is that.
    double low = 0.0;
    double high = 1.0;
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (low + high);
        double sum = 0.0;
        for (const double deviation : deviations) {
            sum += std::erf(middle / (deviation * std::sqrt(2.0)));
        }
        (sum < 0.95 * static_cast<double>(deviations.size()) ? low : high) = middle;
    }
    figures.p95 = deviations.empty() ? 0.0 : high;
    return figures;
}

ErrorFigures compare(const std::vector<Rgb>& values, const std::vector<ReferencePoint>& reference) {
    FLUXWALK_CHECK_EQ(values.size(), reference.size());
    const double mean = meanIrradiance(reference);
    double squares = 0.0;
    double sum = 0.0;
    std::vector<double> local;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Vec3d difference = Vec3d(values[i]) - reference[i].irradiance;
        squares += glm::dot(difference, difference);
        for (int c = 0; c < 3; ++c) {
            const double truth = reference[i].irradiance[c];
            sum += difference[c];
            if (truth > kDark * mean) {
                local.push_back(std::abs(difference[c]) / truth);
            }
        }
    }
    const double n = 3.0 * static_cast<double>(values.size());
    ErrorFigures figures;
    figures.rms = std::sqrt(std::max(0.0, squares / n - noiseSquare(reference))) / mean;
    figures.bias = sum / n / mean;
    if (!local.empty()) {
        const auto at = local.begin() + static_cast<std::ptrdiff_t>(local.size() * 95 / 100);
        std::nth_element(local.begin(), at, local.end());
        figures.p95 = *at;
    }
    return figures;
}

std::vector<Site> findSites(const scene::Scene& scene, const rays::RayScene& rays,
                            const std::vector<ReferencePoint>& reference) {
    const double reach = kSensorReach * scene.bounds().diagonal();
    std::vector<Site> sites;
    for (const ReferencePoint& point : reference) {
        const scene::Sensor& s = point.sensor;
        const rays::Ray back{base::Vec3(s.position + reach * s.normal), 0.0f, base::Vec3(-s.normal),
                             static_cast<float>(2.0 * reach)};
        const auto hit = rays.closest(back);
        if (!hit) {
            throw base::FileError("reference", "sensor " + std::to_string(sites.size() + 1),
                                  "lies on no surface of the scene");
        }
        const std::uint32_t object = base::index(hit->object);
        const surface::Surface& surface = *scene.objects[object].surface;
        sites.push_back({object, hit->patch, hit->back, surface.locate(hit->patch, s.position)});
    }
    return sites;
}

SensorErrors::SensorErrors(const solve::Problem& problem, const std::vector<ReferencePoint>& reference)
    : reference_(reference),
      sites_(findSites(*problem.scene, problem.rays, reference)),
      tolerance_(kMeshReach * problem.scene->bounds().diagonal()) {}

ErrorFigures SensorErrors::ofLeaves(const solve::Problem& problem) const {
    std::vector<Rgb> values;
    for (const Site& site : sites_) {
        const auto leaf = solve::findLeaf(problem, site.object, site.patch, site.back, site.uv);
        values.push_back(leaf ? problem.hierarchy.light(*leaf).irradiance : Rgb(0.0f));
    }
    return compare(values, reference_);
}

ErrorFigures SensorErrors::ofMeshes(const scene::LitMeshes& meshes, const base::Executor& executor) const {
    std::vector<Rgb> values(sites_.size(), Rgb(0.0f));
    for (const auto& mesh : meshes) {
        const MeshLookup lookup(*mesh, tolerance_, executor);
        executor.forRange(sites_.size(), 32, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (sites_[i].object == mesh->object && sites_[i].back == mesh->back) {
                    const scene::Sensor& s = reference_[i].sensor;
                    values[i] = lookup.irradiance(s.position, s.normal).value_or(Rgb(0.0f));
                }
            }
        });
    }
    return compare(values, reference_);
}

ErrorFigures SensorErrors::ofGathered(const solve::Solver& solver) const {
    std::vector<scene::Sensor> sensors;
    for (const ReferencePoint& point : reference_) {
        sensors.push_back(point.sensor);
    }
    return compare(image::measure(solver, sensors), reference_);
}

}  // namespace fluxwalk::bench
