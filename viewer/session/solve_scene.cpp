#include "viewer/session/solver_session.h"

namespace fluxwalk::session {

SolveFunction solveScene(std::shared_ptr<const scene::Scene> scene, unsigned threads) {
    // Functions are copyable, the solver is not.
    auto solver = std::make_shared<std::unique_ptr<solve::Solver>>();
    return [scene = std::move(scene), threads, solver](const solve::Options& options,
                                                       const solve::Callbacks& callbacks) {
        if (*solver == nullptr) {
            *solver = std::make_unique<solve::Solver>(scene, options, threads);
        } else {
            (*solver)->setOptions(options);
        }
        return (*solver)->solve(callbacks);
    };
}

}  // namespace fluxwalk::session
