#pragma once

#include <array>

#include "core/scene/lit_mesh.h"
#include "core/scene/material.h"

/// How bright a scene is and how a camera would expose it.
namespace fluxwalk::render {

/// Area by luminance (or another value), in steps of 1/8 stop from 2^-24 to 2^24 cd/m2; darker surfaces are
/// left out (unlit parts say nothing about the light).
class LuminanceHistogram {
  public:
    /// `luminance` in cd/m2, `area` in m2.
    void add(double luminance, double area);
    void add(const LuminanceHistogram& other);

    bool isEmpty() const { return total_ <= 0.0; }
    /// Luminance in cd/m2 below which the part `p` (0..1) of the area lies; 0 if empty.
    double percentile(double p) const;

  private:
    static constexpr int kStepsPerStop = 8;
    static constexpr int kStops = 24;
    std::array<double, 2 * kStops * kStepsPerStop> area_{};
    double total_ = 0.0;
};

/// Luminances of one lit side. Sides that emit count with their emission only in `emitting`, since lamps may
/// be brighter than the picture can show. The means of the textures are linear colours (white without). Only
/// every `step`-th triangle is looked at.
struct MeshLuminance {
    LuminanceHistogram reflecting;
    LuminanceHistogram emitting;
    /// Illuminance of all sides, lux instead of cd/m2.
    LuminanceHistogram illuminance;
};
MeshLuminance luminanceOf(const scene::LitMesh& mesh, const scene::Material& material,
                          const base::Rgb& meanReflectanceTexture, const base::Rgb& meanEmissionTexture,
                          std::size_t step = 1);

/// Emission in lm/m2 that leaves this side: the front, or both if the material is doubleSided.
base::Rgb emissionOfSide(const scene::LitMesh& mesh, const scene::Material& material);

/// Exposure per cd/m2 that shows the bright surfaces (85 % of the area is darker) just below white, and half
/// of the area no brighter than half of white: evenly lit walls are not white. Goes by the bright emitting
/// sides where nothing else is lit, and is 1 where nothing is.
double automaticExposure(const LuminanceHistogram& reflecting, const LuminanceHistogram& emitting);

/// Exposure value at ISO 100 of an exposure per cd/m2, by the saturation-based film speed (ISO 12232): white
/// is at 1.2 * 2^EV cd/m2.
double exposureValue(double exposure);
double exposureFromValue(double exposureValue);

}  // namespace fluxwalk::render
