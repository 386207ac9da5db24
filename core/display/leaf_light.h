#pragma once

#include <vector>

#include "core/base/photometry.h"
#include "core/display/cell.h"

namespace fluxwalk::display {

/// Irradiance that was found at one point of a leaf.
struct LightSample {
    GridPoint at;
    Rgb irradiance{0.0f};  ///< lux, each channel
    /// It lies in a solid that stands on the leaf, or in a gap too narrow to be shown: nothing is known.
    bool isHidden = false;
};

/// Light at points of one leaf, so close to each other that triangles between them show it.
struct LeafLight {
    /// Corners and middles of the leaf and of all cells that it is cut into (of triangles the middles of
    /// their sides), in the order of `at`, y before x.
    std::vector<LightSample> samples;
    /// Parts of the leaf, by their paths, that are cut in four; ascending.
    std::vector<surface::Path> splits;
};

}  // namespace fluxwalk::display
