#include "core/solve/turn.h"
#include "viewer/session/solver_session.h"

namespace fluxwalk::session {
namespace {

/// A sweep that changes less than this part of the power leaves light that stills can be gathered from.
constexpr double kStillResidual = 0.01;

}  // namespace

Solving solveWith(SolverSource source) {
    // Functions are copyable, the solver is not.
    auto solver = std::make_shared<std::unique_ptr<solve::Solver>>();
    // After the solver, which it looks at: it goes first.
    auto job = std::make_shared<GatherJob>();
    Solving solving;
    solving.solve = [source = std::move(source), solver, job](const solve::Options& options,
                                                              const solve::Callbacks& callbacks) {
        if (*solver == nullptr || solve::needsNewSolver((*solver)->options(), options)) {
            // Before the new one is made, so that memory is needed once.
            job->forget();
            solver->reset();
            *solver = source.make(options);
        } else {
            (*solver)->setOptions(options);
        }
        job->doubt();
        solve::Callbacks all = callbacks;
        if (source.resumable) {
            all.resumable = [&](solve::Moment moment) {
                source.resumable(**solver, moment);
                callbacks.resumable(moment);
            };
        }
        return (*solver)->solve(all);
    };
    solving.look.show = [solver](const solve::Detail& detail) {
        return *solver == nullptr ? nullptr : (*solver)->show(detail);
    };
    solving.look.inspect = [solver](const rays::Ray& ray) {
        return *solver == nullptr ? std::nullopt : image::inspectAlong((*solver)->problem(), ray);
    };
    solving.look.takeStill = [solver](const scene::Camera& camera, const image::StillOptions& options,
                                      const image::StillCallbacks& callbacks) {
        const solve::Problem& problem = (*solver)->problem();
        image::StillOptions all = options;
        all.seed = problem.options.seed;
        return image::takeStill(problem, camera, all, callbacks);
    };
    solving.look.isFitForStill = [solver] {
        const solve::Statistics& statistics = (*solver)->statistics();
        return !statistics.history.empty() && statistics.residual < kStillResidual;
    };
    solving.look.gather = [solver, job](const image::Look& look,
                                        std::shared_ptr<const solve::Snapshot> solved) {
        return *solver == nullptr ? GatherStep{} : job->step(**solver, look, std::move(solved));
    };
    return solving;
}

}  // namespace fluxwalk::session
