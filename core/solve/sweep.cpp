#include "core/solve/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/photometry.h"
#include "core/hierarchy/local_frame.h"
#include "core/solve/row_scaling.h"

namespace fluxwalk::solve {

namespace {

/// A block gathers through at least this many link ends, so that threads have work, but never through more
/// than an eighth of all, so that it stays Gauss-Seidel.
constexpr std::size_t kMinEnds = 2048;
constexpr std::size_t kMinBlocks = 8;
/// More blocks than this would only look at the same large clusters again.
constexpr std::size_t kMaxBlocks = 64;

}  // namespace

Sweeper::Sweeper(Problem& problem)
    : problem_(problem), clusters_(problem, problem.rowScale), kept_(limitRows(problem)) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    order_.reserve(h.nodeCount());
    std::vector<NodeId> stack;
    const std::size_t all = 2 * problem.links.links.size();
    const std::size_t most = std::min(std::max(kMinEnds, all / kMaxBlocks), all / kMinBlocks);
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
        ++block.endPatch;
        if (ends >= most) {
            block.end = order_.size();
            blocks_.push_back(block);
            block.begin = block.end;
            block.beginPatch = block.endPatch;
            ends = 0;
        }
    }
    block.end = order_.size();
    if (block.begin < block.end) {
        blocks_.push_back(block);
    }
    gathered_.resize(h.nodeCount());
}

double Sweeper::sweep() {
    const StageTimer timer(problem_.statistics.times.sweep);
    double change = 0.0;
    double power = 0.0;
    for (const Block& block : blocks_) {
        gather(block);
        pushPull(block, change, power);
        clusters_.refresh(block.beginPatch, block.endPatch);
    }
    problem_.hierarchy.pullClusters();
    ++problem_.statistics.counters.sweeps;
    return power > 0.0 ? change / power : 0.0;
}

void Sweeper::gather(const Block& block) {
    hierarchy::Hierarchy& h = problem_.hierarchy;
    const std::vector<hierarchy::Link>& links = problem_.links.links;
    const bool isScaled = problem_.rowScale.size() == h.nodeCount();
    if (!clusters_.isEmpty()) {
        fromClusters_.resize(block.endPatch - block.beginPatch);
        clusters_.gather(block.beginPatch, block.endPatch, fromClusters_);
    }
    problem_.executor.forRange(block.end - block.begin, 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const NodeId id = order_[block.begin + i];
            Vec3d sum(0.0);
            Rgb slopeS(0.0f);
            Rgb slopeT(0.0f);
            for (const std::uint32_t l : problem_.links.endingAt(id)) {
                const hierarchy::Link& link = links[l];
                const bool isA = link.a == id;
                const NodeId source = isA ? link.b : link.a;
                float transfer = link.transfer();
                if (h.kind(source) == hierarchy::NodeKind::cluster) {
                    const base::Vec2 here = (isA ? link.gradientA : link.gradientB).decode();
                    const Rgb power = clusters_.shownBy(l, source) * transfer;
                    sum += Vec3d(power);
                    slopeS += power * here.x;
                    slopeT += power * here.y;
                    continue;
                }
                if (isScaled) {
                    transfer *= problem_.rowScale[base::index(source)];
                }
                const base::Vec2 here = (isA ? link.gradientA : link.gradientB).decode();
                const base::Vec2 there = (isA ? link.gradientB : link.gradientA).decode();
                const hierarchy::LocalFrame& frame = hierarchy::localFrame(h.shape(source).cornerCount);
                // The kernel meets more of the source's light where both are larger.
                const base::Vec2 lean(frame.xx * there.x + frame.xy * there.y,
                                      frame.xy * there.x + frame.yy * there.y);
                const hierarchy::Light& light = h.light(source);
                const Rgb power =
                    (light.radiosity + light.slopeS * lean.x + light.slopeT * lean.y) * transfer;
                sum += Vec3d(power);
                slopeS += power * here.x;
                slopeT += power * here.y;
            }
            const double scale = isScaled ? static_cast<double>(problem_.rowScale[base::index(id)]) : 1.0;
            const auto area = static_cast<double>(h.shape(id).exposedArea());
            const double perArea = area > 0.0 ? scale / area : 0.0;
            LinearIrradiance& out = gathered_[base::index(id)];
            out.mean = Rgb(sum * perArea);
            out.s = slopeS * static_cast<float>(perArea);
            out.t = slopeT * static_cast<float>(perArea);
        }
    });
    if (!clusters_.isEmpty()) {
        for (std::size_t i = block.beginPatch; i < block.endPatch; ++i) {
            gathered_[base::index(h.patches()[i])].mean += fromClusters_[i - block.beginPatch];
        }
    }
}

// What child `child` takes over: the parent's linear function on its part, as far as that is exposed to
// what the parent meets. Offsets are taken from the
// children's mean by exposed area, so that the linear part moves no power.
Sweeper::LinearIrradiance Sweeper::inheritedBy(NodeId parent, unsigned child,
                                               const LinearIrradiance& from) const {
    const hierarchy::Hierarchy& h = problem_.hierarchy;
    using base::Vec2;
    const hierarchy::Shape& whole = h.shape(parent);
    const hierarchy::ChildFrame& frame = hierarchy::childFrame(whole.cornerCount, whole.split);
    Vec2 mean(0.0f);
    float area = 0.0f;
    for (unsigned c = 0; c < 4; ++c) {
        const float part = h.shape(h.child(parent, c)).areaInParent();
        mean += part * frame.middle(c);
        area += part;
    }
    const Vec2 offset = frame.middle(child) - (area > 0.0f ? mean / area : Vec2(0.0f));
    const float part = h.shape(h.child(parent, child)).partOfParent();
    const Vec2 scale = part * frame.scale(child);
    const Rgb value = part * (from.mean + offset.x * from.s + offset.y * from.t);
    return {value, scale.x * from.s, scale.y * from.t};
}

// Push moves irradiance down, pull takes means, by default by true exposed area: adjoint to each other in the
// means (ALGORITHMS 1.5, convention A).
void Sweeper::pushPull(const Block& block, double& change, double& power) {
    hierarchy::Hierarchy& h = problem_.hierarchy;
    for (std::size_t i = block.begin; i < block.end; ++i) {
        const NodeId id = order_[i];
        const NodeId parent = h.parent(id);
        const bool isPatch = parent == NodeId::none || h.kind(parent) == hierarchy::NodeKind::cluster;
        LinearIrradiance& own = gathered_[base::index(id)];
        if (!isPatch) {
            const unsigned child = base::index(id) - base::index(h.child(parent, 0));
            const LinearIrradiance from = inheritedBy(parent, child, gathered_[base::index(parent)]);
            own.mean += from.mean;
            own.s += from.s;
            own.t += from.t;
        }
        if (h.isLeaf(id)) {
            if (!kept_.empty()) {
                own.mean *= kept_[base::index(id)];
                own.s *= kept_[base::index(id)];
                own.t *= kept_[base::index(id)];
            }
            // Limited linear parts can still add up to a little less than nothing.
            h.light(id).irradiance = glm::max(own.mean, Rgb(0.0f));
        }
    }
    for (std::size_t i = block.end; i-- > block.begin;) {
        const NodeId id = order_[i];
        hierarchy::Light& light = h.light(id);
        if (h.isLeaf(id)) {
            const Rgb radiosity = light.emission + light.reflectance * light.irradiance;
            const auto area = static_cast<double>(h.shape(id).exposedArea());
            change += area * static_cast<double>(base::channelMean(glm::abs(radiosity - light.radiosity)));
            power += area * static_cast<double>(base::channelMean(radiosity));
            light.radiosity = radiosity;
            light.slopeS = light.reflectance * gathered_[base::index(id)].s;
            light.slopeT = light.reflectance * gathered_[base::index(id)].t;
        } else {
            pull(id);
        }
    }
}

// What a child counts in its parent's radiosity: its area in the parent, or (Schaefer, section 1) that area
// projected on the parent's normal; by area again where no child shows itself in that direction.
std::array<double, 4> Sweeper::pullWeights(NodeId id) const {
    const hierarchy::Hierarchy& h = problem_.hierarchy;
    std::array<double, 4> areas{};
    std::array<double, 4> projected{};
    double sum = 0.0;
    for (unsigned c = 0; c < 4; ++c) {
        const hierarchy::Shape& part = h.shape(h.child(id, c));
        areas[c] = static_cast<double>(part.areaInParent());
        projected[c] = areas[c] * std::max(0.0, static_cast<double>(glm::dot(part.axis, h.shape(id).axis)));
        sum += projected[c];
    }
    return problem_.options.pullRule == PullRule::projected && sum > 0.0 ? projected : areas;
}

// Means by exposed area or as the options say; slopes by projection of the children's linear functions onto
// one over the whole.
void Sweeper::pull(NodeId id) {
    hierarchy::Hierarchy& h = problem_.hierarchy;
    hierarchy::Light& light = h.light(id);
    const hierarchy::Shape& whole = h.shape(id);
    const hierarchy::LocalFrame& frame = hierarchy::localFrame(whole.cornerCount);
    const hierarchy::ChildFrame& children = hierarchy::childFrame(whole.cornerCount, whole.split);
    Vec3d radiosity(0.0);
    Vec3d irradiance(0.0);
    double area = 0.0;
    double weight = 0.0;
    const std::array<double, 4> weights = pullWeights(id);
    for (unsigned c = 0; c < 4; ++c) {
        const NodeId child = h.child(id, c);
        const auto part = static_cast<double>(h.shape(child).areaInParent());
        radiosity += weights[c] * Vec3d(h.light(child).radiosity);
        weight += weights[c];
        irradiance += part * Vec3d(h.light(child).irradiance);
        area += part;
    }
    if (area <= 0.0) {
        light.radiosity = light.irradiance = light.slopeS = light.slopeT = Rgb(0.0f);
        light.residual = 0.0f;
        return;
    }
    light.radiosity = Rgb(radiosity / weight);
    light.irradiance = Rgb(irradiance / area);
    Rgb momentX(0.0f);
    Rgb momentY(0.0f);
    Rgb innerS(0.0f);
    Rgb innerT(0.0f);
    for (unsigned c = 0; c < 4; ++c) {
        const hierarchy::Light& part = h.light(h.child(id, c));
        // Hidden children show nothing: they count as the mean.
        const Rgb rise =
            h.shape(h.child(id, c)).areaInParent() > 0.0f ? part.radiosity - light.radiosity : Rgb(0.0f);
        momentX += 0.25f * children.middle(c).x * rise;
        momentY += 0.25f * children.middle(c).y * rise;
        innerS += 0.25f * children.scale(c).x * part.slopeS;
        innerT += 0.25f * children.scale(c).y * part.slopeT;
    }
    const float determinant = frame.xx * frame.yy - frame.xy * frame.xy;
    light.slopeS = innerS + (frame.yy * momentX - frame.xy * momentY) / determinant;
    light.slopeT = innerT + (frame.xx * momentY - frame.xy * momentX) / determinant;
    light.residual = 0.0f;
    for (unsigned c = 0; c < 4; ++c) {
        const NodeId child = h.child(id, c);
        if (h.shape(child).areaInParent() <= 0.0f) {
            continue;
        }
        const Rgb linear =
            light.radiosity + children.middle(c).x * light.slopeS + children.middle(c).y * light.slopeT;
        const float off = std::abs(base::channelMean(h.light(child).radiosity - linear));
        light.residual = std::max(light.residual, off + (h.isLeaf(child) ? 0.0f : h.light(child).residual));
    }
    for (unsigned c = 0; c < 4; ++c) {
        // A leaf's own deviation is not resolved: a smooth function's falls with the square of the size.
        if (h.isLeaf(h.child(id, c))) {
            h.light(h.child(id, c)).residual = 0.25f * light.residual;
        }
    }
}

}  // namespace fluxwalk::solve
