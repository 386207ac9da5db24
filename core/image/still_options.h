#pragma once

#include <span>
#include <string_view>

#include "core/image/final_gather.h"

/// How well a still is gathered: one table for the options of `render` and the viewer's panel.
namespace fluxwalk::image {

struct StillOptionInfo {
    std::string_view name;  ///< as typed after "--"
    unsigned minimum = 0;
    unsigned maximum = 0;
    std::string_view explanation;
    unsigned (*get)(const StillOptions&) = nullptr;
    void (*set)(StillOptions&, unsigned) = nullptr;

    unsigned defaultValue() const { return get(StillOptions{}); }
};

/// In the order in which they are shown.
std::span<const StillOptionInfo> stillOptionsTable();

/// The entry of that name, which must exist.
const StillOptionInfo& stillOption(std::string_view name);

}  // namespace fluxwalk::image
