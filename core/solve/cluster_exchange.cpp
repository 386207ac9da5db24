#include "core/solve/cluster_exchange.h"

#include <algorithm>

#include "core/hierarchy/local_frame.h"

namespace fluxwalk::solve {

namespace {

using hierarchy::Hierarchy;
using hierarchy::Link;
using hierarchy::NodeKind;

using transport::kPatchRun;

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
    const bool isIsotropic = problem.options.clusterModel == ClusterModel::isotropic;
    views_.resize(isIsotropic ? 0 : count);
    means_.resize(isIsotropic ? h.nodeCount() : 0);
    stamp_.assign(h.nodeCount(), 0);
    first_.assign(h.nodeCount(), 0);
    problem.executor.forRange(views_.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Link& link = problem.links.links[i];
            const auto view = [&h](NodeId id, NodeId other) -> View {
                if (h.kind(id) != NodeKind::cluster) {
                    return {};
                }
                const transport::Ball ball = transport::findBall(h, id, other);
                return {ball, transport::sumShares(h, id, ball)};
            };
            views_[i] = {view(link.a, link.b), view(link.b, link.a)};
        }
    });
    for (std::vector<float>& channel : radiosity_) {
        channel.resize(h.patches().size());
    }
    refresh(0, h.patches().size());
}

void ClusterExchange::refresh(std::size_t begin, std::size_t end) {
    if (isEmpty()) {
        return;
    }
    for (std::size_t i = begin; i < end; ++i) {
        const NodeId patch = problem_.hierarchy.patches()[i];
        const Rgb shown =
            (isUniform_ ? Rgb(1.0f) : problem_.hierarchy.light(patch).radiosity) * scaleOf(patch);
        radiosity_[0][i] = shown.r;
        radiosity_[1][i] = shown.g;
        radiosity_[2][i] = shown.b;
    }
    if (!means_.empty()) {
        refreshMeans(problem_.hierarchy.root(), begin, end);
    }
}

// Means of a cluster and what is below it, as far as patches[begin, end) changed.
void ClusterExchange::refreshMeans(NodeId id, std::size_t begin, std::size_t end) {
    const Hierarchy& h = problem_.hierarchy;
    const std::size_t first = h.firstPatchBelow(id);
    if (first >= end || first + h.patchesBelow(id).size() <= begin) {
        return;
    }
    Rgb& mean = means_[base::index(id)];
    if (h.kind(id) != NodeKind::cluster) {
        mean = Rgb(radiosity_[0][first], radiosity_[1][first], radiosity_[2][first]);
        return;
    }
    mean = Rgb(0.0f);
    float all = 0.0f;
    for (unsigned c = 0; c < 2; ++c) {
        const NodeId child = h.child(id, c);
        refreshMeans(child, begin, end);
        const float area = h.shape(child).ownArea();
        mean += area * means_[base::index(child)];
        all += area;
    }
    mean = all > 0.0f ? mean / all : Rgb(0.0f);
}

const ClusterExchange::View& ClusterExchange::viewFrom(std::size_t link, NodeId id) const {
    return views_[link][problem_.links.links[link].a == id ? 0 : 1];
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
    if (!means_.empty()) {
        return means_[base::index(id)];
    }
    const View& view = viewFrom(link, id);
    const hierarchy::PatchTable& table = h.patchTable();
    const std::size_t first = h.firstPatchBelow(id);
    const std::size_t end = first + h.patchesBelow(id).size();
    const float all = view.shares > 0.0f ? view.shares : h.shape(id).ownArea();
    if (!(all > 0.0f)) {
        return Rgb(0.0f);
    }
    if (view.shares > 0.0f) {
        return Rgb(transport::sumShared(table, first, end, view.other,
                                        {radiosity_[0], radiosity_[1], radiosity_[2]}) /
                   static_cast<double>(all));
    }
    Vec3d sum(0.0);
    for (std::size_t i = first; i < end; ++i) {
        sum +=
            static_cast<double>(table.area[i]) * Vec3d(radiosity_[0][i], radiosity_[1][i], radiosity_[2][i]);
    }
    return Rgb(sum / static_cast<double>(all));
}

ClusterExchange::Incoming ClusterExchange::bring(NodeId cluster, std::size_t link) const {
    const Hierarchy& h = problem_.hierarchy;
    const Link& l = problem_.links.links[link];
    const NodeId source = otherEnd(l, cluster);
    // Linear ends may show a little less than nothing.
    const Rgb shown = glm::max(shownBy(link, source), Rgb(0.0f));
    const Rgb power = l.transfer() * shown;
    if (means_.empty()) {
        if (const View& view = viewFrom(link, cluster); view.shares > 0.0f) {
            return {view.other, false, power / view.shares, shown};
        }
    }
    const float area = h.shape(cluster).ownArea();
    return {{}, true, area > 0.0f ? power / area : Rgb(0.0f), shown};
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
    problem_.executor.forRange(end - begin, kPatchRun, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; i += kPatchRun) {
            const std::size_t count = std::min(kPatchRun, last - i);
            share(begin + i, begin + i + count, out.subspan(i, count));
        }
    });
}

// Adds what the clusters above patches[begin, end), at most kPatchRun of them, share out.
void ClusterExchange::share(std::size_t begin, std::size_t end, std::span<Rgb> out) const {
    const Hierarchy& h = problem_.hierarchy;
    transport::RunSums sums{};
    for (std::size_t i = begin; i < end; ++i) {
        // Each cluster once, at its first patch here.
        for (NodeId id = h.parent(h.patches()[i]);
             id != NodeId::none && (i == begin || h.firstPatchBelow(id) == i); id = h.parent(id)) {
            const std::size_t last = std::min(end, h.firstPatchBelow(id) + h.patchesBelow(id).size());
            const std::size_t place = i - begin;
            Rgb even(0.0f);
            for (std::size_t k = 0; k < problem_.links.endingAt(id).size(); ++k) {
                const Incoming& in = incoming_[first_[base::index(id)] + k];
                if (!in.isEven) {
                    transport::addShared(h.patchTable(), i, last - i, in.source, in.flux, in.most, sums,
                                         place);
                } else {
                    even += glm::min(in.flux, in.most);
                }
            }
            for (std::size_t c = 0; c < 3; ++c) {
                for (std::size_t p = place; p < last - begin; ++p) {
                    sums[c][p] += even[static_cast<int>(c)];
                }
            }
        }
    }
    for (std::size_t i = 0; i < end - begin; ++i) {
        out[i] = Rgb(sums[0][i], sums[1][i], sums[2][i]) * scaleOf(h.patches()[begin + i]);
    }
}

}  // namespace fluxwalk::solve
