#include "core/solve/known_pairs.h"

#include <algorithm>
#include <tuple>

namespace fluxwalk::solve {

namespace {

using hierarchy::Link;

bool comesBefore(const Link& x, const Link& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
}

bool isSame(const Link& x, const Link& y) {
    return x.a == y.a && x.b == y.b;
}

}  // namespace

void KnownPairs::takeIn(std::span<const Link> standing) {
    links_.insert(links_.end(), standing.begin(), standing.end());
    std::erase_if(links_, [](const Link& link) { return link.a == link.b; });
    std::sort(links_.begin(), links_.end(), comesBefore);
    links_.erase(std::unique(links_.begin(), links_.end(), isSame), links_.end());
    sorted_ = links_.size();
}

std::optional<Link> KnownPairs::find(NodeId a, NodeId b) const {
    Link wanted;
    wanted.a = a;
    wanted.b = b;
    const auto end = links_.begin() + static_cast<std::ptrdiff_t>(sorted_);
    const auto found = std::lower_bound(links_.begin(), end, wanted, comesBefore);
    return found != end && isSame(*found, wanted) ? std::optional(*found) : std::nullopt;
}

void KnownPairs::move(std::span<const NodeId> places) {
    for (Link& link : links_) {
        link.a = places[base::index(link.a)];
        link.b = places[base::index(link.b)];
    }
    std::erase_if(links_, [](const Link& link) { return link.a == NodeId::none || link.b == NodeId::none; });
    takeIn({});
}

}  // namespace fluxwalk::solve
