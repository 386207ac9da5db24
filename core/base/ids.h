#pragma once

#include <cstdint>

namespace fluxwalk::base {

/// Index of a node (cluster, patch, element or light source) of one hierarchy. Depends on history: never
/// leaves the process.
enum class NodeId : std::uint32_t { none = 0xffffffffu };
/// Index of an object in its scene.
enum class ObjectId : std::uint32_t { none = 0xffffffffu };

constexpr std::uint32_t index(NodeId id) {
    return static_cast<std::uint32_t>(id);
}
constexpr std::uint32_t index(ObjectId id) {
    return static_cast<std::uint32_t>(id);
}

}  // namespace fluxwalk::base
