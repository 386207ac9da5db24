#include "core/surface/strips.h"

#include <algorithm>

namespace fluxwalk::surface {

Strips chooseStrips(double alongU, double alongV) {
    // At 2 a strip is as far from a square as a quarter, which is like the patch; quarters are kept where
    // there is little to gain.
    constexpr double kLongest = 2.8;
    constexpr unsigned kMostLevels = 8;
    Strips strips;
    strips.alongV = alongV > alongU;
    const double least = std::min(alongU, alongV);
    for (double most = std::max(alongU, alongV); most > kLongest * least && strips.levels < kMostLevels;
         most *= 0.25) {
        ++strips.levels;
    }
    return strips;
}

Strips measureStrips(const std::function<Vec3d(const Vec2d& uv)>& at) {
    constexpr unsigned kLines = 3;
    constexpr unsigned kChords = 4;
    const auto lengthAlong = [&](bool alongV) {
        double sum = 0.0;
        for (unsigned line = 0; line < kLines; ++line) {
            const double across = static_cast<double>(line) / (kLines - 1);
            const auto pointAt = [&](unsigned i) {
                const double along = static_cast<double>(i) / kChords;
                return at(alongV ? Vec2d(across, along) : Vec2d(along, across));
            };
            for (unsigned i = 0; i < kChords; ++i) {
                sum += glm::distance(pointAt(i), pointAt(i + 1));
            }
        }
        return sum;
    };
    constexpr unsigned kQuarteredBefore = 1;
    Strips strips = chooseStrips(lengthAlong(false), lengthAlong(true));
    strips.from = kQuarteredBefore;
    return strips;
}

}  // namespace fluxwalk::surface
