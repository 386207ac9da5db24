#include "core/base/error.h"

#include <utility>

namespace fluxwalk::base {

namespace {

std::string joinPlace(const std::string& file, const std::string& place, const std::string& message) {
    return place.empty() ? file + ": " + message : file + ": " + place + ": " + message;
}

}  // namespace

FileError::FileError(std::string file, std::string place, const std::string& message)
    : std::runtime_error(joinPlace(file, place, message)), file_(std::move(file)), place_(std::move(place)) {}

}  // namespace fluxwalk::base
