#include "core/display/post_refine.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/photometry.h"
#include "core/display/cell_regions.h"
#include "core/display/cell_shape.h"
#include "core/display/cell_tree.h"

namespace fluxwalk::display {

namespace {

using surface::Region;

/// Inside a patch an edge may turn by this much (radians) where its normals don't, and rise over its chord by
/// this part of the cell's width: what is bent within the surface is not seen.
constexpr double kInnerTurn = 0.87;
constexpr double kInnerRise = 0.25;
/// Cells that end in a pole are cut across until they reach no further than 2^-4 of their patch from it: no
/// cut makes their angles larger.
constexpr std::uint32_t kPoleExtent = kGridSize >> 4u;
/// A cell is cut along to save cuts across only while it is no longer than this many widths, and while there
/// are no more cells than this part of those allowed: the cuts across are still to come.
constexpr double kVeryLong = 8.0;
constexpr std::size_t kLaterCuts = 16;
/// A quad is long if it is longer than wide by more: halves of less are no better.
constexpr double kLong = 1.5;

/// Which ways a cell is cut.
struct Cuts {
    bool x = false;
    bool y = false;

    bool any() const { return x || y; }
};

std::uint32_t extentAlong(const Cell& cell, Axis axis) {
    return axis == Axis::x ? cell.extent.x : cell.extent.y;
}

class Refiner {
  public:
    Refiner(const PatchTopology& topology, std::span<const Cell> cells, const RefineOptions& options)
        : topology_(topology),
          surface_(topology.surface()),
          sources_(cells),
          options_(options),
          mostCells_(options.mostCellsAPatch * topology.surface().patchCount()),
          bend_(std::tan(0.5 * std::min(options.curvatureAngle, 3.0))),
          cosine_(std::cos(options.leastAngle)),
          // Halved across, a cell that is longer than this would have to be cut for its shape in any case.
          longFirst_(options.leastAngle > 0.0 ? 0.5 / std::tan(options.leastAngle) : 0.0),
          points_(0) {}

    RefinedCells run() {
        cells_.reserve(sources_.size());
        regions_.reserve(sources_.size());
        RegionCursor cursor(surface_);
        for (std::uint32_t i = 0; i < sources_.size(); ++i) {
            cells_.push_back(makeCell(topology_, sources_[i].patch, sources_[i].path, i));
            regions_.push_back(cursor.at(cells_.back()));
        }
        leafCount_ = cells_.size();
        tree_.emplace(topology_, points_, cells_);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            isCompact_.resize(cells_.size(), 0);
            cutForCurvature(i);
        }
        cutForShape();
        if (cells_.size() == sources_.size()) {
            return {{}, PointTable(0)};
        }
        // About one corner for each quad, half a one for each triangle.
        points_ = PointTable(leafCount_ + leafCount_ / 8);
        numberAll();
        while (balanceAll()) {
            cutForShape();
            numberNew();
        }
        tree_->keepLeaves();
        return {std::move(cells_), std::move(points_)};
    }

  private:
    bool isQuad(std::size_t i) const { return cells_[i].cornerCount == 4; }
    CellShape shapeOf(std::size_t i) const { return {surface_, cells_[i].patch, regions_[i]}; }

    void quarter(std::size_t i) {
        const Region region = regions_[i];
        tree_->split(i);
        for (const Region& quarter :
             surface::childRegions(surface_, cells_[i].patch, region, surface::Split::quarters)) {
            regions_.push_back(quarter);
        }
        leafCount_ += 3;
    }

    void halve(std::size_t i, Axis axis) {
        const Region region = regions_[i];
        tree_->halve(i, axis);
        for (const Region& half : halfRegions(surface_, cells_[i].patch, region, axis)) {
            regions_.push_back(half);
        }
        ++leafCount_;
    }

    // Along y first, so that the quarters are those of the solution.
    void cut(std::size_t i, const Cuts& cuts) {
        if (!isQuad(i)) {
            quarter(i);
        } else if (cuts.y) {
            halve(i, Axis::y);
            if (cuts.x) {
                const std::size_t first = cells_[i].firstChild;
                halve(first, Axis::x);
                halve(first + 1, Axis::x);
            }
        } else {
            halve(i, Axis::x);
        }
    }

    bool mayRefine(const Cell& cell, Axis axis) const {
        return extentAlong(cell, axis) > extentAlong(sources_[cell.source], axis) >> kMaxExtraLevels &&
               canBeHalved(cell, axis);
    }

    void cutForCurvature(std::size_t i) {
        const Cell& cell = cells_[i];
        if (cell.childCount != 0 || surface_.isPlanar(cell.patch)) {
            return;
        }
        const Cuts cuts = isQuad(i) ? curvatureCuts(i) : triangleCuts(i);
        if (cuts.any()) {
            cut(i, cuts);
        }
    }

    bool isLong(const CellShape& shape) const {
        return shape.isLonger(Axis::x, kLong) || shape.isLonger(Axis::y, kLong);
    }

    Cuts triangleCuts(std::size_t i) const {
        const Cell& cell = cells_[i];
        const Region& region = regions_[i];
        if (!mayRefine(cell, Axis::x)) {
            return {};
        }
        if (!surface_.normalsLieWithin(cell.patch, region, options_.curvatureAngle)) {
            return {true, true};
        }
        std::array<Vec3d, 3> corners{};
        for (unsigned k = 0; k < 3; ++k) {
            corners[k] = surface_.evaluate(cell.patch, region.corners[k]).position;
        }
        bool isBent = false;
        for (unsigned k = 0; k < 3 && !isBent; ++k) {
            const Vec2d& a = region.corners[k];
            const Vec2d& b = region.corners[(k + 1) % 3];
            const Vec3d& from = corners[k];
            const Vec3d& to = corners[(k + 1) % 3];
            const Vec3d middle =
                surface_.evaluate(cell.patch, surface_.splitPoint(cell.patch, a, b)).position;
            isBent = glm::distance(middle, 0.5 * (from + to)) > 0.5 * bend_ * glm::distance(from, to);
        }
        return {isBent, isBent};
    }

    Cuts curvatureCuts(std::size_t i) {
        const Cell& cell = cells_[i];
        const CellShape shape = shapeOf(i);
        isCompact_[i] = isLong(shape) ? 0 : 1;
        Cuts cuts;
        for (unsigned side = 0; side < 4; ++side) {
            if (isTooBent(cell, shape, side)) {
                (side % 2 == 0 ? cuts.x : cuts.y) = true;
            }
        }
        // Asked for by sides alone, which only the parts next to them share.
        bool isOfSides = cuts.any();
        if (!(cuts.x && cuts.y) && !hasCommonAxis(i, shape)) {
            isOfSides = false;
            const double alongX = shape.turnAlong(Axis::x);
            const double alongY = shape.turnAlong(Axis::y);
            // A bound that is wider than what turns is not known to be so along one axis.
            const bool isWide = std::max(alongX, alongY) < options_.curvatureAngle;
            cuts.x = cuts.x || isWide || alongX >= 0.5 * alongY;
            cuts.y = cuts.y || isWide || alongY >= 0.5 * alongX;
        }
        cuts.x = cuts.x && mayRefine(cell, Axis::x);
        cuts.y = cuts.y && mayRefine(cell, Axis::y);
        // Its parts may need less.
        for (const Axis along : {Axis::x, Axis::y}) {
            const Axis across = along == Axis::x ? Axis::y : Axis::x;
            const bool isOnlyAcross = along == Axis::x ? cuts.y && !cuts.x : cuts.x && !cuts.y;
            const double ratio = shape.longestAlong(along) / shape.longestAlong(across);
            const bool isCheap = isOfSides || (ratio < kVeryLong && leafCount_ < mostCells_ / kLaterCuts);
            if (isOnlyAcross && longFirst_ > 0.0 && ratio > longFirst_ && isCheap &&
                mayCutForShape(cell, shape, along)) {
                return {along == Axis::x, along == Axis::y};
            }
        }
        return cuts;
    }

    // Normals further apart than the cone is wide tell at once that there is none.
    bool hasCommonAxis(std::size_t i, const CellShape& shape) const {
        const double angle = options_.curvatureAngle;
        if (angle < 0.5 * base::kPi && shape.turnsBeyond(2.0 * angle)) {
            return false;
        }
        return surface_.normalsLieWithin(cells_[i].patch, regions_[i], angle);
    }

    bool isTooBent(const Cell& cell, const CellShape& shape, unsigned side) const {
        const std::array<bool, 4> isBorder{cell.origin.y == 0, cell.origin.x + cell.extent.x == kGridSize,
                                           cell.origin.y + cell.extent.y == kGridSize, cell.origin.x == 0};
        const double bend = shape.bendOf(side);
        if (bend <= bend_) {
            return isBorder[side] && shape.riseOf(side) > options_.rimRise &&
                   topology_.isFree(cell.patch, side);
        }
        return isBorder[side] || longFirst_ == 0.0 || bend > std::tan(0.25 * kInnerTurn) ||
               shape.riseOverWidth(side) > kInnerRise;
    }

    bool mayCutForShape(const Cell& cell, const CellShape& shape, Axis axis) const {
        return canBeHalved(cell, axis) &&
               (!shape.endsInPoint(axis) || extentAlong(cell, axis) > kPoleExtent) &&
               (!surface_.isPlanar(cell.patch) ||
                extentAlong(cell, axis) > extentAlong(sources_[cell.source], axis) / kMaxPlanarStrips);
    }

    // Breadth-first: if there are too many, all are cut alike.
    void cutForShape() {
        for (; shaped_ < cells_.size(); ++shaped_) {
            if (cells_[shaped_].childCount != 0 || !isQuad(shaped_) || options_.leastAngle <= 0.0 ||
                leafCount_ >= mostCells_ || (shaped_ < isCompact_.size() && isCompact_[shaped_] != 0)) {
                continue;
            }
            const CellShape shape = shapeOf(shaped_);
            for (const Axis axis : {Axis::x, Axis::y}) {
                if (shape.isLonger(axis, kLong)) {
                    if (shape.hasAngleBelow(cosine_) && mayCutForShape(cells_[shaped_], shape, axis)) {
                        halve(shaped_, axis);
                    }
                    break;
                }
            }
        }
    }

    void numberAll() {
        for (std::size_t i = 0; i < sources_.size(); ++i) {
            if (cells_[i].childCount != 0 && isQuad(i)) {
                tree_->numberCenter(cells_[i]);
            }
        }
        numberNew();
    }

    void numberNew() {
        for (; numbered_ < cells_.size(); ++numbered_) {
            tree_->number(numbered_);
        }
    }

    bool balanceAll() {
        const std::size_t before = cells_.size();
        bool changed = true;
        while (changed) {
            changed = false;
            for (std::size_t i = 0; i < cells_.size(); ++i) {
                if (cells_[i].childCount != 0) {
                    continue;
                }
                if (const std::optional<unsigned> side = tree_->findCrowdedSide(i)) {
                    if (i < sources_.size() && isQuad(i)) {
                        tree_->numberCenter(cells_[i]);
                    }
                    cut(i, {*side % 2 == 0, *side % 2 != 0});
                    numberNew();
                    changed = true;
                }
            }
        }
        return cells_.size() > before;
    }

    const PatchTopology& topology_;
    const surface::Surface& surface_;
    std::span<const Cell> sources_;
    const RefineOptions& options_;
    std::size_t mostCells_;
    double bend_;
    double cosine_;
    double longFirst_;
    PointTable points_;
    std::vector<Cell> cells_;
    std::vector<Region> regions_;  ///< parallel to cells_
    /// Cells that are known not to be long, of the first ones.
    std::vector<std::uint8_t> isCompact_;
    std::optional<CellTree> tree_;
    std::size_t leafCount_ = 0;
    /// Cells whose shape was looked at, and that have their points.
    std::size_t shaped_ = 0;
    std::size_t numbered_ = 0;
};

}  // namespace

RefinedCells refineForDisplay(const PatchTopology& topology, std::span<const Cell> cells,
                              const RefineOptions& options) {
    return Refiner(topology, cells, options).run();
}

}  // namespace fluxwalk::display
