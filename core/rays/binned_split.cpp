#include "core/rays/binned_split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace fluxwalk::rays {

namespace {

constexpr std::size_t kBins = 16;
/// Up to this many items every split is tried.
constexpr std::size_t kFew = 8;
/// Items that are summed up in one go. The order of sums depends on this, never on the number of threads.
constexpr std::size_t kChunk = 16384;
/// Middles closer than this, relative to the scene, are one.
constexpr float kSamePlace = 1e-20f;
/// A box is long when its largest side exceeds the next by this factor, and can be cut across its length when
/// the middles of the items spread over this part of it.
constexpr float kLong = 4.0f;
constexpr float kLeastSpread = 0.25f;

/// Items seen as one half of a split.
struct ItemSet {
    Extent box;
    Float4 normal{};
    std::uint32_t count = 0;

    void add(const BuildItem& item) {
        box.add(item.lower, item.upper);
        normal += item.normal;
        ++count;
    }
    void add(const ItemSet& other) {
        box.add(other.box.lower, other.box.upper);
        normal += other.normal;
        count += other.count;
    }
    float cost(float orientationWeight) const {
        const Float4 d = box.size();
        float cost = (d[0] * d[1] + d[1] * d[2] + d[2] * d[0]) * static_cast<float>(count);
        if (orientationWeight > 0.0f && normal[3] > 0.0f) {
            // A cap's mean normal has the length 1 - solid angle / 4 pi.
            const Float4 n = normal * normal;
            cost *= 1.0f + orientationWeight * (1.0f - std::sqrt(n[0] + n[1] + n[2]) / normal[3]);
        }
        return cost;
    }
};

struct Choice {
    float cost = std::numeric_limits<float>::infinity();
    std::uint32_t larger = 0;  ///< items in the larger half
    int axis = -1;
    std::size_t border = 0;  ///< first bin, or first place in the order, of the second half

    // Boxes without surface cost nothing: then equal numbers decide.
    bool isWorseThan(const Choice& other) const {
        return cost > other.cost || (cost == other.cost && larger > other.larger);
    }
};

using Bins = std::array<std::array<ItemSet, kBins>, 3>;

/// Calls body(begin, end, part) for chunks of `count` items, part[chunk] being its own, and folds the parts
/// in their order.
template <class Part, class Body>
Part foldChunks(std::size_t count, const base::Executor& executor, const Body& body) {
    Part whole;
    if (count <= kChunk) {
        body(0, count, whole);
        return whole;
    }
    std::vector<Part> parts((count + kChunk - 1) / kChunk);
    executor.forRange(count, kChunk,
                      [&](std::size_t begin, std::size_t end) { body(begin, end, parts[begin / kChunk]); });
    for (const Part& part : parts) {
        whole.add(part);
    }
    return whole;
}

struct Box {
    Extent extent;
    void add(const Box& other) { extent.add(other.extent.lower, other.extent.upper); }
};

Extent centersOf(std::span<const BuildItem> items, const base::Executor& executor) {
    return foldChunks<Box>(items.size(), executor,
                           [&](std::size_t begin, std::size_t end, Box& box) {
                               for (std::size_t i = begin; i < end; ++i) {
                                   const Float4 center = items[i].center();
                                   box.extent.add(center, center);
                               }
                           })
        .extent;
}

/// Which bin an item's middle falls into, on each axis.
struct Binning {
    Float4 origin;
    Float4 scale;

    explicit Binning(const Extent& centers) : origin(centers.lower), scale{} {
        const Float4 size = centers.size();
        for (int axis = 0; axis < 3; ++axis) {
            // Just short of the last bin's end, so that the last middle falls into it.
            scale[axis] = size[axis] > kSamePlace ? static_cast<float>(kBins) * 0.9999f / size[axis] : 0.0f;
        }
    }
    Int4 of(const BuildItem& item) const {
        return __builtin_convertvector((item.center() - origin) * scale, Int4);
    }
};

struct BinSums {
    Bins bins{};
    void add(const BinSums& other) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < kBins; ++i) {
                bins[axis][i].add(other.bins[axis][i]);
            }
        }
    }
};

using Axes = std::array<bool, 3>;

Choice chooseBorder(const Bins& bins, const Axes& axes, std::uint32_t total, float orientationWeight) {
    Choice best;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (!axes[a]) {
            continue;
        }
        std::array<float, kBins> behind{};
        ItemSet second;
        for (std::size_t i = kBins; i-- > 1;) {
            second.add(bins[a][i]);
            behind[i] = second.cost(orientationWeight);
        }
        ItemSet first;
        for (std::size_t i = 1; i < kBins; ++i) {
            if (bins[a][i - 1].count == 0) {
                continue;  // the same halves as one border before; the first bin is never empty
            }
            first.add(bins[a][i - 1]);
            const Choice choice{first.cost(orientationWeight) + behind[i],
                                std::max(first.count, total - first.count), axis, i};
            if (best.isWorseThan(choice)) {
                best = choice;
            }
        }
    }
    return best;
}

std::size_t splitBins(std::span<BuildItem> items, const Extent& centers, const Axes& axes,
                      float orientationWeight, const base::Executor& executor) {
    const Binning binning(centers);
    const BinSums sums =
        foldChunks<BinSums>(items.size(), executor, [&](std::size_t begin, std::size_t end, BinSums& part) {
            for (std::size_t i = begin; i < end; ++i) {
                const Int4 bin = binning.of(items[i]);
                part.bins[0][static_cast<std::size_t>(bin[0])].add(items[i]);
                part.bins[1][static_cast<std::size_t>(bin[1])].add(items[i]);
                part.bins[2][static_cast<std::size_t>(bin[2])].add(items[i]);
            }
        });
    const Choice choice =
        chooseBorder(sums.bins, axes, static_cast<std::uint32_t>(items.size()), orientationWeight);
    const auto middle = std::partition(items.begin(), items.end(), [&](const BuildItem& item) {
        return binning.of(item)[choice.axis] < static_cast<std::int32_t>(choice.border);
    });
    return static_cast<std::size_t>(middle - items.begin());
}

std::size_t splitFew(std::span<BuildItem> items, const Axes& axes, float orientationWeight) {
    const std::size_t count = items.size();
    Choice best;
    std::array<std::uint8_t, kFew> bestOrder{};
    for (int axis = 0; axis < 3; ++axis) {
        if (!axes[static_cast<std::size_t>(axis)]) {
            continue;
        }
        std::array<std::uint8_t, kFew> order{};
        std::array<float, kFew> place{};
        for (std::size_t i = 0; i < count; ++i) {
            const float center = items[i].center()[axis];
            std::size_t at = i;
            for (; at > 0 && place[at - 1] > center; --at) {
                place[at] = place[at - 1];
                order[at] = order[at - 1];
            }
            place[at] = center;
            order[at] = static_cast<std::uint8_t>(i);
        }
        std::array<float, kFew> behind{};
        ItemSet second;
        for (std::size_t i = count; i-- > 1;) {
            second.add(items[order[i]]);
            behind[i] = second.cost(orientationWeight);
        }
        ItemSet first;
        for (std::size_t i = 1; i < count; ++i) {
            first.add(items[order[i - 1]]);
            const Choice choice{first.cost(orientationWeight) + behind[i],
                                static_cast<std::uint32_t>(std::max(i, count - i)), axis, i};
            if (best.isWorseThan(choice)) {
                best = choice;
                bestOrder = order;
            }
        }
    }
    std::array<BuildItem, kFew> sorted;
    for (std::size_t i = 0; i < count; ++i) {
        sorted[i] = items[bestOrder[i]];
    }
    std::copy_n(sorted.begin(), count, items.begin());
    return best.border;
}

std::size_t splitInHalves(std::span<BuildItem> items, const Float4& spread) {
    int axis = spread[1] > spread[0] ? 1 : 0;
    axis = spread[2] > spread[axis] ? 2 : axis;
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    std::nth_element(items.begin(), middle, items.end(), [axis](const BuildItem& a, const BuildItem& b) {
        const float ca = a.center()[axis];
        const float cb = b.center()[axis];
        return ca != cb ? ca < cb : a.index() < b.index();
    });
    return items.size() / 2;
}

}  // namespace

Extent extentOf(std::span<const BuildItem> items, const base::Executor& executor) {
    return foldChunks<Box>(items.size(), executor,
                           [&](std::size_t begin, std::size_t end, Box& box) {
                               for (std::size_t i = begin; i < end; ++i) {
                                   box.extent.add(items[i].lower, items[i].upper);
                               }
                           })
        .extent;
}

std::size_t splitItems(std::span<BuildItem> items, const Extent& within, const BinnedTreeOptions& options,
                       bool isBalanced, const base::Executor& executor) {
    if (items.size() == 2) {
        return 1;
    }
    const Extent centers = centersOf(items, executor);
    const Float4 spread = centers.size();
    Axes axes{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        axes[axis] = spread[static_cast<int>(axis)] > kSamePlace;
    }
    if (isBalanced || !(axes[0] || axes[1] || axes[2])) {
        return splitInHalves(items, spread);
    }
    if (options.splitsLongFirst) {
        const Float4 size = within.size();
        int longest = size[1] > size[0] ? 1 : 0;
        longest = size[2] > size[longest] ? 2 : longest;
        const float next = std::max(size[(longest + 1) % 3], size[(longest + 2) % 3]);
        if (size[longest] > kLong * next && 0.5f * spread[longest] > kLeastSpread * size[longest]) {
            axes = {longest == 0, longest == 1, longest == 2};
        }
    }
    return items.size() <= kFew ? splitFew(items, axes, options.orientationWeight)
                                : splitBins(items, centers, axes, options.orientationWeight, executor);
}

}  // namespace fluxwalk::rays
