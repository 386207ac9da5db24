#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/hierarchy/hierarchy.h"
#include "core/hierarchy/links.h"
#include "core/solve/budget.h"
#include "core/transport/coefficients.h"

/// Pairs that refinement has looked at and that wait to be split.
namespace fluxwalk::solve {

enum class Verdict : std::uint8_t { drop, accept, splitA, splitB, splitSelf };

/// What refinement made of a pair.
struct Decision {
    hierarchy::Link link;
    /// Of the link as it is, in lux, at most: what the threshold is compared with. Infinite where a link
    /// cannot stand whatever its error.
    float error = INFINITY;
    Verdict verdict = Verdict::drop;
    bool isComputed = false;  ///< the link has its coefficient

    bool canStand() const { return std::isfinite(error); }
};

/// Takes out of `pending` what is to be split next: everything where `budget` is far, in its order; near it
/// first what cannot stand, then the largest errors (ties by names), as long as there is room. Empty where
/// there is none for any. `standing`: links already accepted. Throws base::UsageError where not even what
/// cannot stand has room.
std::vector<Decision> takeNext(std::vector<Decision>& pending, const hierarchy::Hierarchy& h,
                               const Budget& budget, std::size_t standing);

/// Into how many pairs opening makes one.
std::size_t countParts(const hierarchy::Hierarchy& h, const Decision& d);

/// Splits the nodes that need children and returns the pairs that replace the opened ones, in their order.
std::vector<transport::Query> openPairs(hierarchy::Hierarchy& h, const base::Executor& executor,
                                        const std::vector<Decision>& opened);

}  // namespace fluxwalk::solve
