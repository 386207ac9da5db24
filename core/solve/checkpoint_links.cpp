#include <cmath>

#include "core/solve/checkpoint_nodes.h"

namespace fluxwalk::solve {

namespace {

using base::ArrayReader;
using base::NamedArrays;
using hierarchy::GradientCode;
using hierarchy::Hierarchy;
using hierarchy::Link;
using hierarchy::NodeKind;

const std::string kLinks = "links/";
const std::string kPending = "pending/";

template <class T>
std::vector<T> column(const std::vector<Link>& links, T (*get)(const Link&)) {
    std::vector<T> values;
    values.reserve(links.size());
    for (const Link& link : links) {
        values.push_back(get(link));
    }
    return values;
}

std::vector<std::int8_t> gradients(const std::vector<Link>& links, GradientCode Link::*end) {
    std::vector<std::int8_t> values;
    values.reserve(2 * links.size());
    for (const Link& link : links) {
        values.push_back((link.*end).s);
        values.push_back((link.*end).t);
    }
    return values;
}

bool isSurface(const Hierarchy& h, NodeId id) {
    return h.kind(id) == NodeKind::element || h.kind(id) == NodeKind::cluster;
}

bool hasCluster(const Hierarchy& h, const Link& link) {
    return h.kind(link.a) == NodeKind::cluster || h.kind(link.b) == NodeKind::cluster;
}

// What refinement makes: sources without area stand second and with elements alone; only elements see
// themselves.
bool isPossible(const Hierarchy& h, const Link& link) {
    const bool isPair = isSurface(h, link.a) && isSurface(h, link.b);
    const bool isSourceLink = h.kind(link.a) == NodeKind::element && !isSurface(h, link.b);
    return (isPair || isSourceLink) && (link.a != link.b || h.kind(link.a) == NodeKind::element) &&
           std::isfinite(link.coupling);
}

// Whether refinement can have this pair still to split.
bool canBePending(const Hierarchy& h, const Decision& d) {
    const bool isSelf = d.link.a == d.link.b;
    const bool isSplit =
        d.verdict == Verdict::splitA || d.verdict == Verdict::splitB || d.verdict == Verdict::splitSelf;
    if (!isSplit || isSelf != (d.verdict == Verdict::splitSelf) || std::isnan(d.error) ||
        !isSurface(h, d.link.a) || !std::isfinite(d.link.coupling)) {
        return false;
    }
    const NodeId end = d.verdict == Verdict::splitB ? d.link.b : d.link.a;
    return isSurface(h, end) && h.canSplit(end, 0.0) && (!d.canStand() || isPossible(h, d.link));
}

void saveAll(NamedArrays& arrays, const std::string& group, const std::vector<Link>& links) {
    const auto add = [&](const char* name, auto values, std::uint32_t columns = 1, const char* unit = "") {
        arrays.arrays.push_back({group + name, std::move(values), columns, unit});
    };
    add("a", column<std::uint32_t>(links, [](const Link& l) { return base::index(l.a); }));
    add("b", column<std::uint32_t>(links, [](const Link& l) { return base::index(l.b); }));
    add("coupling", column<float>(links, [](const Link& l) { return l.coupling; }), 1, "m2");
    add("visibility", column<std::uint16_t>(links, [](const Link& l) { return l.visibilityBits; }), 1,
        "1/32767, top bit: certain");
    add("spread-a", column<std::uint8_t>(links, [](const Link& l) { return l.spreadA; }));
    add("spread-b", column<std::uint8_t>(links, [](const Link& l) { return l.spreadB; }));
    add("gradient-a", gradients(links, &Link::gradientA), 2);
    add("gradient-b", gradients(links, &Link::gradientB), 2);
}

std::vector<Link> restoreAll(const Hierarchy& h, const ArrayReader& reader, const std::string& group) {
    const std::vector<std::uint32_t>& a = reader.values<std::uint32_t>(group + "a");
    const std::size_t count = a.size();
    const std::vector<std::uint32_t>& b = reader.values<std::uint32_t>(group + "b", 1, count);
    const std::vector<float>& coupling = reader.values<float>(group + "coupling", 1, count);
    const std::vector<std::uint16_t>& visibility =
        reader.values<std::uint16_t>(group + "visibility", 1, count);
    const std::vector<std::uint8_t>& spreadA = reader.values<std::uint8_t>(group + "spread-a", 1, count);
    const std::vector<std::uint8_t>& spreadB = reader.values<std::uint8_t>(group + "spread-b", 1, count);
    const std::vector<std::int8_t>& gradientA = reader.values<std::int8_t>(group + "gradient-a", 2, count);
    const std::vector<std::int8_t>& gradientB = reader.values<std::int8_t>(group + "gradient-b", 2, count);
    // Lists of ends are indexed by 32 bits.
    if (count >= base::index(NodeId::none)) {
        reader.fail(group + "a", "there cannot be so many links");
    }
    std::vector<Link> links(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (a[i] >= h.nodeCount() || b[i] >= h.nodeCount()) {
            reader.fail(group + (a[i] >= h.nodeCount() ? "a" : "b"), "names a node that is not there");
        }
        Link& link = links[i];
        link.a = NodeId{a[i]};
        link.b = NodeId{b[i]};
        link.coupling = coupling[i];
        link.visibilityBits = visibility[i];
        link.spreadA = spreadA[i];
        link.spreadB = spreadB[i];
        link.gradientA = {gradientA[2 * i], gradientA[2 * i + 1]};
        link.gradientB = {gradientB[2 * i], gradientB[2 * i + 1]};
    }
    return links;
}

}  // namespace

void saveLinks(NamedArrays& arrays, const hierarchy::LinkStore& store) {
    arrays.arrays.push_back({kLinks + "with-clusters", std::vector<std::uint64_t>{store.clusterLinks}});
    saveAll(arrays, kLinks, store.links);
}

void savePending(NamedArrays& arrays, const std::vector<Decision>& pending) {
    std::vector<Link> links;
    std::vector<float> error;
    std::vector<std::uint8_t> verdict;
    std::vector<std::uint8_t> isComputed;
    for (const Decision& d : pending) {
        links.push_back(d.link);
        error.push_back(d.error);
        verdict.push_back(static_cast<std::uint8_t>(d.verdict));
        isComputed.push_back(d.isComputed ? 1 : 0);
    }
    saveAll(arrays, kPending, links);
    arrays.arrays.push_back({kPending + "error", std::move(error), 1, "lux"});
    arrays.arrays.push_back({kPending + "verdict", std::move(verdict)});
    arrays.arrays.push_back({kPending + "is-computed", std::move(isComputed)});
}

void restoreLinks(Problem& problem, const ArrayReader& reader, bool isOrdered) {
    const Hierarchy& h = problem.hierarchy;
    std::vector<Link> links = restoreAll(h, reader, kLinks);
    const auto withClusters = reader.value<std::uint64_t>(kLinks + "with-clusters");
    for (std::size_t i = 0; i < links.size(); ++i) {
        if (!isPossible(h, links[i])) {
            reader.fail("links", "link " + std::to_string(i) + " cannot be");
        }
        if (isOrdered && hasCluster(h, links[i]) != (i < withClusters)) {
            reader.fail(kLinks + "with-clusters", "does not agree with the links");
        }
    }
    if (withClusters > (isOrdered ? links.size() : 0)) {
        reader.fail(kLinks + "with-clusters", "there cannot be so many links");
    }
    problem.links.links = std::move(links);
    problem.links.clusterLinks = static_cast<std::size_t>(withClusters);
    problem.links.index(h.nodeCount());
}

void restorePending(Problem& problem, const ArrayReader& reader) {
    const std::vector<Link> links = restoreAll(problem.hierarchy, reader, kPending);
    const std::vector<float>& error = reader.values<float>(kPending + "error", 1, links.size());
    const auto& verdict = reader.values<std::uint8_t>(kPending + "verdict", 1, links.size());
    const auto& isComputed = reader.values<std::uint8_t>(kPending + "is-computed", 1, links.size());
    problem.pending.clear();
    for (std::size_t i = 0; i < links.size(); ++i) {
        const Decision d{links[i], error[i], static_cast<Verdict>(verdict[i]), isComputed[i] != 0};
        if (!canBePending(problem.hierarchy, d)) {
            reader.fail("pending", "pair " + std::to_string(i) + " cannot be");
        }
        problem.pending.push_back(d);
    }
}

}  // namespace fluxwalk::solve
