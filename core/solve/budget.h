#pragma once

#include <cstdint>
#include <limits>
#include <string>

/// How many links and bytes a solve may take.
namespace fluxwalk::solve {

enum class Limit : std::uint8_t { none, links, memory };

/// What memory goes into, in bytes. A pair that waits to be refined counts as a link: it becomes one at most.
struct Footprint {
    /// The program, the scene, its trees and the hierarchy as built.
    std::uint64_t base = 0;
    std::uint64_t builtNodes = 0;  ///< number of nodes in `base`
    std::uint64_t display = 0;     ///< meshes as they are now
    std::uint64_t shownNodes = 0;  ///< number of nodes when these were made

    /// With so many nodes and links, and all that refining, sweeping and showing them takes on the way.
    std::uint64_t bytes(std::uint64_t nodes, std::uint64_t links) const;
};

class Budget {
  public:
    Budget() = default;
    /// 0 is no limit.
    Budget(std::uint64_t maxLinks, std::uint64_t maxBytes, const Footprint& footprint);

    bool holds(std::uint64_t nodes, std::uint64_t links) const {
        return exceeded(nodes, links) == Limit::none;
    }
    /// Which limit so much would go beyond.
    Limit exceeded(std::uint64_t nodes, std::uint64_t links) const;
    /// The limit that has least room left beyond that, relative to itself.
    Limit nearest(std::uint64_t nodes, std::uint64_t links) const;
    /// Throws base::UsageError that names the option and what it takes, if that does not hold.
    void require(std::uint64_t nodes, std::uint64_t links) const;

  private:
    std::uint64_t maxLinks_ = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t maxBytes_ = std::numeric_limits<std::uint64_t>::max();
    Footprint footprint_;
};

/// "1.5 GiB", "300 MiB".
std::string formatBytes(std::uint64_t bytes);

}  // namespace fluxwalk::solve
