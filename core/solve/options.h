#pragma once

#include <cstddef>
#include <cstdint>

#include "core/rays/ray_scene.h"
#include "core/scene/lighting.h"
#include "core/transport/cluster_model.h"
#include "core/transport/oracle.h"
#include "core/transport/visibility.h"

/// What the user may turn. Every value has a unit and a default; cli and viewer show the same table.
namespace fluxwalk::solve {

using rays::RayEngine;
using rays::TreeBuilder;
using transport::ClusterModel;
using transport::OracleKind;
using transport::RayCount;

/// Where the requested error is to hold.
enum class ErrorOf : std::uint8_t {
    displayed,  ///< the interpolated vertex values of the lit mesh
    gathered    ///< irradiance gathered at points (sensors, pictures), two to three times more exact from the
                ///< same links
};

/// Whether links may end at clusters.
enum class ClusterLinks : std::uint8_t {
    automatic,  ///< in scenes of more than kManyPatches patches
    on,
    off  ///< every pair of patches that see each other has links of its own
};
/// Below this number direct links cost as little and resolve more: what passes an opening, what lies in a
/// gap.
inline constexpr std::size_t kManyPatches = 2000;

/// What light the vertices of the displayed mesh have. Changes nothing in a solve: solution and errors are
/// the same.
enum class DisplayLight : std::uint8_t {
    interpolated,  ///< smooth between the means of the leaves
    gathered       ///< found at the vertices themselves (image/display_gather.h), by whoever shows the mesh
};

/// How a node's radiosity follows from its children's (push copies irradiance in either).
enum class PullRule : std::uint8_t {
    /// Means by true area: adjoint to push, power is conserved (ALGORITHMS 1.5, convention A).
    trueArea,
    /// Means by area projected on the parent's normal (Schaefer, section 1), normalised: constants are kept,
    /// but power on curved surfaces is not. For comparison; Audit::pullDefect says what it does.
    projected
};

struct Options {
    /// Requested error p: RMS of E - E* over all sides that light reaches, as a part of the mean irradiance.
    double error = 0.02;
    ErrorOf errorOf = ErrorOf::displayed;
    OracleKind oracle = OracleKind::bounded;
    ClusterLinks clusterLinks = ClusterLinks::automatic;
    /// Largest error of a link in lux (bf: of the receiver; bfa and bounded: spread over the whole scene's
    /// area). 0 chooses it by a closed loop that ends at `error`.
    double threshold = 0.0;
    /// Weight of the normals' spread over curved elements in the bounded oracle, beside the spread of the
    /// kernel that its sample points see: 1 takes what the cone of normals implies. 0 leaves it out.
    double curvatureWeight = 1.0;
    /// No element is split below this area in m2. 0 means 1e-7 of the scene's area.
    double minArea = 0.0;
    PullRule pullRule = PullRule::trueArea;
    /// Scales the coefficients of closed scenes symmetrically until every row sums to 1, by 5 % at most.
    bool rowScaling = false;
    /// Displayed triangles of curved surfaces are refined until normals within an element's part lie within
    /// this angle of a common axis, in degrees. Costs no transport.
    double displayAngle = 4.0;
    DisplayLight display = DisplayLight::interpolated;
    /// How clusters, and trees for shafts and RayEngine::clusters, are built. Fixed when a solver is made.
    TreeBuilder clusters = TreeBuilder::sah;
    /// What clusters are taken for in transport. Fixed when a solver is made.
    ClusterModel clusterModel = ClusterModel::oriented;
    /// Rays of visibility for each pair. Fixed when a solver is made.
    RayCount visibilityRays = RayCount::usual;
    /// What answers rays of visibility. Fixed when a solver is made.
    RayEngine rays = RayEngine::embree;
    std::uint64_t seed = 1;
    /// Seconds after which the solver stops with what it has; 0 for none.
    double timeLimit = 0.0;
    /// Most links, that is unordered pairs; 0 for no limit.
    std::uint64_t linkLimit = 0;
    /// Most bytes of memory that the process may hold; 0 for what it has and three quarters of what the
    /// machine has left when the solver is made.
    std::uint64_t memoryLimit = 0;
    /// How the lights are turned. New ones need new sweeps over the links that stand, and no new solve.
    scene::Lighting lighting;
};

}  // namespace fluxwalk::solve
