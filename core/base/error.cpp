#include "core/base/error.h"

#include <algorithm>
#include <utility>

namespace fluxwalk::base {

std::string toOneLine(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    return text;
}

namespace {

std::string joinPlace(const std::string& file, const std::string& place, const std::string& message) {
    return place.empty() ? file + ": " + message : file + ": " + place + ": " + message;
}

}  // namespace

FileError::FileError(std::string file, std::string place, const std::string& message)
    : std::runtime_error(toOneLine(joinPlace(file, place, message))),
      file_(std::move(file)),
      place_(std::move(place)) {}

}  // namespace fluxwalk::base
