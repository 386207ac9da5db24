#pragma once

#include <string_view>

#include "viewer/gl/pixel_size.h"

namespace fluxwalk::app {

/// Size typed as "1280x720", each side 1 to 16384. Throws base::UsageError.
gl::PixelSize parseSize(std::string_view text);

}  // namespace fluxwalk::app
