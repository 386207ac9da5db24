#pragma once

#include <array>
#include <vector>

namespace fluxwalk::hierarchy {

/// What clusters' transfers ask of their patches, array by array in the order of Hierarchy::patches(), so
/// that a cluster is one run.
struct PatchTable {
    std::array<std::vector<float>, 3> center;  ///< x, y and z, m
    std::array<std::vector<float>, 3> axis;    ///< mean normals
    std::vector<float> spread;                 ///< half angle of the cone of normals, at most 1 radian
    std::vector<float> area;                   ///< exposed (Shape::ownArea), m2
};

}  // namespace fluxwalk::hierarchy
