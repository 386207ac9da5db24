#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fluxwalk::cli {

/// Smallest number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`, no
/// part being edited twice (optimal string alignment).
std::size_t editDistance(std::string_view a, std::string_view b);

/// The candidate nearest to a mistyped word, the first of equals; nothing where none is near: at most two
/// edits, and at most a third of the word's letters.
std::optional<std::string> suggestNearest(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean 'solve'?", or empty where nothing is near.
std::string didYouMean(std::string_view word, std::span<const std::string> candidates);

}  // namespace fluxwalk::cli
