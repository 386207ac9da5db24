#include "core/solve/link_errors.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/solve/assess_link.h"

namespace fluxwalk::solve {

namespace {

/// Error of a link as power per scene area, or as irradiance by the oracle that ignores areas. Where samples
/// say nothing (ends that touch), all light that could pass.
float errorOf(const Problem& problem, const hierarchy::Link& link) {
    const float error = assessLink(problem, link).error;
    if (std::isfinite(error)) {
        return error;
    }
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const float radiosity =
        std::max(base::channelMean(h.light(link.a).radiosity), base::channelMean(h.light(link.b).radiosity));
    return link.coupling * radiosity / static_cast<float>(h.totalArea());
}

}  // namespace

std::vector<float> computeLinkErrors(Problem& problem) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const std::vector<hierarchy::Link>& links = problem.links.links;
    std::vector<float> errors(links.size(), 0.0f);
    constexpr std::size_t kGrain = 1024;
    problem.executor.forRange(links.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (links[i].a != links[i].b) {
                errors[i] = errorOf(problem, links[i]);
            }
        }
    });
    // Squares of what ends at each node, in the order of the links.
    std::vector<float> squares(h.nodeCount(), 0.0f);
    const auto add = [&](NodeId id, float error) { squares[base::index(id)] += error * error; };
    for (std::size_t i = 0; i < links.size(); ++i) {
        add(links[i].a, errors[i]);
        if (links[i].a != links[i].b) {
            add(links[i].b, errors[i]);
        }
    }
    std::vector<float> result(h.nodeCount(), 0.0f);
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId leaf{i};
        if (h.kind(leaf) != hierarchy::NodeKind::element || !h.isLeaf(leaf)) {
            continue;
        }
        float sum = 0.0f;
        for (NodeId id = leaf; id != NodeId::none; id = h.parent(id)) {
            sum += squares[base::index(id)];
        }
        result[i] = std::sqrt(sum);
    }
    return result;
}

}  // namespace fluxwalk::solve
