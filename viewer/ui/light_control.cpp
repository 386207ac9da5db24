#include "viewer/ui/light_control.h"

#include <algorithm>

namespace fluxwalk::ui {

LightControl controlOf(const scene::Rgb& factor) {
    const float largest = std::max({factor.r, factor.g, factor.b});
    if (!(largest > 0.0f)) {
        return {false, 1.0, scene::Rgb(1.0f)};
    }
    return {true, static_cast<double>(largest), factor / largest};
}

std::vector<LightControl> controlsOf(const std::vector<scene::LightSource>& sources,
                                     const scene::Lighting& lighting) {
    std::vector<LightControl> controls;
    controls.reserve(sources.size());
    for (const scene::LightSource& source : sources) {
        controls.push_back(controlOf(scene::factorOf(lighting, source)));
    }
    return controls;
}

}  // namespace fluxwalk::ui
