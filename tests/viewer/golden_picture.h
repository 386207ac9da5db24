#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viewer/gl/pixel_size.h"

namespace fluxwalk::testing {

/// Size of all pictures in tests/golden.
inline constexpr gl::PixelSize kGoldenSize{480, 270};

/// Fails where a picture differs from tests/golden/`name` by more than rounding; writes it into the working
/// folder then. To take it for the right one: look at it, and copy it to tests/golden.
void expectGolden(const std::vector<std::uint8_t>& drawn, const std::string& name);

}  // namespace fluxwalk::testing
