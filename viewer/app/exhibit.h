#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "core/scene/camera_path.h"
#include "core/scene/lit_mesh.h"
#include "core/scene/scene.h"
#include "core/solve/options.h"
#include "viewer/render/scene_renderer.h"
#include "viewer/session/solver_session.h"
#include "viewer/ui/inspection.h"

namespace fluxwalk::app {

/// What to walk through.
struct Exhibit {
    std::shared_ptr<const scene::Scene> scene;
    /// Where it comes from; empty for a built-in scene.
    std::filesystem::path file;
    scene::Camera camera;
    /// Played at once; empty for none.
    scene::CameraPath path;
    /// What is shown at first.
    render::DrawSettings look;
    bool isProbing = false;
    ui::InspectionView inspection;
    /// A lit file's meshes; null where the scene is solved.
    std::shared_ptr<const solve::Snapshot> lit;
    /// Its shapes as objects, for the floor: the scene itself, or one made of a lit file's meshes.
    std::shared_ptr<const scene::Scene> solid;
    /// How to solve; nothing for a lit file.
    std::optional<solve::Options> options;
    session::SolverSource solver;
};

}  // namespace fluxwalk::app
