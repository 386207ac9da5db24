#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/lighting.h"

namespace fluxwalk::cli {

/// A light source as typed, with the factor on what it emits.
struct TurnedLight {
    std::string name;
    scene::Rgb factor{1.0f};
};

/// "NAME=FACTOR" or "NAME=r,g,b", each from 0 (off) to scene::kLargestLightFactor. Throws base::UsageError.
TurnedLight parseTurnedLight(std::string_view text);

/// `lighting` with these lights turned. A name means all sources of that name. Throws base::UsageError for
/// one that no source of the scene has, which suggests the nearest.
scene::Lighting turnLights(const std::vector<TurnedLight>& lights, const scene::Scene& scene,
                           scene::Lighting lighting);

}  // namespace fluxwalk::cli
