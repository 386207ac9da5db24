#include "core/display/balance.h"

namespace fluxwalk::display {

namespace {

using surface::kMaxLevel;

// Corners 1 and 2 of a quad, and corner 1 of a triangle, lie one step along x; the others likewise.
constexpr std::array<GridPoint, 4> kQuadSteps{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
constexpr std::array<GridPoint, 4> kTriangleSteps{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};

// Unsigned arithmetic wraps, so that one expression serves both orientations.
GridPoint stepFrom(const GridPoint& p, const GridPoint& step, std::uint32_t size) {
    return {p.x + step.x * size, p.y + step.y * size};
}

std::uint32_t signedSize(const Cell& cell) {
    // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): bit_width is unknown to it
    const std::uint32_t size = kGridSize >> surface::pathLevel(cell.path);
    return cell.inverted ? 0u - size : size;
}

using Corners = std::array<GridPoint, 4>;

// Moves a cell's place to that of its quarter, which is `half` wide.
void descend(Cell& cell, unsigned child, std::uint32_t half) {
    const std::uint32_t size = cell.inverted ? 0u - half : half;
    if (cell.cornerCount == 4) {
        cell.origin = stepFrom(cell.origin, kQuadSteps[child], size);
    } else {
        cell.origin = stepFrom(cell.origin, kTriangleSteps[child], size);
        cell.inverted = cell.inverted != (child == 3);
    }
}

class Balancer {
  public:
    Balancer(const PatchTopology& topology, PointTable& points, std::vector<Cell>& cells)
        : topology_(topology), points_(points), cells_(cells) {}

    void run() {
        for (Cell& cell : cells_) {
            numberCorners(cell);
        }
        const std::size_t rootCount = cells_.size();
        // A split may unbalance cells that were looked at before: pass over all until nothing happens.
        bool changed = true;
        while (changed) {
            changed = false;
            for (std::size_t i = 0; i < cells_.size(); ++i) {
                if (cells_[i].firstChild == 0 && isUnbalanced(cells_[i])) {
                    split(i);
                    changed = true;
                }
            }
        }
        if (cells_.size() > rootCount) {
            keepLeaves(rootCount);
        }
    }

  private:
    void numberCorners(Cell& cell) {
        const Corners corners = cornersOf(cell);
        for (unsigned i = 0; i < cell.cornerCount; ++i) {
            cell.points[i] = points_.insert(topology_.keyOf(cell.patch, corners[i]));
        }
    }

    std::uint32_t find(const Cell& cell, const GridPoint& p) const {
        return points_.find(topology_.keyOf(cell.patch, p));
    }

    // A vertex anywhere inside half an edge implies one at its middle: ancestors' corners are vertices. The
    // last pass leaves all middles known.
    bool isUnbalanced(Cell& cell) const {
        const Corners corners = cornersOf(cell);
        const bool canSplit = surface::pathLevel(cell.path) < kMaxLevel;
        for (unsigned i = 0; i < cell.cornerCount; ++i) {
            const GridPoint& a = corners[i];
            const GridPoint& b = corners[i + 1u == cell.cornerCount ? 0 : i + 1];
            const GridPoint middle = middleOf(a, b);
            cell.middles[i] = find(cell, middle);
            if (cell.middles[i] != kNone && canSplit &&
                (find(cell, middleOf(a, middle)) != kNone || find(cell, middleOf(middle, b)) != kNone)) {
                return true;
            }
        }
        return false;
    }

    void split(std::size_t index) {
        const Cell parent = cells_[index];
        // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): bit_width is unknown to it
        const std::uint32_t half = kGridSize >> (surface::pathLevel(parent.path) + 1);
        cells_[index].firstChild = static_cast<std::uint32_t>(cells_.size());
        for (unsigned k = 0; k < 4; ++k) {
            Cell child = parent;
            child.path = surface::childPath(parent.path, k);
            descend(child, k, half);
            numberCorners(child);
            cells_.push_back(child);
        }
    }

    void keepLeaves(std::size_t rootCount) {
        std::vector<Cell> leaves;
        leaves.reserve(cells_.size());
        std::vector<std::uint32_t> stack;
        for (std::size_t root = 0; root < rootCount; ++root) {
            stack.push_back(static_cast<std::uint32_t>(root));
            while (!stack.empty()) {
                const Cell& cell = cells_[stack.back()];
                stack.pop_back();
                if (cell.firstChild == 0) {
                    leaves.push_back(cell);
                    continue;
                }
                for (std::uint32_t k = 4; k-- > 0;) {
                    stack.push_back(cell.firstChild + k);
                }
            }
        }
        cells_ = std::move(leaves);
    }

    const PatchTopology& topology_;
    PointTable& points_;
    std::vector<Cell>& cells_;
};

}  // namespace

std::array<GridPoint, 4> cornersOf(const Cell& cell) {
    const std::uint32_t size = signedSize(cell);
    const auto& steps = cell.cornerCount == 4 ? kQuadSteps : kTriangleSteps;
    Corners corners;
    for (unsigned i = 0; i < 4; ++i) {
        corners[i] = stepFrom(cell.origin, steps[i], size);
    }
    return corners;
}

Cell makeCell(const PatchTopology& topology, std::uint32_t patch, surface::Path path, std::uint32_t source) {
    Cell cell;
    cell.path = path;
    cell.patch = patch;
    cell.source = source;
    cell.cornerCount = static_cast<std::uint8_t>(topology.cornerCount(patch));
    const unsigned levels = surface::pathLevel(path);
    for (unsigned level = 0; level < levels; ++level) {
        descend(cell, surface::pathStep(path, level), kGridSize >> (level + 1));
    }
    return cell;
}

void balance(const PatchTopology& topology, PointTable& points, std::vector<Cell>& cells) {
    Balancer(topology, points, cells).run();
}

}  // namespace fluxwalk::display
