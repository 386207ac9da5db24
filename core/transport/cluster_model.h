#pragma once

#include <cstdint>

namespace fluxwalk::transport {

/// What clusters are taken for in transport.
enum class ClusterModel : std::uint8_t {
    oriented,  ///< surfaces with directions of their own, behind others by rays (cluster_factor.h)
    isotropic  ///< clouds of surfaces that face all ways alike (isotropic_cluster.h): cheaper, less exact
};

}  // namespace fluxwalk::transport
