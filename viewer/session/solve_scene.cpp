#include "core/solve/turn.h"
#include "viewer/session/solver_session.h"

namespace fluxwalk::session {

Solving solveWith(SolverSource source) {
    // Functions are copyable, the solver is not.
    auto solver = std::make_shared<std::unique_ptr<solve::Solver>>();
    Solving solving;
    solving.solve = [source = std::move(source), solver](const solve::Options& options,
                                                         const solve::Callbacks& callbacks) {
        if (*solver == nullptr || solve::needsNewSolver((*solver)->options(), options)) {
            // Before the new one is made, so that memory is needed once.
            solver->reset();
            *solver = source.make(options);
        } else {
            (*solver)->setOptions(options);
        }
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
    return solving;
}

}  // namespace fluxwalk::session
