#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/hierarchy/links.h"

namespace fluxwalk::solve {

using base::NodeId;

/// Coefficients of pairs that were refined or dropped. They are pure functions of their pairs: where links
/// are found again from the root, these need not be computed again, and make the same links (but for the mark
/// of certain visibility, which may come from the shaft of another ancestor).
class KnownPairs {
  public:
    /// A pair that was opened, or with no coupling one that exchanges nothing.
    void note(const hierarchy::Link& link) { links_.push_back(link); }
    /// Takes over what stands, and makes everything noted so far findable. The pairs of one node with itself
    /// are left out.
    void takeIn(std::span<const hierarchy::Link> standing);
    /// What is known of a pair as takeIn() left it. Thread-safe.
    std::optional<hierarchy::Link> find(NodeId a, NodeId b) const;

    /// After nodes moved (Hierarchy::prune): `places` by old node, NodeId::none for those that are gone.
    void move(std::span<const NodeId> places);
    void clear() { *this = {}; }
    std::uint64_t bytes() const { return links_.size() * sizeof(hierarchy::Link); }

  private:
    std::vector<hierarchy::Link> links_;
    std::size_t sorted_ = 0;  ///< of these, the first ones are in order
};

}  // namespace fluxwalk::solve
