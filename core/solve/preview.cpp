#include "core/solve/preview.h"

#include <algorithm>
#include <utility>

#include "core/solve/first_guess.h"
#include "core/solve/refine.h"
#include "core/solve/sweep.h"

namespace fluxwalk::solve {

namespace {

bool isLink(const Decision& d) {
    return d.isComputed && d.canStand();
}

}  // namespace

bool canPreview(const Problem& problem, std::span<const Decision> underway) {
    return std::all_of(problem.pending.begin(), problem.pending.end(), isLink) &&
           std::all_of(underway.begin(), underway.end(), isLink) && problem.linkCount() + underway.size() > 0;
}

void preview(Problem& problem, std::span<const Decision> underway, int most, double residual,
             const std::function<void()>& show) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    std::vector<hierarchy::Light> lights;
    lights.reserve(h.nodeCount());
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        lights.push_back(h.light(NodeId{i}));
    }
    const Statistics statistics = problem.statistics;
    hierarchy::LinkStore accepted = std::move(problem.links);
    std::vector<Decision> pending = std::move(problem.pending);

    problem.links = {};
    problem.pending.clear();
    std::vector<hierarchy::Link>& links = problem.links.links;
    links.reserve(accepted.links.size() + pending.size() + underway.size());
    links = accepted.links;
    for (const std::span<const Decision> all : {std::span<const Decision>(pending), underway}) {
        for (const Decision& d : all) {
            links.push_back(d.link);
        }
    }
    orderLinks(problem);
    problem.statistics.counters.links = links.size();
    problem.statistics.counters.nodes = h.nodeCount();
    problem.statistics.counters.leaves = h.leafCount();
    Sweeper sweeper(problem);
    for (int i = 0; i < most; ++i) {
        problem.statistics.residual = sweeper.sweep();
        if (problem.statistics.residual <= residual) {
            break;
        }
    }
    problem.statistics.meanIrradiance = meanIrradiance(h);
    show();

    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        h.light(NodeId{i}) = lights[i];
    }
    const StageTimes times = problem.statistics.times;
    problem.statistics = statistics;
    problem.statistics.times = times;
    problem.links = std::move(accepted);
    problem.pending = std::move(pending);
}

}  // namespace fluxwalk::solve
