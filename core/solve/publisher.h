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

    /// What was made of the displayed objects so far, while others are still shown as in the last snapshot;
    /// nothing once none is left. At most about `seconds` go into it.
    std::shared_ptr<const Snapshot> makePart(const Detail& detail, double seconds);

    std::uint64_t count() const { return count_; }
    /// Options::displayAngle of the last whole snapshot.
    double shownAngle() const { return shownAngle_; }

  private:
    std::shared_ptr<const Snapshot> describe(const Detail& detail, bool isFinished);

    Problem& problem_;
    DisplayUpdate& display_;
    std::uint64_t count_ = 0;
    double shownAngle_ = 0.0;
    std::shared_ptr<const std::vector<ClusterBox>> clusters_;  ///< never change; made when asked for
};

}  // namespace fluxwalk::solve
