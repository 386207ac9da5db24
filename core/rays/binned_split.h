#pragma once

#include <cstddef>
#include <span>

#include "core/base/parallel.h"
#include "core/rays/binned_tree.h"
#include "core/rays/build_item.h"

namespace fluxwalk::rays {

/// Reorders `items` (two at least) into two halves, neither empty, and returns the size of the first.
/// `within`: what holds all items. Halves of equal numbers where the surface cannot tell, or where
/// `isBalanced`.
std::size_t splitItems(std::span<BuildItem> items, const Extent& within, const BinnedTreeOptions& options,
                       bool isBalanced, const base::Executor& executor);

/// Box of all items.
Extent extentOf(std::span<const BuildItem> items, const base::Executor& executor);

}  // namespace fluxwalk::rays
