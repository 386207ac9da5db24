#include "viewer/render/exposure.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"

namespace fluxwalk::render {
namespace {

constexpr double kBrightPart = 0.85;
/// Where the bright surfaces and the middle of all come to lie at most; 1 is white for the linear curve.
constexpr double kBrightLevel = 0.85;
constexpr double kMiddleLevel = 0.5;
constexpr double kWhitePerExposureValue = 1.2;

}  // namespace

void LuminanceHistogram::add(double luminance, double area) {
    if (!(luminance > 0.0) || !(area > 0.0)) {
        return;
    }
    const double step = std::floor((std::log2(luminance) + kStops) * kStepsPerStop);
    if (step < 0.0) {
        return;
    }
    const auto bin = std::min(static_cast<std::size_t>(step), area_.size() - 1);
    area_[bin] += area;
    total_ += area;
}

void LuminanceHistogram::add(const LuminanceHistogram& other) {
    for (std::size_t i = 0; i < area_.size(); ++i) {
        area_[i] += other.area_[i];
    }
    total_ += other.total_;
}

double LuminanceHistogram::percentile(double p) const {
    const double wanted = std::clamp(p, 0.0, 1.0) * total_;
    double below = 0.0;
    for (std::size_t i = 0; i < area_.size(); ++i) {
        if (area_[i] > 0.0 && below + area_[i] >= wanted) {
            const double within = (wanted - below) / area_[i];
            return std::exp2((static_cast<double>(i) + within) / kStepsPerStop - kStops);
        }
        below += area_[i];
    }
    return 0.0;
}

base::Rgb emissionOfSide(const scene::LitMesh& mesh, const scene::Material& material) {
    return mesh.back && !material.doubleSided ? base::Rgb(0.0f) : material.emission;
}

MeshLuminance luminanceOf(const scene::LitMesh& mesh, const scene::Material& material,
                          const base::Rgb& meanReflectanceTexture, const base::Rgb& meanEmissionTexture,
                          std::size_t step) {
    MeshLuminance result;
    const base::Rgb reflectance = material.reflectance * meanReflectanceTexture;
    const base::Rgb emission = emissionOfSide(mesh, material) * meanEmissionTexture;
    const bool emits = base::luminance(emission) > 0.0f;
    for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3 * step) {
        const std::uint32_t a = mesh.triangles[t];
        const std::uint32_t b = mesh.triangles[t + 1];
        const std::uint32_t c = mesh.triangles[t + 2];
        const base::Vec3d p(mesh.positions[a]);
        const double area = 0.5 * glm::length(glm::cross(base::Vec3d(mesh.positions[b]) - p,
                                                         base::Vec3d(mesh.positions[c]) - p));
        const base::Rgb irradiance =
            (mesh.irradiance[a] + mesh.irradiance[b] + mesh.irradiance[c]) * (1.0f / 3.0f);
        const float exitance = base::luminance(reflectance * irradiance + emission);
        result.illuminance.add(static_cast<double>(base::luminance(irradiance)), area);
        (emits ? result.emitting : result.reflecting).add(static_cast<double>(exitance) / base::kPi, area);
    }
    return result;
}

double automaticExposure(const LuminanceHistogram& reflecting, const LuminanceHistogram& emitting) {
    if (reflecting.isEmpty()) {
        return emitting.isEmpty() ? 1.0 : kBrightLevel / emitting.percentile(kBrightPart);
    }
    return std::min(kBrightLevel / reflecting.percentile(kBrightPart),
                    kMiddleLevel / reflecting.percentile(0.5));
}

double exposureValue(double exposure) {
    return -std::log2(exposure * kWhitePerExposureValue);
}

double exposureFromValue(double value) {
    return std::exp2(-value) / kWhitePerExposureValue;
}

}  // namespace fluxwalk::render
