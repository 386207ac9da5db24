#pragma once

#include <array>

#include "core/display/cell.h"

namespace fluxwalk::display {

/// Both halves of a quad region along `axis`. Along y first and then along x, they make the quarters that
/// surface::childRegions makes; twice along one, its strips.
std::array<surface::Region, 2> halfRegions(const surface::Surface& surface, std::uint32_t patch,
                                           const surface::Region& region, Axis axis);

/// Regions of cells that come depth-first: only what differs from the last cell is descended anew.
class RegionCursor {
  public:
    explicit RegionCursor(const surface::Surface& surface) : surface_(surface) {}

    const surface::Region& at(const Cell& cell);

  private:
    struct Place {
        std::uint32_t patch = kNone;
        surface::Path path = surface::kRootPath;
        surface::Path cuts = surface::kRootPath;
    };

    const surface::Region& partAt(surface::Path path, unsigned level) const {
        return level == 0 ? whole_ : parts_[level - 1][surface::pathStep(path, level - 1)];
    }
    const surface::Region& halfAt(const Cell& cell, unsigned level) const {
        return level == 0 ? partAt(cell.path, surface::pathLevel(cell.path))
                          : halves_[level - 1][surface::pathStep(cell.cuts, level - 1) & 1u];
    }

    const surface::Surface& surface_;
    Place last_;
    surface::Region whole_;
    /// Levels whose parts and halves are known on the way to the last cell.
    unsigned partDepth_ = 0;
    unsigned halfDepth_ = 0;
    std::array<std::array<surface::Region, 4>, surface::kMaxLevel> parts_;
    std::array<std::array<surface::Region, 2>, kMaxCuts> halves_;
};

}  // namespace fluxwalk::display
