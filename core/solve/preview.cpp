#include "core/solve/preview.h"

#include <algorithm>
#include <utility>

#include "core/solve/first_guess.h"
#include "core/solve/link_order.h"
#include "core/solve/sweep.h"

namespace fluxwalk::solve {

namespace {

bool isLink(const Decision& d) {
    return d.isComputed && d.canStand();
}

// Lights leaves by `ambient` from where no link leads yet: links of a closed scene sum to 1.
void fillUp(Problem& problem, double ambient) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    std::vector<double> share(h.nodeCount(), 0.0);
    const auto isElement = [&h](NodeId id) {
        return id != NodeId::none && h.kind(id) == hierarchy::NodeKind::element;
    };
    for (const hierarchy::Link& link : problem.links.links) {
        if (isElement(link.a) && isElement(link.b)) {
            share[base::index(link.a)] += static_cast<double>(link.transfer());
            share[base::index(link.b)] += link.a == link.b ? 0.0 : static_cast<double>(link.transfer());
        }
    }
    // Parents come before their children.
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        if (!isElement(id)) {
            continue;
        }
        const auto area = static_cast<double>(h.shape(id).exposedArea());
        share[i] = area > 0.0 ? share[i] / area : 1.0;
        if (isElement(h.parent(id))) {
            share[i] += share[base::index(h.parent(id))];
        }
        if (h.isLeaf(id)) {
            h.light(id).irradiance += Rgb(static_cast<float>(ambient * std::max(0.0, 1.0 - share[i])));
        }
    }
}

}  // namespace

bool canPreview(const Problem& problem, std::span<const Decision> underway) {
    return std::all_of(problem.pending.begin(), problem.pending.end(), isLink) &&
           std::all_of(underway.begin(), underway.end(), isLink) && problem.linkCount() + underway.size() > 0;
}

void preview(Problem& problem, std::span<const Decision> underway, const PreviewOptions& options,
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
            if (isLink(d)) {
                links.push_back(d.link);
            }
        }
    }
    orderLinks(problem);
    countLinks(problem);
    Sweeper sweeper(problem);
    for (int i = 0; i < options.mostSweeps; ++i) {
        problem.statistics.residual = sweeper.sweep();
        if (problem.statistics.residual <= options.residual) {
            break;
        }
    }
    if (options.ambient > 0.0) {
        fillUp(problem, options.ambient);
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
