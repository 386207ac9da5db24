#include "core/image/leaf_gather.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/base/random.h"

namespace fluxwalk::image {

namespace {

using base::Vec2d;
using display::Cell;
using display::GridPoint;

/// Points are moved towards the middle of their cell by so many lifts of rays, so that they lie on no other
/// object that touches the leaf along its border, and by this part of the way at most.
constexpr double kInset = 8.0;
constexpr double kMostInset = 0.0625;
/// Where cells differ so much from one corner to another they are cut though they seem to be linear.
constexpr float kStep = 0.5f;
/// What may be noise in the correction of light (pixel_gather.h) as a part of it, with one ray to weak
/// sources.
constexpr float kNoiseOfRay = 0.8f;
/// Gaps below this part of the least side are too narrow to be shown. Not more: below a ball of 20 cm the gap
/// is still that narrow a whole side away from where it touches.
constexpr double kNarrow = 0.05;
constexpr double kLeastPart = 1.0 / 512.0;
constexpr double kLeastSide = 0.02;  ///< metres

/// Middle of a quad, as quartering finds it.
Vec2d middleUv(const surface::Surface& surface, std::uint32_t patch, const surface::Region& r) {
    return surface.splitPoint(patch, surface.splitPoint(patch, r.corners[3], r.corners[0]),
                              surface.splitPoint(patch, r.corners[1], r.corners[2]));
}

display::PointKey keyOf(const GridPoint& p) {
    return {(static_cast<std::uint64_t>(p.y) << 32) | p.x, 0};
}

float largestOf(const Rgb& difference) {
    const Rgb d = glm::abs(difference);
    return std::max({d.r, d.g, d.b});
}

PixelLight operator+(const PixelLight& a, const PixelLight& b) {
    return {a.steady + b.steady, a.correction + b.correction};
}

PixelLight operator*(float factor, const PixelLight& a) {
    return {factor * a.steady, factor * a.correction};
}

/// Least squares for quadratic functions of two coordinates.
class TermSums {
  public:
    TermSums() {
        for (std::size_t k = 0; k < kTerms; ++k) {
            products_[k][k] = k == 0 ? 1e-6 : kRidge;
        }
    }

    void add(const std::array<double, kTerms>& terms, const Rgb& value) {
        for (std::size_t k = 0; k < kTerms; ++k) {
            for (std::size_t l = 0; l < kTerms; ++l) {
                products_[k][l] += terms[k] * terms[l];
            }
            values_[k] += terms[k] * Vec3d(value);
        }
    }

    std::array<Rgb, kTerms> solve() {
        for (std::size_t i = 0; i < kTerms; ++i) {
            for (std::size_t j = i + 1; j < kTerms; ++j) {
                const double factor = products_[j][i] / products_[i][i];
                for (std::size_t k = i; k < kTerms; ++k) {
                    products_[j][k] -= factor * products_[i][k];
                }
                values_[j] -= factor * values_[i];
            }
        }
        std::array<Rgb, kTerms> result{};
        for (std::size_t i = kTerms; i-- > 0;) {
            Vec3d value = values_[i];
            for (std::size_t j = i + 1; j < kTerms; ++j) {
                value -= products_[i][j] * Vec3d(result[j]);
            }
            result[i] = Rgb(value / products_[i][i]);
        }
        return result;
    }

  private:
    /// Few samples give little but their mean.
    static constexpr double kRidge = 2.0;

    std::array<std::array<double, kTerms>, kTerms> products_{};
    std::array<Vec3d, kTerms> values_{};
};

}  // namespace

/// One leaf at work.
class LeafGather::Work {
  public:
    Work(LeafGather& owner, const display::PatchTopology& topology, NodeId leaf)
        : owner_(owner),
          problem_(owner.problem_),
          h_(problem_.hierarchy),
          topology_(topology),
          surface_(topology.surface()),
          leaf_(leaf),
          name_(h_.name(leaf)),
          known_(64) {}

    display::LeafLight run() {
        display::LeafLight result;
        std::vector<Part> level(1);
        level[0].cell = display::makeCell(topology_, name_.patch, name_.path, 0);
        level[0].region = h_.region(leaf_);
        level[0].isLeaf = true;
        const Cell& whole = level[0].cell;
        const double towards = whole.inverted ? -0.5 : 0.5;
        leafSize_ = {whole.extent.x, whole.extent.y};
        leafMiddle_ = Vec2d(whole.origin.x, whole.origin.y) + towards * leafSize_;
        isHidden_ = !(h_.shape(leaf_).exposed > 0.0f);
        for (unsigned depth = 0; !level.empty(); ++depth) {
            for (Part& part : level) {
                place(part);
            }
            gatherPlaced();
            std::vector<Part> next;
            for (const Part& part : level) {
                if (depth < owner_.sharpness_.mostLevels && mustBeCut(part)) {
                    result.splits.push_back(part.cell.path);
                    cut(part, next);
                }
            }
            level = std::move(next);
        }
        takeOffNoise();
        std::sort(result.splits.begin(), result.splits.end());
        std::sort(samples_.begin(), samples_.end(),
                  [](const display::LightSample& a, const display::LightSample& b) {
                      return a.at.y != b.at.y ? a.at.y < b.at.y : a.at.x < b.at.x;
                  });
        result.samples = std::move(samples_);
        return result;
    }

  private:
    struct Part {
        Cell cell;
        surface::Region region;
        bool isLeaf = false;
        /// What the cell that it is a quarter of says of its middle.
        bool isForetold = false;
        PixelLight foretold;
        /// Samples at its corners; at the middle of quads, or at those of a triangle's sides.
        std::array<std::uint32_t, 4> corners{};
        std::array<std::uint32_t, 3> middles{};

        unsigned cornerCount() const { return cell.cornerCount; }
        unsigned middleCount() const { return cell.cornerCount == 4 ? 1 : 3; }
    };
    /// A sample that waits for its light.
    struct Waiting {
        std::uint32_t sample = 0;
        PixelPoint point;
    };

    std::uint32_t sampleAt(const GridPoint& at, const Vec2d& uv, const Vec2d& towards) {
        const std::uint32_t before = known_.size();
        const std::uint32_t number = known_.insert(keyOf(at));
        if (number < before) {
            return number;
        }
        samples_.push_back({at, Rgb(0.0f), true});
        light_.emplace_back();
        if (isHidden_) {
            return number;
        }
        const Vec3d middle = surface_.evaluate(name_.patch, towards).position;
        const double distance = glm::distance(surface_.evaluate(name_.patch, uv).position, middle);
        const double inset = std::min(kMostInset, kInset * problem_.rays.lift() / std::max(distance, 1e-300));
        const surface::SurfacePoint p = surface_.evaluate(name_.patch, uv + inset * (towards - uv));
        const Vec3d normal = name_.back ? -p.normal : p.normal;
        if (isCovered(p.position, normal)) {
            return number;
        }
        samples_.back().isHidden = false;
        waiting_.push_back({number, {p.position, normal, normal, keyOfPoint(at)}});
        return number;
    }

    std::uint64_t keyOfPoint(const GridPoint& at) const {
        return base::combine(base::combine(h_.key(leaf_), at.x), at.y);
    }

    // Whether a point lies in a solid, or in a gap too narrow to be shown.
    bool isCovered(const Vec3d& position, const Vec3d& normal) const {
        const auto hit = problem_.rays.closest(problem_.rays.halfLine(position, normal, normal));
        if (!hit) {
            return false;
        }
        const std::uint32_t object = base::index(hit->object);
        if (!h_.reached().isReached(object, hit->back)) {
            return true;
        }
        const scene::Material& material = problem_.scene->materials[problem_.scene->objects[object].material];
        return static_cast<double>(hit->t) < kNarrow * owner_.sharpness_.leastSide && !material.isEmissive();
    }

    void place(Part& part) {
        const std::array<GridPoint, 4> at = display::cornersOf(part.cell);
        const auto& uv = part.region.corners;
        if (part.cornerCount() == 4) {
            const Vec2d middle = middleUv(surface_, name_.patch, part.region);
            for (unsigned k = 0; k < 4; ++k) {
                part.corners[k] = sampleAt(at[k], uv[k], middle);
            }
            part.middles[0] = sampleAt(display::middleOf(at[0], at[2]), middle, uv[0]);
            return;
        }
        const Vec2d middle = (uv[0] + uv[1] + uv[2]) / 3.0;
        for (unsigned k = 0; k < 3; ++k) {
            const unsigned next = (k + 1) % 3;
            part.corners[k] = sampleAt(at[k], uv[k], middle);
            part.middles[k] = sampleAt(display::middleOf(at[k], at[next]),
                                       surface_.splitPoint(name_.patch, uv[k], uv[next]), middle);
        }
    }

    void gatherPlaced() {
        if (!waiting_.empty() && sources_.leaf == NodeId::none) {
            sources_ = owner_.finder_.find(leaf_);
        }
        std::array<PixelPoint, PixelGather::kPoints> points;
        std::array<PixelLight, PixelGather::kPoints> light;
        for (std::size_t first = 0; first < waiting_.size(); first += points.size()) {
            const std::size_t count = std::min(points.size(), waiting_.size() - first);
            for (std::size_t i = 0; i < count; ++i) {
                points[i] = waiting_[first + i].point;
            }
            owner_.gather_.gather(sources_, {points.data(), count}, {light.data(), count});
            for (std::size_t i = 0; i < count; ++i) {
                light_[waiting_[first + i].sample] = light[i];
                samples_[waiting_[first + i].sample].irradiance = light[i].sum();
            }
        }
        owner_.pointCount_ += waiting_.size();
        waiting_.clear();
    }

    bool mustBeCut(const Part& part) const {
        const Sharpness& sharpness = owner_.sharpness_;
        if (!(longestSide(part) > sharpness.leastSide) ||
            surface::pathLevel(part.cell.path) >= surface::deepestLevel(surface_, name_.patch)) {
            return false;
        }
        unsigned seen = 0;
        unsigned all = 0;
        PixelLight sum;
        PixelLight least{Rgb(std::numeric_limits<float>::max()), Rgb(std::numeric_limits<float>::max())};
        PixelLight most{-least.steady, -least.correction};
        const auto look = [&](std::uint32_t sample) {
            ++all;
            if (!samples_[sample].isHidden) {
                const PixelLight& e = light_[sample];
                ++seen;
                sum = sum + e;
                least = {glm::min(least.steady, e.steady), glm::min(least.correction, e.correction)};
                most = {glm::max(most.steady, e.steady), glm::max(most.correction, e.correction)};
            }
        };
        for (unsigned k = 0; k < part.cornerCount(); ++k) {
            look(part.corners[k]);
        }
        for (unsigned k = 0; k < part.middleCount(); ++k) {
            look(part.middles[k]);
        }
        if (seen < all) {
            // The border of what stands there is sought.
            return seen > 0;
        }
        const float reference =
            std::max({base::channelMean(sum.sum()) / static_cast<float>(all),
                      sharpness.dark * static_cast<float>(problem_.statistics.meanIrradiance), 1e-20f});
        const float range = sizeOf(most + -1.0f * least, reference);
        if (range > (part.isLeaf || !part.isForetold ? sharpness.range : kStep) * reference) {
            return true;
        }
        return bendOf(part, reference) > sharpness.bend * reference;
    }

    // Of a difference in light, without what may be noise.
    float sizeOf(const PixelLight& difference, float reference) const {
        return largestOf(difference.steady) +
               std::max(0.0f, largestOf(difference.correction) - owner_.noise_ * reference);
    }

    // How far middles are from what is shown without them.
    float bendOf(const Part& part, float reference) const {
        const auto& c = part.corners;
        if (part.cornerCount() == 4) {
            const PixelLight& middle = light_[part.middles[0]];
            const PixelLight mean = 0.25f * (light_[c[0]] + light_[c[1]] + light_[c[2]] + light_[c[3]]);
            const float bend = sizeOf(middle + -1.0f * mean, reference);
            return part.isForetold ? std::max(bend, sizeOf(middle + -1.0f * part.foretold, reference)) : bend;
        }
        float bend = 0.0f;
        for (unsigned k = 0; k < 3; ++k) {
            const PixelLight mean = 0.5f * (light_[c[k]] + light_[c[(k + 1) % 3]]);
            bend = std::max(bend, sizeOf(light_[part.middles[k]] + -1.0f * mean, reference));
        }
        return bend;
    }

    // Puts the samples' light together. The noisy part of it is smooth over a leaf but for the shadows of
    // small things: what differs from a quadratic function by no more than noise does is taken for that.
    void takeOffNoise() {
        TermSums sums;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            if (!samples_[i].isHidden) {
                sums.add(termsAt(samples_[i].at), light_[i].correction);
            }
        }
        const std::array<Rgb, kTerms> fit = sums.solve();
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            if (samples_[i].isHidden) {
                continue;
            }
            const std::array<double, kTerms> terms = termsAt(samples_[i].at);
            Rgb smooth(0.0f);
            for (std::size_t k = 0; k < kTerms; ++k) {
                smooth += static_cast<float>(terms[k]) * fit[k];
            }
            const Rgb rest = light_[i].correction - smooth;
            const float noise = owner_.noise_ * base::channelMean(light_[i].sum());
            const Rgb kept = glm::sign(rest) * glm::max(glm::abs(rest) - noise, Rgb(0.0f));
            samples_[i].irradiance = glm::max(light_[i].steady + smooth + kept, Rgb(0.0f));
        }
    }

    std::array<double, kTerms> termsAt(const GridPoint& at) const {
        const double x = 2.0 * (static_cast<double>(at.x) - leafMiddle_.x) / leafSize_.x;
        const double y = 2.0 * (static_cast<double>(at.y) - leafMiddle_.y) / leafSize_.y;
        return {1.0, x, y, x * x, x * y, y * y};
    }

    double longestSide(const Part& part) const {
        std::array<Vec3d, 4> corners{};
        for (unsigned k = 0; k < part.cornerCount(); ++k) {
            corners[k] = surface_.evaluate(name_.patch, part.region.corners[k]).position;
        }
        double longest = 0.0;
        for (unsigned k = 0; k < part.cornerCount(); ++k) {
            longest = std::max(longest, glm::distance(corners[k], corners[(k + 1) % part.cornerCount()]));
        }
        return longest;
    }

    void cut(const Part& part, std::vector<Part>& into) const {
        const surface::Split split =
            surface::splitAt(topology_.strips(name_.patch), surface::pathLevel(part.cell.path));
        const auto regions = surface::childRegions(surface_, name_.patch, part.region, split);
        for (unsigned k = 0; k < 4; ++k) {
            Part child;
            child.cell = display::partOf(part.cell, split, k);
            child.region = regions[k];
            const std::uint32_t middle = part.middles[0];
            const std::uint32_t corner = part.corners[k];
            if (part.cornerCount() == 4 && split == surface::Split::quarters) {
                child.isForetold = !samples_[middle].isHidden && !samples_[corner].isHidden;
                child.foretold = 0.5f * (light_[middle] + light_[corner]);
            }
            into.push_back(child);
        }
    }

    LeafGather& owner_;
    const solve::Problem& problem_;
    const hierarchy::Hierarchy& h_;
    const display::PatchTopology& topology_;
    const surface::Surface& surface_;
    NodeId leaf_;
    hierarchy::ElementName name_;
    Vec2d leafMiddle_{};  ///< in the patch's grid
    Vec2d leafSize_{1.0};
    bool isHidden_ = false;
    display::PointTable known_;
    std::vector<display::LightSample> samples_;
    std::vector<PixelLight> light_;  ///< parallel to them
    std::vector<Waiting> waiting_;
    LeafSources sources_;
};

LeafGather::LeafGather(const solve::Problem& problem, SourcePoints& points, const GatherRays& rays,
                       const Sharpness& sharpness)
    : problem_(problem),
      sharpness_(sharpness),
      noise_(kNoiseOfRay / std::sqrt(static_cast<float>(std::max(1u, rays.weak)))),
      finder_(problem, points),
      gather_(problem, rays) {
    if (sharpness_.leastSide <= 0.0) {
        sharpness_.leastSide = std::min(kLeastSide, kLeastPart * problem.scene->bounds().diagonal());
    }
}

display::LeafLight LeafGather::gather(const display::PatchTopology& topology, NodeId leaf) {
    FLUXWALK_CHECK(problem_.hierarchy.isLeaf(leaf));
    return Work(*this, topology, leaf).run();
}

}  // namespace fluxwalk::image
