#include "core/solve/budget.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/hierarchy/hierarchy.h"
#include "core/hierarchy/links.h"

namespace fluxwalk::solve {

namespace {

/// Beyond a node itself: one more copy of its shape while the arrays grow.
constexpr std::uint64_t kNodeGrowth = sizeof(hierarchy::Shape);
/// A link is listed at both ends, is copied once while links grow or are put in order, or else has what
/// sweeps know of its ends where these are clusters.
constexpr std::uint64_t kLink = sizeof(hierarchy::Link) + 2 * sizeof(std::uint32_t) + 56;
/// Measured: vertices and triangles of one flat leaf, with what making them takes.
constexpr std::uint64_t kShownLeaf = 700;
constexpr double kMebi = 1024.0 * 1024.0;

}  // namespace

std::uint64_t Footprint::bytes(std::uint64_t nodes, std::uint64_t links) const {
    const std::uint64_t split = nodes - std::min(nodes, builtNodes);
    // Of four children three are leaves more.
    const std::uint64_t toShow = (nodes - std::min(nodes, shownNodes)) * 3 / 4;
    return base + split * hierarchy::Hierarchy::bytesPerNode() + nodes * kNodeGrowth + links * kLink +
           display + toShow * kShownLeaf;
}

Budget::Budget(std::uint64_t maxLinks, std::uint64_t maxBytes, const Footprint& footprint)
    : footprint_(footprint) {
    maxLinks_ = maxLinks > 0 ? maxLinks : maxLinks_;
    maxBytes_ = maxBytes > 0 ? maxBytes : maxBytes_;
}

Limit Budget::exceeded(std::uint64_t nodes, std::uint64_t links) const {
    if (links > maxLinks_) {
        return Limit::links;
    }
    return footprint_.bytes(nodes, links) > maxBytes_ ? Limit::memory : Limit::none;
}

Limit Budget::nearest(std::uint64_t nodes, std::uint64_t links) const {
    const double ofLinks = static_cast<double>(links) / static_cast<double>(maxLinks_);
    const double ofBytes =
        static_cast<double>(footprint_.bytes(nodes, links)) / static_cast<double>(maxBytes_);
    return ofLinks >= ofBytes ? Limit::links : Limit::memory;
}

void Budget::require(std::uint64_t nodes, std::uint64_t links) const {
    switch (exceeded(nodes, links)) {
        case Limit::links:
            throw base::UsageError(fmt::format(
                "--link-limit: {} links are too few for this scene, whose coarsest ones are {} or more",
                maxLinks_, links));
        case Limit::memory:
            throw base::UsageError(fmt::format(
                "--memory-limit: {} is too little for this scene, which takes {} or more before its "
                "links are refined",
                formatBytes(maxBytes_), formatBytes(footprint_.bytes(nodes, links))));
        case Limit::none:
            break;
    }
}

std::string formatBytes(std::uint64_t bytes) {
    const double mebi = static_cast<double>(bytes) / kMebi;
    return mebi >= 1024.0 ? fmt::format("{:.4g} GiB", mebi / 1024.0) : fmt::format("{:.4g} MiB", mebi);
}

}  // namespace fluxwalk::solve
