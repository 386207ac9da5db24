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
    const std::uint32_t size = kGridSize >> surface::pathLevel(cell.path);
    return cell.inverted ? 0u - size : size;
}

Cell childOf(const Cell& parent, unsigned child) {
    Cell cell = parent;
    cell.path = surface::childPath(parent.path, child);
    // Halving the signed size, not the unsigned one, keeps the sign.
    const std::uint32_t half = kGridSize >> (surface::pathLevel(parent.path) + 1);
    const std::uint32_t size = parent.inverted ? 0u - half : half;
    if (parent.cornerCount == 4) {
        cell.origin = stepFrom(parent.origin, kQuadSteps[child], size);
    } else {
        cell.origin = stepFrom(parent.origin, kTriangleSteps[child], size);
        cell.inverted = parent.inverted != (child == 3);
    }
    return cell;
}

class Balancer {
  public:
    Balancer(const PatchTopology& topology, PointTable& points, std::vector<Cell>& cells)
        : topology_(topology), points_(points), cells_(cells) {}

    void run() {
        for (Cell& cell : cells_) {
            for (unsigned i = 0; i < cell.cornerCount; ++i) {
                cell.points[i] = points_.insert(topology_.keyOf(cell.patch, cell.corner(i)));
            }
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
    bool hasPoint(const Cell& cell, const GridPoint& p) const {
        return points_.find(topology_.keyOf(cell.patch, p)) != kNone;
    }

    // A vertex anywhere inside half an edge implies one at its middle: ancestors' corners are vertices.
    bool isUnbalanced(const Cell& cell) const {
        if (surface::pathLevel(cell.path) >= kMaxLevel) {
            return false;
        }
        for (unsigned i = 0; i < cell.cornerCount; ++i) {
            const GridPoint a = cell.corner(i);
            const GridPoint b = cell.corner(i + 1 == cell.cornerCount ? 0 : i + 1);
            const GridPoint middle = middleOf(a, b);
            if (hasPoint(cell, middle) &&
                (hasPoint(cell, middleOf(a, middle)) || hasPoint(cell, middleOf(middle, b)))) {
                return true;
            }
        }
        return false;
    }

    void split(std::size_t index) {
        const Cell parent = cells_[index];
        cells_[index].firstChild = static_cast<std::uint32_t>(cells_.size());
        for (unsigned k = 0; k < 4; ++k) {
            Cell child = childOf(parent, k);
            for (unsigned i = 0; i < child.cornerCount; ++i) {
                child.points[i] = points_.insert(topology_.keyOf(child.patch, child.corner(i)));
            }
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

GridPoint Cell::corner(unsigned i) const {
    return stepFrom(origin, cornerCount == 4 ? kQuadSteps[i] : kTriangleSteps[i], signedSize(*this));
}

Cell makeCell(const PatchTopology& topology, std::uint32_t patch, surface::Path path, std::uint32_t source) {
    Cell cell;
    cell.patch = patch;
    cell.source = source;
    cell.cornerCount = static_cast<std::uint8_t>(topology.cornerCount(patch));
    const unsigned levels = surface::pathLevel(path);
    for (unsigned level = 0; level < levels; ++level) {
        cell = childOf(cell, surface::pathStep(path, level));
    }
    return cell;
}

void balance(const PatchTopology& topology, PointTable& points, std::vector<Cell>& cells) {
    Balancer(topology, points, cells).run();
}

}  // namespace fluxwalk::display
