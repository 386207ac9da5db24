#pragma once

#include <optional>

#include <nlohmann/json.hpp>

#include "core/base/vec.h"
#include "core/surface/surface.h"

namespace fluxwalk::io {

/// How a node says what it exactly is: its transform, and its extras.
struct ExactNode {
    base::Mat4d worldFromNode{1.0};
    nlohmann::json extras;
};

/// None for surfaces that `fluxwalk_surface` does not name. Sizes stand in the extras in metres wherever the
/// shape is not stretched.
std::optional<ExactNode> describeExactNode(const surface::Surface& surface);

}  // namespace fluxwalk::io
