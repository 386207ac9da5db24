#include "core/image/final_gather.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include <glm/gtc/packing.hpp>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/image/column_gather.h"

namespace fluxwalk::image {

namespace {

using base::Vec2d;

/// A pixel gets more samples where its light and that of a neighbour differ by more than this part.
constexpr float kContrast = 0.08f;
/// Light is taken over between places whose normals differ by less (cosine), and whose distance from each
/// other's plane is less than this part of their distance.
constexpr float kSameNormal = 0.98f;
constexpr float kSamePlane = 0.12f;
/// Pixels around one over which noise is averaged, the falls of their weights with the square of the distance
/// and with that of the difference in its standard errors, and the least of these as a part of the
/// irradiance.
constexpr int kSmoothReach = 3;
constexpr float kFall = 0.12f;
/// Reach in pixels of the light of a pixel's middle.
constexpr double kReach = 1.25;
constexpr float kInversePi = static_cast<float>(1.0 / base::kPi);

/// What the middle of a pixel sees.
struct Middle {
    std::uint32_t object = 0;  ///< from 1; 0 for none
    bool hasTexture = false;
    base::Vec3 position{};
    base::Vec3 normal{};
    base::Vec3 shading{};
    Rgb reflectance{0.0f};
    NodeId leaf = NodeId::none;
    PixelLight light;      ///< as gathered
    Rgb irradiance{0.0f};  ///< with the noise taken off
    Rgb luminance{0.0f};   ///< emitted, and reflected once the irradiance is known
};

/// One row of tiles.
struct Strip {
    std::uint32_t index = 0;
    std::vector<Middle> middles;
};

/// A sample beside the middle of its pixel.
struct Extra {
    std::uint32_t pixel = 0;  ///< of the tile
    bool isSeen = false;
    bool isLit = false;  ///< its light is known
    Seen seen;
    Rgb sky{0.0f};
    PixelLight light;
    Rgb irradiance{0.0f};
};

bool isSameSurface(const Seen& a, const Middle& b) {
    if (a.object + 1 != b.object || glm::dot(base::Vec3(a.point.normal), b.normal) < kSameNormal ||
        glm::dot(base::Vec3(a.point.shading), b.shading) < kSameNormal) {
        return false;
    }
    const base::Vec3 between = base::Vec3(a.point.position) - b.position;
    return std::abs(glm::dot(between, b.normal)) <= kSamePlane * glm::length(between);
}

bool differ(const Middle& a, const Middle& b) {
    if (a.object != b.object || glm::dot(a.normal, b.normal) < kSameNormal) {
        return true;
    }
    const float x = base::channelMean(a.luminance);
    const float y = base::channelMean(b.luminance);
    return std::abs(x - y) > kContrast * std::max(x, y);
}

// Rays of neighbouring pixels interleave, so that their mean is more exact than each by more than their
// number. (Roberts 2018, The unreasonable effectiveness of quasirandom sequences: the plastic number's
// lattice.)
double phaseAt(std::uint32_t x, std::uint32_t y) {
    const double place = 0.7548776662466927 * x + 0.5698402909980532 * y;
    return place - std::floor(place);
}

class StillMaker {
  public:
    StillMaker(const solve::Problem& problem, const scene::Camera& camera, const StillOptions& options,
               const StillCallbacks& callbacks)
        : problem_(problem),
          options_(options),
          callbacks_(callbacks),
          lens_(camera, options.width, options.height),
          points_(problem.hierarchy) {
        const std::size_t pixels = static_cast<std::size_t>(options.width) * options.height;
        still_.width = options.width;
        still_.height = options.height;
        still_.luminance.resize(3 * pixels);
        still_.irradiance.resize(3 * pixels);
        still_.albedo.resize(3 * pixels);
        still_.normal.resize(3 * pixels);
        still_.object.resize(pixels);
        for (std::uint32_t x = 0; x < options.width; x += kTile) {
            columns_.emplace_back(problem, points_, options.rays);
        }
    }

    Still run() {
        const std::uint32_t rows = (options_.height + kTile - 1) / kTile;
        for (std::uint32_t row = 0; row < rows && !isStopped_; ++row) {
            Strip& strip = strips_[row % strips_.size()];
            strip.index = row;
            strip.middles.assign(static_cast<std::size_t>(options_.width) * kTile, Middle{});
            eachTile([&](std::uint32_t column) { lookAt(column, strip); });
            // Noise is taken off with the rows around known, edges are smoothed with these done.
            if (row > 0) {
                smoothRow(row - 1);
            }
            if (row > 1) {
                finishRow(row - 2, rows);
            }
        }
        if (rows > 1) {
            smoothRow(rows - 1);
            finishRow(rows - 2, rows);
        } else {
            smoothRow(0);
        }
        finishRow(rows - 1, rows);
        for (const ColumnGather& column : columns_) {
            still_.rays += column.rays();
            still_.gathers += column.gathers();
        }
        return std::move(still_);
    }

  private:
    void eachTile(const std::function<void(std::uint32_t)>& body) {
        problem_.executor.forRange(columns_.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (isStopped_ || (callbacks_.shouldStop && callbacks_.shouldStop())) {
                    isStopped_ = true;
                    return;
                }
                body(static_cast<std::uint32_t>(i));
            }
        });
    }

    void smoothRow(std::uint32_t row) {
        if (!isStopped_) {
            eachTile([&](std::uint32_t column) { smooth(column, row); });
        }
    }

    void finishRow(std::uint32_t row, std::uint32_t rows) {
        if (isStopped_) {
            return;
        }
        eachTile([&](std::uint32_t column) { finish(column, row); });
        if (!isStopped_) {
            still_.rowsDone = std::min(options_.height, (row + 1) * kTile);
            if (callbacks_.progress) {
                callbacks_.progress(static_cast<double>(row + 1) / rows);
            }
        }
    }

    StillTile tileAt(std::uint32_t column, std::uint32_t row) const {
        const std::uint32_t left = column * kTile;
        const std::uint32_t top = row * kTile;
        return {left, top, std::min(kTile, options_.width - left), std::min(kTile, options_.height - top)};
    }

    std::uint64_t keyOf(std::uint32_t x, std::uint32_t y, unsigned sample) const {
        const std::uint64_t pixel = static_cast<std::uint64_t>(y) * options_.width + x;
        return base::combine(base::combine(options_.seed, pixel), sample);
    }

    // What the middles of a tile's pixels see, and the light there.
    void lookAt(std::uint32_t columnIndex, Strip& strip) {
        ColumnGather& column = columns_[columnIndex];
        column.forget(strip.index);
        const StillTile tile = tileAt(columnIndex, strip.index);
        std::vector<Seen> seen(static_cast<std::size_t>(tile.width) * tile.height);
        std::vector<Wanted> wanted;
        for (std::uint32_t y = 0; y < tile.height; ++y) {
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                Middle& middle = strip.middles[static_cast<std::size_t>(y) * options_.width + tile.left + x];
                const Vec3d direction = lens_.directionAt({tile.left + x + 0.5, tile.top + y + 0.5});
                auto found = lookAlong(problem_, lens_.eye(), direction);
                if (!found) {
                    middle.luminance = skyLuminance(problem_, direction);
                    continue;
                }
                Seen& here = seen[static_cast<std::size_t>(y) * tile.width + x];
                here = *found;
                here.point.key = keyOf(tile.left + x, tile.top + y, 0);
                here.point.phase = phaseAt(tile.left + x, tile.top + y);
                middle.object = here.object + 1;
                middle.leaf = here.leaf;
                middle.hasTexture = here.hasTexture || here.hasRelief;
                middle.position = base::Vec3(here.point.position);
                middle.normal = base::Vec3(here.point.normal);
                middle.shading = base::Vec3(here.point.shading);
                middle.reflectance = here.reflectance;
                // Made whole below.
                middle.luminance = here.emission * kInversePi;
                if (here.leaf != NodeId::none && here.reflectance != Rgb(0.0f)) {
                    wanted.push_back({&here, &middle.light});
                }
            }
        }
        column.light(wanted, strip.index);
    }

    // The correction of a pixel's light, averaged over its surroundings on the same element where it differs
    // by no more than noise does. Elements have corrections of their own.
    Rgb smoothCorrection(const Middle& middle, std::int64_t x, std::int64_t y) const {
        Rgb sum(0.0f);
        float weights = 0.0f;
        for (int dy = -kSmoothReach; dy <= kSmoothReach; ++dy) {
            for (int dx = -kSmoothReach; dx <= kSmoothReach; ++dx) {
                const Middle* other = middleAt(x + dx, y + dy);
                if (other == nullptr || other->leaf != middle.leaf ||
                    glm::dot(other->shading, middle.shading) < kSameNormal) {
                    continue;
                }
                const auto away = static_cast<float>(dx * dx + dy * dy);
                const float weight = likeness(middle.light, other->light) * std::exp(-kFall * away);
                sum += weight * other->light.correction;
                weights += weight;
            }
        }
        return sum / weights;
    }

    void smooth(std::uint32_t columnIndex, std::uint32_t row) {
        const StillTile tile = tileAt(columnIndex, row);
        Strip& strip = strips_[row % strips_.size()];
        for (std::uint32_t y = 0; y < tile.height; ++y) {
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                Middle& middle = strip.middles[static_cast<std::size_t>(y) * options_.width + tile.left + x];
                if (middle.leaf == NodeId::none) {
                    continue;
                }
                middle.irradiance = glm::max(
                    middle.light.steady + smoothCorrection(middle, tile.left + x, tile.top + y), Rgb(0.0f));
                middle.luminance += middle.reflectance * middle.irradiance * kInversePi;
            }
        }
    }

    const Middle* middleAt(std::int64_t x, std::int64_t y) const {
        if (x < 0 || y < 0 || x >= options_.width || y >= options_.height) {
            return nullptr;
        }
        const auto row = static_cast<std::uint32_t>(y) / kTile;
        const Strip& strip = strips_[row % strips_.size()];
        return &strip.middles[static_cast<std::size_t>(y % kTile) * options_.width +
                              static_cast<std::size_t>(x)];
    }

    bool needsMore(std::uint32_t x, std::uint32_t y) const {
        const Middle& middle = *middleAt(x, y);
        if (options_.samples < 2) {
            return false;
        }
        if (middle.hasTexture) {
            return true;
        }
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const Middle* other = middleAt(std::int64_t{x} + dx, std::int64_t{y} + dy);
                if (other != nullptr && differ(middle, *other)) {
                    return true;
                }
            }
        }
        return hidesSomething(x, y);
    }

    // Whether a pixel shows something thin that the middles of it and of those around miss.
    bool hidesSomething(std::uint32_t x, std::uint32_t y) const {
        constexpr std::array<Vec2d, 4> kProbes{Vec2d(0.125, 0.625), Vec2d(0.375, 0.125), Vec2d(0.625, 0.875),
                                               Vec2d(0.875, 0.375)};
        const std::uint32_t object = middleAt(x, y)->object;
        return std::any_of(kProbes.begin(), kProbes.end(), [&](const Vec2d& probe) {
            const rays::Ray ray{base::Vec3(lens_.eye()), 0.0f,
                                base::Vec3(lens_.directionAt(Vec2d(x, y) + probe)),
                                std::numeric_limits<float>::max()};
            const auto hit = problem_.rays.closest(ray);
            return (hit ? base::index(hit->object) + 1 : 0u) != object;
        });
    }

    // Light of the middles around a place, where they lie on the same surface. False where none does.
    bool takeOver(Extra& extra, std::uint32_t x, std::uint32_t y, const Vec2d& place) const {
        double sum = 0.0;
        Vec3d light(0.0);
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const double reachX = kReach - std::abs(place.x - (dx + 0.5));
                const double reachY = kReach - std::abs(place.y - (dy + 0.5));
                const Middle* other = middleAt(std::int64_t{x} + dx, std::int64_t{y} + dy);
                if (reachX <= 0.0 || reachY <= 0.0 || other == nullptr ||
                    !isSameSurface(extra.seen, *other)) {
                    continue;
                }
                sum += reachX * reachY;
                light += reachX * reachY * Vec3d(other->irradiance);
            }
        }
        if (!(sum > 0.0)) {
            return false;
        }
        extra.irradiance = Rgb(light / sum);
        return true;
    }

    void finish(std::uint32_t columnIndex, std::uint32_t row) {
        const StillTile tile = tileAt(columnIndex, row);
        std::vector<Extra> extras;
        for (std::uint32_t y = 0; y < tile.height; ++y) {
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                store(tile.left + x, tile.top + y, *middleAt(tile.left + x, tile.top + y));
                if (needsMore(tile.left + x, tile.top + y)) {
                    lookBeside(tile, x, y, extras);
                }
            }
        }
        std::vector<Wanted> wanted;
        for (Extra& extra : extras) {
            if (extra.isSeen && !extra.isLit) {
                wanted.push_back({&extra.seen, &extra.light});
            }
        }
        columns_[columnIndex].light(wanted, row);
        for (Extra& extra : extras) {
            if (extra.isSeen && !extra.isLit) {
                extra.irradiance = extra.light.sum();
            }
        }
        for (std::size_t first = 0; first < extras.size(); first += options_.samples) {
            average(tile, std::span(extras).subspan(first, options_.samples));
        }
        if (callbacks_.tileDone) {
            callbacks_.tileDone(still_, tile);
        }
    }

    void lookBeside(const StillTile& tile, std::uint32_t x, std::uint32_t y,
                    std::vector<Extra>& extras) const {
        for (unsigned k = 0; k < options_.samples; ++k) {
            const Vec2d place = base::r2Point(k, Vec2d(0.5));
            Extra& extra = extras.emplace_back();
            extra.pixel = y * tile.width + x;
            const Vec3d direction = lens_.directionAt(Vec2d(tile.left + x, tile.top + y) + place);
            const auto found = lookAlong(problem_, lens_.eye(), direction);
            if (!found) {
                extra.sky = skyLuminance(problem_, direction);
                continue;
            }
            extra.isSeen = true;
            extra.seen = *found;
            extra.seen.point.key = keyOf(tile.left + x, tile.top + y, k + 1);
            extra.isLit = found->leaf == NodeId::none || found->reflectance == Rgb(0.0f) ||
                          takeOver(extra, tile.left + x, tile.top + y, place);
        }
    }

    void average(const StillTile& tile, std::span<const Extra> extras) {
        Middle mean;
        const std::uint32_t x = tile.left + extras.front().pixel % tile.width;
        const std::uint32_t y = tile.top + extras.front().pixel / tile.width;
        const float part = 1.0f / static_cast<float>(extras.size());
        for (const Extra& extra : extras) {
            if (!extra.isSeen) {
                mean.luminance += part * extra.sky;
                continue;
            }
            const Seen& seen = extra.seen;
            mean.luminance += part * kInversePi * (seen.emission + seen.reflectance * extra.irradiance);
            mean.irradiance += part * extra.irradiance;
            mean.reflectance += part * seen.reflectance;
            mean.shading += part * base::Vec3(seen.point.shading);
        }
        const float length = glm::length(mean.shading);
        mean.shading = length > 0.0f ? mean.shading / length : mean.shading;
        mean.object = middleAt(x, y)->object;
        store(x, y, mean);
    }

    void store(std::uint32_t x, std::uint32_t y, const Middle& middle) {
        const std::size_t pixel = static_cast<std::size_t>(y) * options_.width + x;
        still_.object[pixel] = middle.object;
        for (int c = 0; c < 3; ++c) {
            const std::size_t at = 3 * pixel + static_cast<std::size_t>(c);
            still_.luminance[at] = middle.luminance[c];
            still_.irradiance[at] = middle.irradiance[c];
            still_.albedo[at] = glm::packHalf1x16(middle.reflectance[c]);
            still_.normal[at] = glm::packHalf1x16(middle.shading[c]);
        }
    }

    const solve::Problem& problem_;
    StillOptions options_;
    const StillCallbacks& callbacks_;
    Lens lens_;
    Still still_;
    SourcePoints points_;
    std::vector<ColumnGather> columns_;
    std::array<Strip, 4> strips_;
    std::atomic<bool> isStopped_{false};
};

}  // namespace

Still takeStill(const solve::Problem& problem, const scene::Camera& camera, const StillOptions& options,
                const StillCallbacks& callbacks) {
    FLUXWALK_CHECK(options.width > 0 && options.height > 0 && options.samples > 0);
    return StillMaker(problem, camera, options, callbacks).run();
}

}  // namespace fluxwalk::image
