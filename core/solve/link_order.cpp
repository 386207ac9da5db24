#include "core/solve/link_order.h"

#include <algorithm>

namespace fluxwalk::solve {

using hierarchy::Link;
using hierarchy::NodeKind;

void countLinks(Problem& problem) {
    Counters& counters = problem.statistics.counters;
    counters.nodes = problem.hierarchy.nodeCount();
    counters.leaves = problem.hierarchy.leafCount();
    counters.links = problem.links.links.size();
    counters.bytesNodes = counters.nodes * hierarchy::Hierarchy::bytesPerNode();
    counters.bytesLinks = problem.links.bytes();
}

void orderLinks(Problem& problem) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    std::vector<Link>& links = problem.links.links;
    const auto withClusters = std::stable_partition(links.begin(), links.end(), [&h](const Link& link) {
        return h.kind(link.a) == NodeKind::cluster || h.kind(link.b) == NodeKind::cluster;
    });
    problem.links.clusterLinks = static_cast<std::size_t>(withClusters - links.begin());
    problem.links.index(h.nodeCount());
}

}  // namespace fluxwalk::solve
