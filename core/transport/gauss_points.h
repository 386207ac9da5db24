#pragma once

#include <array>

namespace fluxwalk::transport {

/// 4-point Gauss-Legendre on [0, 1]: nodes, and weights that sum to 1.
inline constexpr std::array<double, 4> kGauss4{0.069431844202973714, 0.33000947820757187, 0.66999052179242813,
                                               0.93056815579702629};
inline constexpr std::array<double, 4> kGauss4Weight{0.17392742256872693, 0.32607257743127307,
                                                     0.32607257743127307, 0.17392742256872693};

}  // namespace fluxwalk::transport
