#pragma once

namespace fluxwalk::ui {

/// Exposure of the view: follows the scene or is held.
struct ExposureControl {
    bool isAutomatic = true;
    /// Stops added to the automatic exposure.
    double compensation = 0.0;
    /// Present exposure per cd/m2; 0 before the first light.
    double exposure = 0.0;

    /// Goes towards `automatic` (per cd/m2) where it follows the scene: at once the first time, then as eyes
    /// do. Returns whether the exposure changed.
    bool follow(double automatic, double seconds);
};

}  // namespace fluxwalk::ui
