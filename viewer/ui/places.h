#pragma once

#include <span>
#include <string>

#include "core/scene/scene.h"

namespace fluxwalk::ui {

/// Where one may go.
struct Places {
    std::span<const scene::Camera> cameras;  ///< of the scene
    std::span<const scene::Camera> bookmarks;
    std::span<const std::string> recentFiles;
    bool isRecording = false;
    bool isPlaying = false;
    bool hasPath = false;  ///< one that can be played
};

/// What the user chose there in one frame.
struct PlaceActions {
    int camera = -1;    ///< index of the one to go to
    int bookmark = -1;  ///< index of the one to go to
    int forget = -1;    ///< index of the one to delete
    bool keeps = false;
    bool togglesRecording = false;
    bool togglesPlaying = false;
    int recentFile = -1;  ///< index of the one to open
};

/// Section of the panel.
PlaceActions drawPlaces(const Places& places);

}  // namespace fluxwalk::ui
