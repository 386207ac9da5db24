#include "core/reference/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.h"

namespace fluxwalk::reference {

namespace {

/// Two-sided 99 % of a normal distribution.
constexpr double kDeviations = 2.5758;

}  // namespace

Agreement compare(std::span<const Claim> claims, std::span<const Estimate> truth, std::size_t worstCount) {
    FLUXWALK_CHECK_EQ(claims.size(), truth.size());
    Agreement result;
    double squares = 0.0;
    double noise = 0.0;
    double off = 0.0;
    std::vector<double> widths;
    std::vector<double> severity(claims.size(), -1.0);
    for (std::size_t i = 0; i < claims.size(); ++i) {
        const Claim& claim = claims[i];
        const double error = truth[i].luminanceError;
        if (!std::isfinite(error)) {
            continue;
        }
        const double expected = truth[i].luminance;
        const double difference = claim.value - expected;
        ++result.count;
        result.mean += expected;
        squares += difference * difference;
        noise += error * error;
        off += difference;
        const double slack = kDeviations * error;
        result.held += expected + slack >= claim.low && expected - slack <= claim.high ? 1u : 0u;
        if (claim.value > 0.0) {
            widths.push_back((claim.high - claim.low) / claim.value);
        }
        const double scale = error + 0.5 * (claim.high - claim.low) / kDeviations;
        // What claims to be exact and is not is worst.
        severity[i] = scale > 0.0                  ? std::abs(difference) / scale
                      : std::abs(difference) > 0.0 ? std::numeric_limits<double>::infinity()
                                                   : 0.0;
        result.worst.push_back(i);
    }
    if (result.count == 0) {
        return result;
    }
    const auto n = static_cast<double>(result.count);
    result.mean /= n;
    if (result.mean > 0.0) {
        result.rms = std::sqrt(std::max(0.0, squares - noise) / n) / result.mean;
        result.noise = std::sqrt(noise / n) / result.mean;
        result.bias = off / n / result.mean;
        result.biasError = std::sqrt(noise) / n / result.mean;
    }
    if (!widths.empty()) {
        const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
        std::nth_element(widths.begin(), middle, widths.end());
        result.medianWidth = *middle;
    }
    const std::size_t kept = std::min(worstCount, result.worst.size());
    std::partial_sort(result.worst.begin(), result.worst.begin() + static_cast<std::ptrdiff_t>(kept),
                      result.worst.end(), [&](std::size_t a, std::size_t b) {
                          return severity[a] != severity[b] ? severity[a] > severity[b] : a < b;
                      });
    result.worst.resize(kept);
    return result;
}

}  // namespace fluxwalk::reference
