#include "core/rays/binned_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/rays/binned_split.h"
#include "core/rays/grid_split.h"

namespace fluxwalk::rays {

namespace {

/// Subtrees of at most this many items are one task.
constexpr std::size_t kTaskItems = 4096;

Float4 toFloat4(const base::Vec3d& v) {
    return Float4{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0f};
}

Float4 sumOfNormals(const TreeItems& items, std::size_t i) {
    if (items.normals.empty()) {
        return Float4{};
    }
    // A cap of normals with half-angle h has a mean of length (1 + cos h) / 2.
    const base::NormalCone& cone = items.normals[i];
    const double length = 0.5 * (1.0 + std::cos(std::min(cone.halfAngle, base::kPi)));
    Float4 sum = toFloat4(items.areas[i] * length * cone.axis);
    sum[3] = static_cast<float>(items.areas[i]);
    return sum;
}

std::vector<BuildItem> makeItems(const TreeItems& items, const base::Executor& executor) {
    base::Box all;
    for (const base::Box& box : items.boxes) {
        all.extend(box);
    }
    const base::Vec3d middle = all.center();
    const base::Vec3d size = all.size();
    const double largest = std::max({size.x, size.y, size.z});
    const double scale = largest > 0.0 ? 1.0 / largest : 1.0;
    std::vector<BuildItem> made(items.boxes.size());
    executor.forRange(made.size(), kTaskItems, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const base::Vec3d lower = scale * (items.boxes[i].lower - middle);
            const base::Vec3d upper = scale * (items.boxes[i].upper - middle);
            FLUXWALK_CHECK(std::isfinite(glm::dot(lower + upper, base::Vec3d(1.0))));
            made[i].lower = toFloat4(lower);
            made[i].upper = toFloat4(upper);
            made[i].normal = sumOfNormals(items, i);
            made[i].setIndex(static_cast<std::uint32_t>(i));
        }
    });
    return made;
}

/// A subtree that is still to be made: its items, its first node, its place.
struct Task {
    std::size_t first = 0;
    std::size_t count = 0;
    std::uint32_t node = 0;
    std::uint32_t depth = 1;
    bool isInGrid = false;
    CellRange cells{};
};

class Builder {
  public:
    Builder(const TreeItems& items, const BinnedTreeOptions& options, const base::Executor& executor)
        : options_(options),
          executor_(executor),
          items_(makeItems(items, executor)),
          nodes_(2 * items.boxes.size() - 1) {}

    SpatialTree build(std::span<const base::Box> boxes) {
        std::vector<Task> small;
        splitLarge(small);
        std::vector<std::vector<TreeGrid>> found(small.size());
        executor_.forRange(small.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                buildSubtree(small[i], found[i]);
            }
        });
        for (const std::vector<TreeGrid>& part : found) {
            grids_.insert(grids_.end(), part.begin(), part.end());
        }
        std::sort(grids_.begin(), grids_.end(),
                  [](const TreeGrid& a, const TreeGrid& b) { return a.node < b.node; });
        return {std::move(nodes_), std::move(grids_), boxes};
    }

  private:
    // Large nodes, one level of the tree after the other.
    void splitLarge(std::vector<Task>& small) {
        std::vector<Task> level;
        const auto sortIn = [&small](const Task& task, std::vector<Task>& large) {
            (task.count > kTaskItems ? large : small).push_back(task);
        };
        sortIn({0, items_.size()}, level);
        while (!level.empty()) {
            std::vector<std::array<Task, 2>> halves(level.size());
            std::vector<std::vector<TreeGrid>> found(level.size());
            executor_.forRange(level.size(), 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    halves[i] = split(level[i], found[i]);
                }
            });
            std::vector<Task> next;
            for (std::size_t i = 0; i < level.size(); ++i) {
                sortIn(halves[i][0], next);
                sortIn(halves[i][1], next);
                grids_.insert(grids_.end(), found[i].begin(), found[i].end());
            }
            level = std::move(next);
        }
    }

    void buildSubtree(const Task& root, std::vector<TreeGrid>& found) {
        std::vector<Task> stack{root};
        while (!stack.empty()) {
            const Task task = stack.back();
            stack.pop_back();
            if (task.count == 1) {
                nodes_[task.node].item = items_[task.first].index();
                continue;
            }
            const auto halves = split(task, found);
            stack.push_back(halves[1]);
            stack.push_back(halves[0]);
        }
    }

    // A subtree over n items has 2 n - 1 nodes: where its halves start is known before they are made.
    std::array<Task, 2> split(Task task, std::vector<TreeGrid>& found) {
        const std::span<BuildItem> items(items_.data() + task.first, task.count);
        Task second = task;
        const std::size_t count = countFirst(items, task, second.cells, found);
        second.first += count;
        second.count -= count;
        second.node = task.node + 2 * static_cast<std::uint32_t>(count);
        second.isInGrid = task.isInGrid;
        second.depth = task.depth + 1;
        nodes_[task.node].right = second.node;
        task.count = count;
        task.node += 1;
        task.depth += 1;
        return {task, second};
    }

    std::size_t countFirst(std::span<BuildItem> items, Task& task, CellRange& secondCells,
                           std::vector<TreeGrid>& found) {
        // From here on, halving just reaches the leaves in time.
        const bool isBalanced =
            task.depth + static_cast<std::uint32_t>(std::bit_width(items.size() - 1)) >= kHalvingDepth;
        const bool asksBox =
            !isBalanced && (options_.splitsLongFirst || (options_.usesGrids && !task.isInGrid));
        const Extent within = asksBox ? extentOf(items, executor_) : Extent{};
        if (options_.usesGrids && !isBalanced && !task.isInGrid) {
            if (const auto grid = findGrid(items, within)) {
                task.isInGrid = true;
                task.cells = *grid;
                found.push_back({task.node, grid->counts()});
            }
        }
        if (task.isInGrid && !isBalanced && !task.cells.isOneCell()) {
            if (const std::size_t count = splitCells(items, task.cells, secondCells)) {
                return count;
            }
            secondCells = task.cells;
        }
        return splitItems(items, within, options_, isBalanced, executor_);
    }

    /// One level is left for the root over two joined trees.
    static constexpr std::uint32_t kHalvingDepth = SpatialTree::kMaxDepth - 1;

    const BinnedTreeOptions& options_;
    const base::Executor& executor_;
    std::vector<BuildItem> items_;
    std::vector<SpatialTree::Node> nodes_;
    std::vector<TreeGrid> grids_;
};

}  // namespace

SpatialTree buildBinnedTree(const TreeItems& items, const BinnedTreeOptions& options,
                            const base::Executor& executor) {
    return Builder(items, options, executor).build(items.boxes);
}

}  // namespace fluxwalk::rays
