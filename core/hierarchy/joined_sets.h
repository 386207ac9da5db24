#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace fluxwalk::hierarchy {

/// Numbers 0 to count - 1 in sets that are joined pair by pair (union-find with path halving).
class JoinedSets {
  public:
    explicit JoinedSets(std::size_t count) : above_(count) {
        std::iota(above_.begin(), above_.end(), std::uint32_t{0});
    }

    /// The number that stands for i's set.
    std::uint32_t top(std::uint32_t i) {
        while (above_[i] != i) {
            i = above_[i] = above_[above_[i]];
        }
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { above_[top(a)] = top(b); }

  private:
    std::vector<std::uint32_t> above_;
};

}  // namespace fluxwalk::hierarchy
