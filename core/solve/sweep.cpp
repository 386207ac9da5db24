#include "core/solve/sweep.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"

namespace fluxwalk::solve {

namespace {

/// A block gathers through at least this many link ends, so that threads have work, but never through more than an eighth of all,
/// so that it stays Gauss-Seidel.
constexpr std::size_t kMinEnds = 2048;
constexpr std::size_t kMinBlocks = 8;

}  // namespace

Sweeper::Sweeper(Problem& problem) : problem_(problem) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    order_.reserve(h.nodeCount());
    std::vector<NodeId> stack;
    const std::size_t most = std::min(kMinEnds, 2 * problem.links.links.size() / kMinBlocks);
    Block block;
    std::size_t ends = 0;
    for (const NodeId patch : h.patches()) {
        stack.push_back(patch);
        while (!stack.empty()) {
            const NodeId id = stack.back();
            stack.pop_back();
            order_.push_back(id);
            ends += problem.links.endingAt(id).size();
            if (!h.isLeaf(id)) {
                for (unsigned c = 4; c-- > 0;) {
                    stack.push_back(h.child(id, c));
                }
            }
        }
        if (ends >= most) {
            block.end = order_.size();
            blocks_.push_back(block);
            block.begin = block.end;
            ends = 0;
        }
    }
    block.end = order_.size();
    if (block.begin < block.end) {
        blocks_.push_back(block);
    }
    lowest_.resize(h.nodeCount());
    highest_.resize(h.nodeCount());
}

double Sweeper::sweep() {
    const StageTimer timer(problem_.statistics.times.sweep);
    double change = 0.0;
    double power = 0.0;
    for (const Block& block : blocks_) {
        gather(block);
        pushPull(block, change, power);
    }
    ++problem_.statistics.counters.sweeps;
    return power > 0.0 ? change / power : 0.0;
}

void Sweeper::pushPull() {
    double change = 0.0;
    double power = 0.0;
    for (const Block& block : blocks_) {
        pushPull(block, change, power);
    }
}

void Sweeper::gather(const Block& block) {
    hierarchy::Hierarchy& h = problem_.hierarchy;
    const std::vector<hierarchy::Link>& links = problem_.links.links;
    const bool isScaled = problem_.rowScale.size() == h.nodeCount();
    problem_.executor.forRange(block.end - block.begin, 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const NodeId id = order_[block.begin + i];
            Vec3d sum(0.0);
            for (const std::uint32_t l : problem_.links.endingAt(id)) {
                const hierarchy::Link& link = links[l];
                const NodeId source = link.a == id ? link.b : link.a;
                float transfer = link.transfer() * h.shape(source).exposed;
                if (isScaled) {
                    transfer *= problem_.rowScale[base::index(source)];
                }
                sum += Vec3d(h.light(source).radiosity) * static_cast<double>(transfer);
            }
            const double scale = isScaled ? static_cast<double>(problem_.rowScale[base::index(id)]) : 1.0;
            h.light(id).gathered = Rgb(sum * (scale / static_cast<double>(h.shape(id).area)));
        }
    });
}

// Push moves irradiance down unchanged, pull takes means by true exposed area: adjoint to each other (ALGORITHMS 1.5, convention A).
void Sweeper::pushPull(const Block& block, double& change, double& power) {
    hierarchy::Hierarchy& h = problem_.hierarchy;
    for (std::size_t i = block.begin; i < block.end; ++i) {
        const NodeId id = order_[i];
        const NodeId parent = h.parent(id);
        const bool isPatch = parent == NodeId::none || h.kind(parent) == hierarchy::NodeKind::cluster;
        hierarchy::Light& light = h.light(id);
        light.irradiance = light.gathered + (isPatch ? Rgb(0.0f) : h.light(parent).irradiance);
    }
    for (std::size_t i = block.end; i-- > block.begin;) {
        const NodeId id = order_[i];
        const std::size_t slot = base::index(id);
        hierarchy::Light& light = h.light(id);
        if (h.isLeaf(id)) {
            const Rgb radiosity = light.emission + light.reflectance * light.irradiance;
            const double area = static_cast<double>(h.shape(id).exposedArea());
            change += area * static_cast<double>(base::channelMean(glm::abs(radiosity - light.radiosity)));
            power += area * static_cast<double>(base::channelMean(radiosity));
            light.radiosity = radiosity;
            lowest_[slot] = highest_[slot] = base::channelMean(radiosity);
            continue;
        }
        Vec3d radiosity(0.0);
        Vec3d irradiance(0.0);
        double area = 0.0;
        float lowest = INFINITY;
        float highest = 0.0f;
        for (unsigned c = 0; c < 4; ++c) {
            const NodeId child = h.child(id, c);
            const double part = static_cast<double>(h.shape(child).exposedArea());
            if (part <= 0.0) {
                continue;
            }
            radiosity += part * Vec3d(h.light(child).radiosity);
            irradiance += part * Vec3d(h.light(child).irradiance);
            area += part;
            lowest = std::min(lowest, lowest_[base::index(child)]);
            highest = std::max(highest, highest_[base::index(child)]);
        }
        if (area <= 0.0) {
            lowest = 0.0f;
            area = 1.0;
        }
        light.radiosity = Rgb(radiosity / area);
        light.irradiance = Rgb(irradiance / area);
        light.spread = 0.5f * (highest - lowest);
        lowest_[slot] = lowest;
        highest_[slot] = highest;
        for (unsigned c = 0; c < 4; ++c) {
            // A leaf's own range is not resolved: about half of what its family shows.
            const NodeId child = h.child(id, c);
            if (h.isLeaf(child)) {
                h.light(child).spread = 0.5f * light.spread;
            }
        }
    }
}

}  // namespace fluxwalk::solve
