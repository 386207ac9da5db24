#include "core/solve/cluster_exchange.h"

#include "core/hierarchy/local_frame.h"
#include "core/transport/cluster_factor.h"

namespace fluxwalk::solve {

namespace {

using hierarchy::Hierarchy;
using hierarchy::Link;
using hierarchy::NodeKind;

NodeId otherEnd(const Link& link, NodeId id) {
    return link.a == id ? link.b : link.a;
}

}  // namespace

ClusterExchange::ClusterExchange(const Problem& problem, const std::vector<float>& scale, bool isUniform)
    : problem_(problem), scale_(scale), isUniform_(isUniform) {
    const Hierarchy& h = problem.hierarchy;
    const std::size_t count = problem.links.clusterLinks;
    if (count == 0) {
        return;
    }
    shares_.resize(count);
    stamp_.assign(h.nodeCount(), 0);
    first_.assign(h.nodeCount(), 0);
    problem.executor.forRange(count, 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Link& link = problem.links.links[i];
            const auto sum = [&](NodeId id, NodeId other) {
                return h.kind(id) == NodeKind::cluster ? transport::sumShares(h, id, h.shape(other)) : 0.0f;
            };
            shares_[i] = {sum(link.a, link.b), sum(link.b, link.a)};
        }
    });
}

float ClusterExchange::sumOfShares(std::size_t link, NodeId id) const {
    return shares_[link][problem_.links.links[link].a == id ? 0 : 1];
}

Rgb ClusterExchange::shownBy(std::size_t link, NodeId id) const {
    const Hierarchy& h = problem_.hierarchy;
    if (h.kind(id) != NodeKind::cluster) {
        if (isUniform_) {
            return Rgb(scaleOf(id));
        }
        // The kernel meets more of an element's light where both are larger, as in Sweeper::gather().
        const Link& l = problem_.links.links[link];
        const base::Vec2 there = (l.a == id ? l.gradientA : l.gradientB).decode();
        const hierarchy::LocalFrame& frame = hierarchy::localFrame(h.shape(id).cornerCount);
        const hierarchy::Light& light = h.light(id);
        const float s = frame.xx * there.x + frame.xy * there.y;
        const float t = frame.xy * there.x + frame.yy * there.y;
        return (light.radiosity + light.slopeS * s + light.slopeT * t) * scaleOf(id);
    }
    const float shares = sumOfShares(link, id);
    const hierarchy::Shape& other = h.shape(otherEnd(problem_.links.links[link], id));
    Vec3d sum(0.0);
    double all = 0.0;
    for (const NodeId patch : h.patchesBelow(id)) {
        const hierarchy::Shape& shape = h.shape(patch);
        const float share =
            shape.exposedArea() * (shares > 0.0f ? transport::patchShare(shape, other) : 1.0f);
        if (share > 0.0f) {
            const Rgb radiosity = isUniform_ ? Rgb(1.0f) : h.light(patch).radiosity;
            sum += static_cast<double>(share * scaleOf(patch)) * Vec3d(radiosity);
            all += static_cast<double>(share);
        }
    }
    return all > 0.0 ? Rgb(sum / all) : Rgb(0.0f);
}

ClusterExchange::Incoming ClusterExchange::bring(NodeId cluster, std::size_t link) const {
    const Hierarchy& h = problem_.hierarchy;
    const Link& l = problem_.links.links[link];
    const NodeId source = otherEnd(l, cluster);
    const hierarchy::Shape& shape = h.shape(source);
    const float shares = sumOfShares(link, cluster);
    const Rgb power = l.transfer() * shownBy(link, source);
    if (shares > 0.0f) {
        return {shape.center, shape.radius, power / shares};
    }
    const float area = h.shape(cluster).exposedArea();
    return {shape.center, -1.0f, area > 0.0f ? power / area : Rgb(0.0f)};
}

void ClusterExchange::gather(std::size_t begin, std::size_t end, std::span<Rgb> out) {
    const Hierarchy& h = problem_.hierarchy;
    const std::span<const NodeId> patches = h.patches();
    ++calls_;
    wanted_.clear();
    for (std::size_t i = begin; i < end; ++i) {
        for (NodeId id = h.parent(patches[i]); id != NodeId::none && stamp_[base::index(id)] != calls_;
             id = h.parent(id)) {
            stamp_[base::index(id)] = calls_;
            first_[base::index(id)] = static_cast<std::uint32_t>(wanted_.size());
            for (const std::uint32_t link : problem_.links.endingAt(id)) {
                wanted_.emplace_back(id, link);
            }
        }
    }
    incoming_.resize(wanted_.size());
    problem_.executor.forRange(wanted_.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            incoming_[i] = bring(wanted_[i].first, wanted_[i].second);
        }
    });
    problem_.executor.forRange(end - begin, 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const NodeId patch = patches[begin + i];
            const hierarchy::Shape& shape = h.shape(patch);
            Vec3d sum(0.0);
            for (NodeId id = h.parent(patch); id != NodeId::none; id = h.parent(id)) {
                const std::size_t count = problem_.links.endingAt(id).size();
                for (std::size_t k = 0; k < count; ++k) {
                    const Incoming& in = incoming_[first_[base::index(id)] + k];
                    const float share = in.radius < 0.0f ? 1.0f
                                                         : transport::patchShare(shape.center, shape.axis,
                                                                                 in.center, in.radius);
                    sum += Vec3d(share * in.flux);
                }
            }
            out[i] = Rgb(sum) * scaleOf(patch);
        }
    });
}

}  // namespace fluxwalk::solve
