#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/named_arrays.h"
#include "core/base/parallel.h"
#include "core/scene/lit_mesh.h"
#include "core/scene/scene.h"
#include "core/solve/elements.h"
#include "core/solve/options.h"
#include "core/solve/statistics.h"

/// Hierarchical radiosity: the loop of the design, section 4.
namespace fluxwalk::solve {

struct Problem;

/// Immutable view of the solution at one moment, shared by pointer between threads.
struct Snapshot {
    std::uint64_t sequence = 0;
    scene::LitMeshes meshes;
    Statistics statistics;
    bool finished = false;  ///< the solver rests
    /// As far as Callbacks::detail asks for them. Elements are parallel to the meshes.
    std::vector<std::shared_ptr<const MeshElements>> elements;
    std::shared_ptr<const std::vector<ClusterBox>> clusters;
    /// The lights that this is the light of.
    scene::Lighting lighting;
};

/// Why solve() returned.
enum class Outcome : std::uint8_t {
    reachedError,
    reachedTimeLimit,
    reachedLinkLimit,
    reachedMemoryLimit,
    stopped
};

/// Moments of a solve from which it can go on to the same bits.
enum class Moment : std::uint8_t {
    wave,   ///< between two waves of refinement, or two sweeps
    level,  ///< after a level of refinement that was not cut short
    stop    ///< before a stop or the time limit cuts a level short
};

/// Called on the solving thread, between waves and sweeps. All may be empty.
struct Callbacks {
    /// Gets a snapshot at most ten times a second, and one at the end: after sweeps, of a refinement under
    /// way, and in parts while another displayAngle takes its time. The first one is the first guess.
    std::function<void(std::shared_ptr<const Snapshot>)> publish;
    /// What snapshots shall tell beside the light.
    std::function<Detail()> detail;
    /// Called after sweeps, when links and light agree: what looks at the solver then sees a whole state, or
    /// in the midst of a refinement what would be one, were it to end there. Its time does not count.
    std::function<void()> settled;
    /// Asked at wave boundaries; true ends the solve with what it has.
    std::function<bool()> shouldStop;
    /// Asked at wave boundaries and some milliseconds apart within waves; new options take effect there
    /// (error, oracle, threshold, minArea, lighting).
    std::function<std::optional<Options>()> newOptions;
    /// Called at all of these; Solver::checkpoint() then gives what the solve can go on from.
    std::function<void(Moment)> resumable;
    /// Progress in [0, 1] towards the requested error, with a short description of the stage.
    std::function<void(double, const char*)> progress;
};

class Solver {
  public:
    Solver(std::shared_ptr<const scene::Scene> scene, const Options& options, unsigned threads);
    ~Solver();

    /// Runs until the requested error, a limit or a stop. May be called again with other options: it goes on
    /// from where it is, or only shows the solution anew where they ask for no more than it has. A threshold
    /// that rose to more than twice what the links were refined to, and budgets below what they take, make
    /// them coarser again. Throws base::UsageError where a budget is too small for the scene.
    Outcome solve(const Callbacks& callbacks);

    /// The state as named arrays (checkpoint.h); for Callbacks::resumable.
    base::NamedArrays checkpoint() const;
    /// Goes on from such a state, for a solver that was just made of the same scene; solve() then does what
    /// it would have done next. The time limit counts from here. Throws base::FileError that names `file`,
    /// where the arrays come from; the solver is then good for nothing.
    void restore(const base::NamedArrays& arrays, const std::string& file);

    void setOptions(const Options& options);
    const Options& options() const;
    const Statistics& statistics() const;
    /// What the solve takes now, as the memory limit counts it: all that it holds, and what refining,
    /// sweeping and showing take on the way.
    std::uint64_t countBytes() const;
    /// The present solution, while it is not being solved or from Callbacks::settled.
    std::shared_ptr<const Snapshot> show(const Detail& detail);
    /// Display meshes of the present solution, for all objects.
    scene::LitMeshes litMeshes() const;

    /// The solved problem, for gathering at points.
    const Problem& problem() const;

  private:
    void start();
    void tighten();
    void relight();
    void finishFollowing();
    double estimateError();

    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fluxwalk::solve
