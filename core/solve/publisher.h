#pragma once

#include "core/solve/display_update.h"
#include "core/solve/solver.h"

namespace fluxwalk::solve {

/// Makes snapshots of a problem, one after the other.
class Publisher {
  public:
    Publisher(Problem& problem, DisplayUpdate& display) : problem_(problem), display_(display) {}

    /// The present solution. Links and light must agree: after a sweep.
    std::shared_ptr<const Snapshot> make(const Detail& detail, bool isFinished);

    std::uint64_t count() const { return count_; }

  private:
    Problem& problem_;
    DisplayUpdate& display_;
    std::uint64_t count_ = 0;
    std::shared_ptr<const std::vector<ClusterBox>> clusters_;  ///< never change; made when asked for
};

}  // namespace fluxwalk::solve
