#pragma once

#include <string>

#include "core/image/inspect.h"
#include "core/scene/scene.h"
#include "viewer/ui/legend.h"

namespace fluxwalk::ui {

/// What is shown of an inspected point beside its values.
struct InspectionView {
    bool links = false;         ///< of its element, as lines
    bool contributors = false;  ///< as a list
    bool visibility = false;    ///< lines to its links, coloured by the part that is not blocked
};

/// The whole of it as lines of text, for people and for scripts: "key: value".
std::string describeInspection(const image::Inspection& inspection, const scene::Scene& scene);

/// Draws over a picture as seen by `camera`: the element's outline and links, a small readout beside the
/// point, and what lights it as a list in the upper right corner.
void drawInspection(const image::Inspection& inspection, const scene::Scene& scene,
                    const scene::Camera& camera, const InspectionView& view, const Canvas& canvas);

}  // namespace fluxwalk::ui
