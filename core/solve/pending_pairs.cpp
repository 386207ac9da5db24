#include "core/solve/pending_pairs.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace fluxwalk::solve {

namespace {

using base::NodeId;
using hierarchy::Hierarchy;
using hierarchy::NodeKind;
using transport::Query;

/// Pairs that are split at once, at most: between two waves a solve can be stopped.
constexpr std::size_t kWave = 65536;
/// A budget is far where everything pending could be split into this many times more.
constexpr std::uint64_t kFar = 4;
/// Near it, a wave takes no more than one part in this many of the room, and nothing better than this part
/// of the worst, so that the parts of what is worst now compete with what comes next.
constexpr std::uint64_t kNear = 2;
constexpr float kClass = 0.5f;

bool needsChildren(const Hierarchy& h, NodeId id) {
    return h.isLeaf(id) && h.kind(id) == NodeKind::element;
}

NodeId splitEnd(const Decision& d) {
    return d.verdict == Verdict::splitB ? d.link.b : d.link.a;
}

/// Adds up what splitting takes; nodes that several pairs split count once.
class Growth {
  public:
    explicit Growth(const Hierarchy& h) : h_(h), isCounted_(h.nodeCount(), 0) {}

    void add(const Decision& d) {
        const NodeId id = splitEnd(d);
        links += countParts(h_, d) - 1;
        if (needsChildren(h_, id) && isCounted_[base::index(id)] == 0) {
            isCounted_[base::index(id)] = 1;
            nodes += 4;
        }
    }

    std::uint64_t nodes = 0;
    std::uint64_t links = 0;

  private:
    const Hierarchy& h_;
    std::vector<std::uint8_t> isCounted_;
};

// Moves the marked ones out, in their order.
std::vector<Decision> extract(std::vector<Decision>& pending, const std::vector<std::uint8_t>& isTaken) {
    std::vector<Decision> taken;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pending.size(); ++i) {
        if (isTaken[i] != 0) {
            taken.push_back(pending[i]);
        } else {
            pending[kept++] = pending[i];
        }
    }
    pending.resize(kept);
    return taken;
}

// The places of the kWave largest errors, the largest first.
std::vector<std::uint32_t> findWorst(const std::vector<Decision>& pending, const Hierarchy& h) {
    std::vector<std::uint32_t> order(pending.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    const auto isWorse = [&](std::uint32_t i, std::uint32_t k) {
        const Decision& x = pending[i];
        const Decision& y = pending[k];
        if (x.error != y.error) {
            return x.error > y.error;
        }
        return std::tuple(h.key(x.link.a), h.key(x.link.b), i) <
               std::tuple(h.key(y.link.a), h.key(y.link.b), k);
    };
    const std::size_t count = std::min(kWave, order.size());
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(count);
    if (end != order.end()) {
        std::nth_element(order.begin(), end, order.end(), isWorse);
        order.resize(count);
    }
    std::sort(order.begin(), order.end(), isWorse);
    return order;
}

// Sources without area stand second; otherwise the order of the keys makes the pair independent of how it
// was reached.
Query ordered(const Hierarchy& h, NodeId a, NodeId b, bool open) {
    const auto isSource = [&h](NodeId id) {
        return h.kind(id) == NodeKind::light || h.kind(id) == NodeKind::sky;
    };
    if (isSource(a) != isSource(b)) {
        return isSource(a) ? Query{b, a, open} : Query{a, b, open};
    }
    return h.key(a) <= h.key(b) ? Query{a, b, open} : Query{b, a, open};
}

}  // namespace

std::vector<Decision> takeNext(std::vector<Decision>& pending, const Hierarchy& h, const Budget& budget,
                               std::size_t standing) {
    const std::uint64_t nodes = h.nodeCount();
    const std::uint64_t links = standing + pending.size();
    Growth all(h);
    for (const Decision& d : pending) {
        all.add(d);
    }
    const bool isFar = budget.holds(nodes + kFar * all.nodes, links + kFar * all.links);
    if (isFar && pending.size() <= kWave) {
        return std::exchange(pending, {});
    }
    std::vector<std::uint8_t> isTaken(pending.size(), 0);
    Growth growth(h);
    std::size_t taken = 0;
    for (std::size_t i = 0; i < pending.size() && taken < kWave; ++i) {
        if (!pending[i].canStand()) {
            isTaken[i] = 1;
            growth.add(pending[i]);
            ++taken;
        }
    }
    if (taken > 0) {
        budget.require(nodes + growth.nodes, links + growth.links);
        return extract(pending, isTaken);
    }
    const std::vector<std::uint32_t> worst = findWorst(pending, h);
    for (const std::uint32_t i : worst) {
        growth.add(pending[i]);
        if (!isFar && pending[i].error < kClass * pending[worst.front()].error) {
            break;
        }
        if (!isFar && !budget.holds(nodes + kNear * growth.nodes, links + kNear * growth.links)) {
            break;
        }
        isTaken[i] = 1;
    }
    return extract(pending, isTaken);
}

std::size_t countParts(const Hierarchy& h, const Decision& d) {
    const std::size_t n = h.childCount(splitEnd(d));
    return d.verdict == Verdict::splitSelf ? n * (n + 1) / 2 : n;
}

std::vector<Query> openPairs(Hierarchy& h, const base::Executor& executor,
                             const std::vector<Decision>& opened) {
    std::vector<NodeId> leaves;
    for (const Decision& d : opened) {
        if (needsChildren(h, splitEnd(d))) {
            leaves.push_back(splitEnd(d));
        }
    }
    std::sort(leaves.begin(), leaves.end());
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    h.split(leaves, executor);

    std::vector<Query> next;
    next.reserve(opened.size() * 4);
    for (const Decision& d : opened) {
        const bool open = d.link.isOpen();
        const NodeId from = splitEnd(d);
        const unsigned n = h.childCount(from);
        if (d.verdict == Verdict::splitSelf) {
            for (unsigned i = 0; i < n; ++i) {
                for (unsigned j = i; j < n; ++j) {
                    next.push_back(ordered(h, h.child(from, i), h.child(from, j), open));
                }
            }
            continue;
        }
        const NodeId other = d.verdict == Verdict::splitA ? d.link.b : d.link.a;
        for (unsigned i = 0; i < n; ++i) {
            next.push_back(ordered(h, h.child(from, i), other, open));
        }
    }
    return next;
}

}  // namespace fluxwalk::solve
