#include "core/image/still_options.h"

#include <algorithm>
#include <array>

#include "core/base/check.h"

namespace fluxwalk::image {
namespace {

void setShadowRays(StillOptions& options, unsigned rays) {
    options.rays.weak = rays;
    options.rays.strong = rays + rays / 3;
    options.rays.sky = options.rays.strong;
}

constexpr std::array<StillOptionInfo, 2> kTable{
    {{"samples", 1, 16,
      "Samples of a pixel where its neighbours differ in object, normal or light, and on textures; 1 for "
      "none beside its middle.",
      [](const StillOptions& o) { return o.samples; },
      [](StillOptions& o, unsigned value) { o.samples = value; }},
     {"shadow-rays", 8, 4096,
      "Shadow rays for each point to all weak sources together; a lamp gets up to a third more. Four times "
      "as many halve the noise at least.",
      [](const StillOptions& o) { return o.rays.weak; }, setShadowRays}}};

}  // namespace

std::span<const StillOptionInfo> stillOptionsTable() {
    return kTable;
}

const StillOptionInfo& stillOption(std::string_view name) {
    const auto* found = std::find_if(kTable.begin(), kTable.end(),
                                     [name](const StillOptionInfo& option) { return option.name == name; });
    FLUXWALK_CHECK(found != kTable.end());
    return *found;
}

}  // namespace fluxwalk::image
