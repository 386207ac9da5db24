#include "core/solve/coarsen.h"

#include <span>

namespace fluxwalk::solve {

namespace {

constexpr double kHysteresis = 2.0;

}  // namespace

bool asksForCoarser(const Problem& problem) {
    return !problem.links.links.empty() &&
           problem.options.threshold > kHysteresis * problem.statistics.threshold;
}

void dropLinks(Problem& problem) {
    if (problem.keepsKnown) {
        problem.known.takeIn(std::span(problem.links.links).subspan(problem.links.clusterLinks));
    }
    problem.links = {};
    problem.pending.clear();
}

bool hasTooSmallElements(const Problem& problem) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const double least = problem.minArea();
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        if (h.kind(id) == hierarchy::NodeKind::element && !h.isLeaf(id) &&
            static_cast<double>(h.shape(id).area) <= least) {
            return true;
        }
    }
    return false;
}

void pruneElements(Problem& problem) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    std::vector<std::uint8_t> isLinked(h.nodeCount(), 0);
    for (const hierarchy::Link& link : problem.links.links) {
        isLinked[base::index(link.a)] = 1;
        isLinked[base::index(link.b)] = 1;
    }
    const std::vector<NodeId> places = h.prune(isLinked);
    for (hierarchy::Link& link : problem.links.links) {
        link.a = places[base::index(link.a)];
        link.b = places[base::index(link.b)];
    }
    problem.known.move(places);
    problem.links.index(h.nodeCount());
    Counters& counters = problem.statistics.counters;
    counters.nodes = h.nodeCount();
    counters.leaves = h.leafCount();
    counters.bytesNodes = counters.nodes * hierarchy::Hierarchy::bytesPerNode();
    counters.bytesLinks = problem.links.bytes();
}

}  // namespace fluxwalk::solve
