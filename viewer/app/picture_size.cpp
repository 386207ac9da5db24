#include "viewer/app/picture_size.h"

#include <charconv>
#include <string>

#include "core/base/error.h"

namespace fluxwalk::app {
namespace {

/// What every OpenGL implementation in use can draw into at once.
constexpr int kLargestSide = 16384;

bool parseSide(std::string_view text, int& side) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
    return error == std::errc{} && end == text.data() + text.size() && side >= 1 && side <= kLargestSide;
}

}  // namespace

gl::PixelSize parseSize(std::string_view text) {
    const std::size_t cross = text.find('x');
    gl::PixelSize size;
    if (cross == std::string_view::npos || !parseSide(text.substr(0, cross), size.width) ||
        !parseSide(text.substr(cross + 1), size.height)) {
        throw base::UsageError("--size: '" + std::string(text) + "' is not WIDTHxHEIGHT with 1 to " +
                               std::to_string(kLargestSide) + " pixels a side, as in 1280x720");
    }
    return size;
}

}  // namespace fluxwalk::app
