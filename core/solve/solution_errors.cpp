#include "core/solve/solution_errors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/solve/probes.h"
#include "core/transport/element_sampler.h"

namespace fluxwalk::solve {

namespace {

using hierarchy::NodeKind;

/// The share of reflected light in what is reflected again is held below this: closed white rooms would never
/// end.
constexpr double kMostReflected = 0.98;

// What two points of one leaf found, all of luminance.
struct Finding {
    double weight = 0.0;     ///< reflectance of the leaf; 0 where there is none
    double gathered = 0.0;   ///< mean of the two, lux
    double reflected = 0.0;  ///< part of that which sources reflect, lux
    /// By how much the two are above what the leaf was given, lux.
    std::array<double, 2> defects{};
    double pattern = 0.0;  ///< errorPattern() of the leaf, lux
};

double luminanceOf(const Rgb& c) {
    return base::luminance(Vec3d(c));
}

// Up to a factor, how wrong the irradiance of a leaf is: the geometric mean of what it is and of how far it
// varies over the leaf. (The links' errors, link_errors.h, say less: in a dark room behind a lit one they are
// as large as in that. Variation alone is too small on leaves that are wrong as a whole.)
double errorPattern(const Problem& problem, NodeId leaf) {
    const hierarchy::Light& light = problem.hierarchy.light(leaf);
    const double reflectance = static_cast<double>(base::channelMean(light.reflectance));
    const double range = reflectance > 0.0 ? static_cast<double>(light.range()) / reflectance : 0.0;
    return std::sqrt(range * luminanceOf(light.irradiance));
}

Finding look(const Problem& problem, const Probe& probe, std::uint64_t key) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    Finding found;
    const auto leaf = findLeaf(problem, probe.object, probe.patch, probe.back, probe.uv);
    if (!leaf || h.shape(*leaf).exposedArea() <= 0.0f) {
        return found;
    }
    const hierarchy::Light& light = h.light(*leaf);
    found.weight = luminanceOf(light.reflectance);
    found.pattern = errorPattern(problem, *leaf);
    const transport::ElementSampler sampler(h, *leaf);
    base::RandomStream random(key);
    std::vector<GatheredSource> sources;
    for (double& defect : found.defects) {
        const transport::SurfaceSample at = sampler.inExposed(random.next2());
        sources.clear();
        const double gathered =
            luminanceOf(gatherAtPoint(problem, {*leaf, at.position, at.normal}, nullptr, &sources));
        const double share = at.measure / sampler.meanMeasure();
        defect = share * gathered - luminanceOf(light.irradiance);
        found.gathered += 0.5 * share * gathered;
        for (const GatheredSource& source : sources) {
            found.reflected +=
                0.5 * share * luminanceOf(reflectedBy(problem, source.source)) * source.transfer;
        }
    }
    return found;
}

// Errors of inner nodes and clusters, from those of their leaves.
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
    result.ofNode.assign(h.nodeCount(), 0.0f);
    // Others than those with which the solver watches itself.
    const std::uint64_t seed = base::combine(problem.options.seed, 0x5e1f);
    const std::vector<Probe> probes = drawProbes(problem, count, seed);
    std::vector<Finding> findings(probes.size());
    problem.executor.forRange(probes.size(), 2, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            findings[i] = look(problem, probes[i], base::combine(seed, i));
        }
    });
    double sum = 0.0;
    double reflected = 0.0;
    double defect = 0.0;
    double squares = 0.0;
    double patterns = 0.0;
    for (const Finding& f : findings) {
        const double w2 = f.weight * f.weight;
        sum += f.weight * f.gathered;
        reflected += f.weight * f.reflected;
        defect += 0.5 * f.weight * (f.defects[0] + f.defects[1]);
        // How the light varies over a leaf, and the noise of gathering it, cancel in the product of two.
        squares += w2 * f.defects[0] * f.defects[1];
        patterns += w2 * f.pattern * f.pattern;
    }
    if (!(sum > 0.0)) {
        return result;
    }
    const double relative = defect / sum;
    double spread = 0.0;
    for (const Finding& f : findings) {
        const double off = f.weight * (0.5 * (f.defects[0] + f.defects[1]) - relative * f.gathered);
        spread += off * off;
    }
    const double further = 1.0 - std::min(kMostReflected, reflected / sum);
    result.defect = relative / further;
    result.defectError = std::sqrt(spread) / sum / further;
    const double scale = patterns > 0.0 && squares > 0.0 ? std::sqrt(squares / patterns) : 0.0;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        if (h.kind(NodeId{i}) == NodeKind::element && h.isLeaf(NodeId{i})) {
            result.ofNode[i] = static_cast<float>(scale * errorPattern(problem, NodeId{i}));
        }
    }
    pullErrors(h, result.ofNode);
    return result;
}

}  // namespace fluxwalk::solve
