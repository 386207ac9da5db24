#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/base/parallel.h"
#include "core/scene/lit_mesh.h"
#include "core/scene/scene.h"
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
    bool finished = false;
};

/// Why solve() returned.
enum class Outcome : std::uint8_t { reachedError, reachedTimeLimit, stopped };

/// Called on the solving thread, between waves and sweeps. All may be empty.
struct Callbacks {
    /// Gets a snapshot after sweeps, at most ten a second, and one at the end.
    std::function<void(std::shared_ptr<const Snapshot>)> publish;
    /// Asked at wave boundaries; true ends the solve with what it has.
    std::function<bool()> shouldStop;
    /// Asked at wave boundaries; new options take effect there (error, oracle, threshold, minArea).
    std::function<std::optional<Options>()> newOptions;
    /// Progress in [0, 1] towards the requested error, with a short description of the stage.
    std::function<void(double, const char*)> progress;
};

class Solver {
  public:
    Solver(std::shared_ptr<const scene::Scene> scene, const Options& options, unsigned threads);
    ~Solver();

    /// Runs until the requested error, a limit or a stop. May be called again with other options: it goes on
    /// from where it is, or only shows the solution anew where they ask for no more than it has.
    Outcome solve(const Callbacks& callbacks);

    void setOptions(const Options& options);
    const Options& options() const;
    const Statistics& statistics() const;
    /// Display meshes of the present solution, for all objects.
    scene::LitMeshes litMeshes() const;

    /// The solved problem, for gathering at points.
    const Problem& problem() const;

  private:
    double estimateError();

    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fluxwalk::solve
