#include "core/cli/suggest.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace fluxwalk::cli {

std::size_t editDistance(std::string_view a, std::string_view b) {
    // Three rows of the table of distances between prefixes: a's first i letters against b's first j.
    std::vector<std::size_t> beforeLast(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) {
        row[j] = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        beforeLast.swap(last);
        last.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({substitution, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
            }
        }
    }
    return row[b.size()];
}

std::optional<std::string> suggestNearest(std::string_view word, std::span<const std::string> candidates) {
    // Dashes say nothing about which option was meant.
    const std::size_t dashes = std::min(word.find_first_not_of('-'), word.size());
    const std::size_t letters = word.size() - dashes;
    std::size_t allowed = letters <= 2 ? 0 : std::clamp<std::size_t>(letters / 3, 1, 2);
    std::optional<std::string> nearest;
    for (const std::string& candidate : candidates) {
        const std::size_t distance =
            editDistance(word.substr(dashes),
                         candidate.substr(std::min(candidate.find_first_not_of('-'), candidate.size())));
        if (distance < allowed || (distance == allowed && !nearest)) {
            nearest = candidate;
            allowed = distance;
        }
    }
    return nearest;
}

std::string didYouMean(std::string_view word, std::span<const std::string> candidates) {
    const std::optional<std::string> nearest = suggestNearest(word, candidates);
    return nearest ? fmt::format("; did you mean '{}'?", *nearest) : std::string();
}

}  // namespace fluxwalk::cli
