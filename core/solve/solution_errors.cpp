#include "core/solve/solution_errors.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/solve/link_errors.h"
#include "core/solve/probes.h"

namespace fluxwalk::solve {

namespace {

using hierarchy::NodeKind;

/// The share of reflected light in what is reflected again is held below this: closed white rooms would never
/// end.
constexpr double kMostReflected = 0.98;

// What one probe found, all of luminance.
struct Finding {
    double weight = 0.0;     ///< reflectance of its leaf; 0 where there is none
    double gathered = 0.0;   ///< lux
    double kept = 0.0;       ///< what the leaf was given, lux
    double reflected = 0.0;  ///< part of `gathered` that sources reflect, lux
    double within = 0.0;     ///< variance of the irradiance over the leaf, lux2
    double noise = 0.0;      ///< variance of `gathered` by its shadow rays, lux2
    double estimate = 0.0;   ///< the links' error at the leaf, lux
};

double luminanceOf(const Rgb& c) {
    return base::luminance(Vec3d(c));
}

Finding look(const Problem& problem, const Probe& probe, const std::vector<float>& linkErrors) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    Finding found;
    const auto leaf = findLeaf(problem, probe.object, probe.patch, probe.back, probe.uv);
    if (!leaf || h.shape(*leaf).exposedArea() <= 0.0f) {
        return found;
    }
    std::vector<GatheredSource> sources;
    const Rgb gathered = gatherAtPoint(problem, {*leaf, probe.position, probe.normal}, nullptr, &sources);
    const hierarchy::Light& light = h.light(*leaf);
    found.weight = luminanceOf(light.reflectance);
    found.gathered = luminanceOf(gathered);
    found.kept = luminanceOf(light.irradiance);
    found.estimate = static_cast<double>(linkErrors[base::index(*leaf)]);
    if (found.weight > 0.0) {
        const double s = luminanceOf(light.slopeS) / found.weight;
        const double t = luminanceOf(light.slopeT) / found.weight;
        found.within = (s * s + t * t) / 3.0;
    }
    for (const GatheredSource& source : sources) {
        found.reflected += luminanceOf(reflectedBy(problem, source.source)) * source.transfer;
        const double radiosity = luminanceOf(h.light(source.source).radiosity);
        found.noise += radiosity * radiosity * source.variance;
    }
    return found;
}

// Errors of inner nodes and clusters from their leaves', children after their parents in the order of ids
// being split, so that walking back meets children first.
void pullErrors(const hierarchy::Hierarchy& h, std::vector<float>& errors) {
    std::vector<NodeId> order;
    order.reserve(h.nodeCount());
    if (h.root() != NodeId::none) {
        order.push_back(h.root());
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (!h.isLeaf(order[i])) {
            for (unsigned c = 0; c < h.childCount(order[i]); ++c) {
                order.push_back(h.child(order[i], c));
            }
        }
    }
    for (std::size_t i = order.size(); i-- > 0;) {
        const NodeId id = order[i];
        if (h.isLeaf(id)) {
            continue;
        }
        float sum = 0.0f;
        float area = 0.0f;
        for (unsigned c = 0; c < h.childCount(id); ++c) {
            const float part = h.shape(h.child(id, c)).exposedArea();
            sum += part * errors[base::index(h.child(id, c))];
            area += part;
        }
        errors[base::index(id)] = area > 0.0f ? sum / area : 0.0f;
    }
}

}  // namespace

Rgb reflectedBy(const Problem& problem, NodeId source) {
    const NodeKind kind = problem.hierarchy.kind(source);
    if (kind == NodeKind::light || kind == NodeKind::sky) {
        return Rgb(0.0f);
    }
    const hierarchy::Light& light = problem.hierarchy.light(source);
    return glm::max(light.radiosity - light.emission, Rgb(0.0f));
}

SolutionErrors estimateSolutionErrors(const Problem& problem, std::size_t count) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    SolutionErrors result;
    result.ofNode = computeLinkErrors(problem);
    // Others than those with which the solver watches itself.
    const std::vector<Probe> probes = drawProbes(problem, count, problem.options.seed + 0x5e1f);
    std::vector<Finding> findings(probes.size());
    problem.executor.forRange(probes.size(), 2, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            findings[i] = look(problem, probes[i], result.ofNode);
        }
    });
    double sum = 0.0;
    double reflected = 0.0;
    double defect = 0.0;
    double squares = 0.0;
    double estimates = 0.0;
    for (const Finding& f : findings) {
        const double off = f.weight * (f.gathered - f.kept);
        sum += f.weight * f.gathered;
        reflected += f.weight * f.reflected;
        defect += off;
        const double w2 = f.weight * f.weight;
        squares += off * off - w2 * (f.within + f.noise);
        estimates += w2 * f.estimate * f.estimate;
    }
    if (!(sum > 0.0)) {
        return result;
    }
    const double relative = defect / sum;
    double spread = 0.0;
    for (const Finding& f : findings) {
        const double off = f.weight * (f.gathered - f.kept) - relative * f.weight * f.gathered;
        spread += off * off;
    }
    const double further = 1.0 - std::min(kMostReflected, reflected / sum);
    result.common = std::sqrt(relative * relative + spread / (sum * sum)) / further;
    const auto scale =
        static_cast<float>(estimates > 0.0 && squares > 0.0 ? std::sqrt(squares / estimates) / further : 0.0);
    for (float& error : result.ofNode) {
        error *= scale;
    }
    pullErrors(h, result.ofNode);
    return result;
}

}  // namespace fluxwalk::solve
