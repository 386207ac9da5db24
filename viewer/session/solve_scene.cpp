#include "viewer/session/solver_session.h"

namespace fluxwalk::session {

SolveFunction solveWith(SolverSource source) {
    // Functions are copyable, the solver is not.
    auto solver = std::make_shared<std::unique_ptr<solve::Solver>>();
    return [source = std::move(source), solver](const solve::Options& options,
                                                const solve::Callbacks& callbacks) {
        if (*solver == nullptr) {
            *solver = source.make(options);
        } else {
            (*solver)->setOptions(options);
        }
        solve::Callbacks all = callbacks;
        if (source.resumable) {
            all.resumable = [&](solve::Moment moment) { source.resumable(**solver, moment); };
        }
        return (*solver)->solve(all);
    };
}

}  // namespace fluxwalk::session
