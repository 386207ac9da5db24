#pragma once

#include <vector>

#include "core/scene/lighting.h"

namespace fluxwalk::ui {

/// How one light source is turned. Level and colour outlast being switched off.
struct LightControl {
    bool isOn = true;
    double level = 1.0;      ///< 1 as the scene says
    scene::Rgb color{1.0f};  ///< linear, of a filter before it: its largest channel is 1

    scene::Rgb factor() const { return isOn ? color * static_cast<float>(level) : scene::Rgb(0.0f); }
    bool operator==(const LightControl&) const = default;
};

LightControl controlOf(const scene::Rgb& factor);
std::vector<LightControl> controlsOf(const std::vector<scene::LightSource>& sources,
                                     const scene::Lighting& lighting);

}  // namespace fluxwalk::ui
