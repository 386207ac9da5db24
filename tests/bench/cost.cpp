#include "tests/bench/cost.h"

#include <algorithm>
#include <cmath>

namespace fluxwalk::bench {

namespace {

double bytesOf(const solve::Counters& c) {
    return static_cast<double>(c.bytesNodes + c.bytesLinks);
}

}  // namespace

Cost costAt(std::span<const Level> levels, const ErrorTarget& target) {
    const Level* below = firstBelow(levels, target.what, target.error);
    if (below == nullptr) {
        return {};
    }
    double part = 1.0;
    const Level& above = below == levels.data() ? *below : *(below - 1);
    if (&above != below) {
        const double from = above.errors.of(target.what);
        const double to = std::max(below->errors.of(target.what), 1e-3 * target.error);
        part = std::log(from / target.error) / std::log(from / to);
    }
    const auto between = [part](double from, double to) { return from * std::pow(to / from, part); };
    const solve::Counters& from = above.statistics.counters;
    const solve::Counters& to = below->statistics.counters;
    const auto count = [&](std::uint64_t solve::Counters::*member) {
        return between(static_cast<double>(from.*member), static_cast<double>(to.*member));
    };
    return {true,
            count(&solve::Counters::leaves),
            count(&solve::Counters::links),
            count(&solve::Counters::rays),
            between(above.duration.seconds, below->duration.seconds),
            between(above.duration.cpuSeconds, below->duration.cpuSeconds),
            between(bytesOf(from), bytesOf(to))};
}

}  // namespace fluxwalk::bench
