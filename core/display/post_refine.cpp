#include "core/display/post_refine.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/photometry.h"
#include "core/display/cell_regions.h"

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
    Refiner(const PatchTopology& topology, std::span<const Cell> cells, const MeshVertices& vertices,
            const RefineOptions& options, RefineBuffers& buffers)
        : topology_(topology),
          surface_(topology.surface()),
          sources_(cells),
          vertices_(vertices),
          options_(options),
          mostCells_(options.mostCellsAPatch * topology.surface().patchCount()),
          bend_(std::tan(0.5 * std::min(options.curvatureAngle, 3.0))),
          cosine_(std::cos(options.leastAngle)),
          // Halved across, a cell that is longer than this would have to be cut for its shape in any case.
          longFirst_(options.leastAngle > 0.0 ? 0.5 / std::tan(options.leastAngle) : 0.0),
          buffers_(buffers),
          net_(buffers.net),
          cells_(buffers.cells),
          nets_(buffers.nets),
          isCompact_(buffers.isCompact),
          leafCount_(cells.size()) {}

    void run() {
        buffers_.refined.cells.clear();
        buffers_.refined.cellSamples.clear();
        if (!needsCuts()) {
            return;
        }
        addRoots();
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            isCompact_.resize(cells_.size(), 0);
            cutForCurvature(i);
        }
        cutForShape();
        if (cells_.size() == sources_.size()) {
            return;
        }
        while (balanceAll()) {
            cutForShape();
        }
        takeLeaves();
    }

  private:
    bool isQuad(std::size_t i) const { return cells_[i].cornerCount == 4; }

    CellShape shapeOf(std::size_t i) {
        CellNet& net = nets_[i];
        std::array<std::uint32_t, 9> numbers{};
        for (unsigned k = 0; k < 4; ++k) {
            numbers[2 * k] = net.corners[k];
            numbers[2 * k + 1] = net_.middleOf(net, k, 4);
        }
        numbers[8] = net_.centerOf(net);
        CellShape::Samples samples{};
        for (unsigned k = 0; k < 9; ++k) {
            samples[k] = &net_.samples()[numbers[k]];
        }
        return CellShape(samples);
    }

    // Flat cells are mostly shown as they are: that is seen before anything is set up.
    bool needsCuts() const {
        RegionCursor cursor(surface_);
        for (const Cell& source : sources_) {
            if (!surface_.isPlanar(source.patch)) {
                return true;
            }
            if (source.cornerCount != 4 || !shapesCells()) {
                continue;
            }
            const QuadSamples samples(surface_, source.patch, cursor.at(source));
            if (shapeCut(source, source, CellShape(samples.pointers()))) {
                return true;
            }
        }
        return false;
    }

    void addRoots() {
        net_.reset(topology_, vertices_);
        cells_.clear();
        nets_.clear();
        isCompact_.clear();
        RegionCursor cursor(surface_);
        for (std::uint32_t i = 0; i < sources_.size(); ++i) {
            cells_.push_back(makeCell(topology_, sources_[i].patch, sources_[i].path, i));
            nets_.push_back(net_.addRoot(sources_[i], vertices_.cells[i], cursor.at(sources_[i])));
        }
    }

    void quarter(std::size_t i) {
        const Cell parent = cells_[i];
        setChildren(i, 4);
        const std::array<CellNet, 4> nets = net_.quarter(nets_[i]);
        for (unsigned k = 0; k < 4; ++k) {
            cells_.push_back(partOf(parent, surface::Split::quarters, k));
            nets_.push_back(nets[k]);
        }
        leafCount_ += 3;
    }

    void halve(std::size_t i, Axis axis) {
        const Cell parent = cells_[i];
        setChildren(i, 2);
        const std::array<CellNet, 2> nets = net_.halve(nets_[i], axis);
        if (i < sources_.size()) {
            net_.splitBetween(nets[0], axis);
        }
        for (unsigned half = 0; half < 2; ++half) {
            cells_.push_back(halfOf(parent, axis, half));
            nets_.push_back(nets[half]);
        }
        ++leafCount_;
    }

    void setChildren(std::size_t i, std::uint8_t count) {
        cells_[i].firstChild = static_cast<std::uint32_t>(cells_.size());
        cells_[i].childCount = count;
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

    Cuts triangleCuts(std::size_t i) {
        const Cell& cell = cells_[i];
        if (!mayRefine(cell, Axis::x)) {
            return {};
        }
        const CellNet& net = nets_[i];
        if (!surface_.normalsLieWithin(cell.patch, net_.regionOf(net, 3), options_.curvatureAngle)) {
            return {true, true};
        }
        bool isBent = false;
        for (unsigned k = 0; k < 3 && !isBent; ++k) {
            const std::uint32_t number = net_.middleOf(net, k, 3);
            const Vec3d& middle = net_.samples()[number].position;
            const Vec3d& from = net_.samples()[net.corners[k]].position;
            const Vec3d& to = net_.samples()[net.corners[(k + 1) % 3]].position;
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
                mayCutForShape(cell, sourceOf(i), shape, along)) {
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
        return surface_.normalsLieWithin(cells_[i].patch, net_.regionOf(nets_[i], 4), angle);
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

    const Cell& sourceOf(std::size_t i) const { return sources_[cells_[i].source]; }

    bool mayCutForShape(const Cell& cell, const Cell& source, const CellShape& shape, Axis axis) const {
        return canBeHalved(cell, axis) &&
               (!shape.endsInPoint(axis) || extentAlong(cell, axis) > kPoleExtent) &&
               (!surface_.isPlanar(cell.patch) ||
                extentAlong(cell, axis) > extentAlong(source, axis) / kMaxPlanarStrips);
    }

    bool shapesCells() const { return options_.leastAngle > 0.0 && leafCount_ < mostCells_; }

    // The axis along which a quad is cut for its shape.
    std::optional<Axis> shapeCut(const Cell& cell, const Cell& source, const CellShape& shape) const {
        for (const Axis axis : {Axis::x, Axis::y}) {
            if (shape.isLonger(axis, kLong)) {
                const bool isCut = shape.hasAngleBelow(cosine_) && mayCutForShape(cell, source, shape, axis);
                return isCut ? std::optional(axis) : std::nullopt;
            }
        }
        return std::nullopt;
    }

    // Breadth-first: if there are too many, all are cut alike.
    void cutForShape() {
        for (; shaped_ < cells_.size(); ++shaped_) {
            if (cells_[shaped_].childCount != 0 || !isQuad(shaped_) || !shapesCells() ||
                (shaped_ < isCompact_.size() && isCompact_[shaped_] != 0)) {
                continue;
            }
            const CellShape shape = shapeOf(shaped_);
            if (const auto axis = shapeCut(cells_[shaped_], sourceOf(shaped_), shape)) {
                halve(shaped_, *axis);
            }
        }
    }

    // The first side of a cell, if any, with more than one vertex between its ends, if it can be cut there.
    std::optional<unsigned> findCrowdedSide(std::size_t i) const {
        for (unsigned side = 0; side < cells_[i].cornerCount; ++side) {
            if (net_.isCrowded(nets_[i].sides[side]) &&
                canBeHalved(cells_[i], side % 2 == 0 ? Axis::x : Axis::y)) {
                return side;
            }
        }
        return std::nullopt;
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
                if (const std::optional<unsigned> side = findCrowdedSide(i)) {
                    cut(i, {*side % 2 == 0, *side % 2 != 0});
                    changed = true;
                }
            }
        }
        return cells_.size() > before;
    }

    // Depth-first.
    void takeLeaves() {
        RefinedCells& out = buffers_.refined;
        std::vector<std::uint32_t>& stack = buffers_.stack;
        for (std::uint32_t root = 0; root < sources_.size(); ++root) {
            stack.push_back(root);
            while (!stack.empty()) {
                const std::uint32_t i = stack.back();
                stack.pop_back();
                const Cell& cell = cells_[i];
                for (std::uint32_t k = cell.childCount; k-- > 0;) {
                    stack.push_back(cell.firstChild + k);
                }
                if (cell.childCount == 0) {
                    out.cells.push_back(cell);
                    out.cellSamples.push_back(samplesOf(i));
                }
            }
        }
        out.samples = net_.samples();
        out.pointCount = net_.pointCount();
    }

    CellSamples samplesOf(std::size_t i) {
        const Cell& cell = cells_[i];
        CellNet& net = nets_[i];
        CellSamples own;
        own.corners = net.corners;
        for (unsigned k = 0; k < cell.cornerCount; ++k) {
            if (net_.isSplit(net.sides[k])) {
                own.middles[k] = net_.vertexOn(net, k, cell.cornerCount);
            }
        }
        if (isFan(cell, surface_.isPlanar(cell.patch), own.middles != CellSamples{}.middles)) {
            own.center = net_.centerOf(net);
        }
        return own;
    }

    const PatchTopology& topology_;
    const surface::Surface& surface_;
    std::span<const Cell> sources_;
    const MeshVertices& vertices_;
    const RefineOptions& options_;
    std::size_t mostCells_;
    double bend_;
    double cosine_;
    double longFirst_;
    RefineBuffers& buffers_;
    SampleNet& net_;
    std::vector<Cell>& cells_;
    std::vector<CellNet>& nets_;  ///< parallel to cells_
    /// Cells that are known not to be long, of the first ones.
    std::vector<std::uint8_t>& isCompact_;
    std::size_t leafCount_;
    /// Cells whose shape was looked at.
    std::size_t shaped_ = 0;
};

}  // namespace

const RefinedCells& refineForDisplay(const PatchTopology& topology, std::span<const Cell> cells,
                                     const MeshVertices& vertices, const RefineOptions& options,
                                     RefineBuffers& buffers) {
    Refiner(topology, cells, vertices, options, buffers).run();
    return buffers.refined;
}

}  // namespace fluxwalk::display
