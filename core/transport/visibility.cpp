#include "core/transport/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/hierarchy/local_frame.h"
#include "core/transport/cluster_points.h"
#include "core/transport/element_sampler.h"

namespace fluxwalk::transport {

namespace {

using base::Vec3d;

/// Rays that are cast at a time; pairs of more cast several such bundles.
constexpr unsigned kBundle = 64;

unsigned sideOf(RayCount count) {
    return count == RayCount::few ? 4 : 8;
}
unsigned bundlesOf(RayCount count) {
    return std::max(1u, raysOf(count) / kBundle);
}

/// Uniform numbers of 16 bits each, four from one mix: strata are far coarser than that.
struct Jitter {
    double x;
    double y;
    double z;
    double w;

    explicit Jitter(std::uint64_t bits)
        : x(static_cast<double>(bits & 0xffffu)),
          y(static_cast<double>((bits >> 16) & 0xffffu)),
          z(static_cast<double>((bits >> 32) & 0xffffu)),
          w(static_cast<double>(bits >> 48)) {
        constexpr double kScale = 1.0 / 65536.0;
        x = (x + 0.5) * kScale;
        y = (y + 0.5) * kScale;
        z = (z + 0.5) * kScale;
        w = (w + 0.5) * kScale;
    }
};

struct Stage {
    double weight = 0.0;
    double seen = 0.0;
    std::array<base::Vec2d, 2> weightMoment{};
    std::array<base::Vec2d, 2> seenMoment{};
    unsigned blockedCount = 0;
    unsigned count = 0;

    void add(double w, bool isBlocked) {
        weight += w;
        seen += isBlocked ? 0.0 : w;
        blockedCount += isBlocked ? 1 : 0;
        ++count;
    }
    void addPair(double w, bool isBlocked, const base::Vec2d& onA, const base::Vec2d& onB) {
        add(w, isBlocked);
        weightMoment[0] += w * onA;
        weightMoment[1] += w * onB;
        if (!isBlocked) {
            seenMoment[0] += w * onA;
            seenMoment[1] += w * onB;
        }
    }
    void add(const Stage& other) {
        weight += other.weight;
        seen += other.seen;
        for (std::size_t end = 0; end < 2; ++end) {
            weightMoment[end] += other.weightMoment[end];
            seenMoment[end] += other.seenMoment[end];
        }
        blockedCount += other.blockedCount;
        count += other.count;
    }
    /// Gradient over one end that the shadow adds: that of the seen kernel less that of the kernel, both
    /// relative to their means and from the same rays, so that only the shadow's noise is left.
    base::Vec2d shadowGradient(std::size_t end, const hierarchy::LocalFrame& frame) const {
        if (seen <= 0.0) {
            return base::Vec2d(0.0);
        }
        return hierarchy::gradientOfMoment(frame, seenMoment[end] / seen - weightMoment[end] / weight);
    }
    double ratio() const {
        return weight > 0.0 ? seen / weight : 1.0 - static_cast<double>(blockedCount) / count;
    }
};

/// Which stratum of the other end goes with each of side x side strata (side 4 or 8): an orthogonal array of
/// strength 2 in Owen's random order (Bose 1938; Owen 1992). For each two of the four coordinates every
/// combination of strata occurs once, so that an edge between the ends is sampled evenly wherever it runs.
class Pairing {
  public:
    Pairing(unsigned side, std::uint64_t key) : side_(side), polynomial_(side == 4 ? 0b111u : 0b1011u) {
        shuffle(columns_, base::mix(key));
        shuffle(rows_, base::mix(key + 1));
    }

    unsigned operator()(unsigned stratum) const {
        // Arithmetic of GF(4) or GF(8).
        const unsigned column = stratum % side_;
        const unsigned row = stratum / side_;
        const unsigned doubled = column << 1;
        const unsigned twice = doubled ^ ((doubled & side_) != 0 ? polynomial_ : 0u);
        return rows_[row ^ twice] * side_ + columns_[row ^ column];
    }

  private:
    void shuffle(std::array<std::uint8_t, 8>& order, std::uint64_t bits) const {
        for (unsigned i = 0; i < side_; ++i) {
            const auto j = static_cast<unsigned>((bits & 0xffu) * (i + 1) >> 8);
            bits >>= 8;
            order[i] = order[j];
            order[j] = static_cast<std::uint8_t>(i);
        }
    }

    unsigned side_;
    unsigned polynomial_;
    std::array<std::uint8_t, 8> columns_{};
    std::array<std::uint8_t, 8> rows_{};
};

/// Points of an element or of a cluster's surfaces.
class EndSampler {
  public:
    EndSampler(const hierarchy::Hierarchy& hierarchy, NodeId id, double shift) {
        if (hierarchy.kind(id) == hierarchy::NodeKind::cluster) {
            cluster_.emplace(hierarchy, id);
        } else {
            element_.emplace(hierarchy, id, shift);
        }
    }
    SurfaceSample inStratum(unsigned stratum, unsigned side, double jx, double jy) const {
        return element_ ? element_->inStratum(stratum, side, jx, jy)
                        : cluster_->inStratum(stratum, side, jx, jy);
    }

  private:
    std::optional<ElementSampler> element_;
    std::optional<ClusterSampler> cluster_;
};

Stage castPairs(const rays::RayScene& rays, const EndSampler& a, const EndSampler& b, unsigned side,
                std::uint64_t key) {
    const unsigned count = side * side;
    std::array<rays::Ray, kBundle> bundle;
    std::array<double, kBundle> weights{};
    std::array<base::Vec2d, kBundle> localA;
    std::array<base::Vec2d, kBundle> localB;
    std::array<std::uint8_t, kBundle> blocked{};
    const Pairing partner(side, key);
    unsigned used = 0;
    for (unsigned i = 0; i < count; ++i) {
        const Jitter jitter(base::mix(key + 0x9e3779b97f4a7c15ULL * (i + 1)));
        const SurfaceSample p = a.inStratum(i, side, jitter.x, jitter.y);
        const SurfaceSample q = b.inStratum(partner(i), side, jitter.z, jitter.w);
        const Vec3d d = q.position - p.position;
        const double cosines = std::max(0.0, glm::dot(p.normal, d)) * std::max(0.0, -glm::dot(q.normal, d));
        const double r2 = glm::dot(d, d);
        if (cosines <= 0.0) {
            continue;
        }
        weights[used] = p.measure * q.measure * cosines / (r2 * r2);
        localA[used] = p.local;
        localB[used] = q.local;
        bundle[used] = rays.segment(p.position, p.normal, q.position, q.normal);
        ++used;
    }
    rays.occluded(std::span(bundle.data(), used), std::span(blocked.data(), used));
    Stage stage;
    for (unsigned i = 0; i < used; ++i) {
        stage.addPair(weights[i], blocked[i] != 0, localA[i], localB[i]);
    }
    return stage;
}

VisibilitySample toSample(const Stage& stage) {
    VisibilitySample sample;
    sample.mean = stage.count == 0 ? 1.0f : static_cast<float>(stage.ratio());
    sample.rays = static_cast<std::uint16_t>(stage.count);
    sample.isMixed = stage.blockedCount > 0 && stage.blockedCount < stage.count;
    return sample;
}

}  // namespace

VisibilitySample sampleVisibility(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays, NodeId a,
                                  NodeId b, RayCount count) {
    std::uint64_t keyA = hierarchy.key(a);
    std::uint64_t keyB = hierarchy.key(b);
    const bool isSwapped = keyA > keyB;
    if (isSwapped) {
        std::swap(a, b);
        std::swap(keyA, keyB);
    }
    const std::uint64_t key = base::combine(keyA, keyB);
    const EndSampler onA(hierarchy, a, base::toUnit(base::mix(key ^ keyA)));
    const EndSampler onB(hierarchy, b, base::toUnit(base::mix(key ^ keyB)));
    // One bundle after the other, each keyed by its number.
    Stage stage;
    unsigned cast = 0;
    const auto castBundles = [&](unsigned bundles) {
        for (const unsigned end = cast + bundles; cast < end; ++cast) {
            stage.add(castPairs(rays, onA, onB, sideOf(count), cast == 0 ? key : base::mix(key + cast)));
        }
    };
    const unsigned bundles = bundlesOf(count);
    castBundles(bundles);
    const bool isWithCluster = hierarchy.shape(a).cornerCount == 0 || hierarchy.shape(b).cornerCount == 0;
    for (unsigned round = 1; isWithCluster && stage.count < raysOf(count) / 2 && round < kFacingRounds;
         ++round) {
        castBundles(bundles);
    }
    VisibilitySample sample = toSample(stage);
    if (sample.isMixed) {
        const hierarchy::Shape& shapeA = hierarchy.shape(a);
        const hierarchy::Shape& shapeB = hierarchy.shape(b);
        const float distance = glm::distance(shapeA.center, shapeB.center);
        const bool areElements = shapeA.cornerCount > 0 && shapeB.cornerCount > 0;
        if (areElements && distance < kNearPair * (shapeA.radius + shapeB.radius)) {
            castBundles((kNearRounds - 1) * bundles);
        }
        sample = toSample(stage);
        sample.isMixed = true;
        sample.rays = static_cast<std::uint16_t>(stage.count);
        sample.gradientA = stage.shadowGradient(0, hierarchy::localFrame(shapeA.cornerCount));
        sample.gradientB = stage.shadowGradient(1, hierarchy::localFrame(shapeB.cornerCount));
        if (isSwapped) {
            std::swap(sample.gradientA, sample.gradientB);
        }
    }
    return sample;
}

namespace {

/// Rays from an element towards a source without area: all, and those from each quarter of it.
struct SourceStages {
    Stage whole;
    std::array<Stage, 4> quarter;
};

class SourceCaster {
  public:
    SourceCaster(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays, NodeId element,
                 NodeId source, unsigned side, std::uint64_t key)
        : hierarchy_(hierarchy),
          rays_(rays),
          source_(source),
          isSky_(hierarchy.kind(source) == hierarchy::NodeKind::sky),
          side_(side),
          sampler_(hierarchy, element, base::toUnit(base::mix(key))) {}

    void cast(std::uint64_t key, SourceStages& stages) const {
        std::array<Aim, kBundle> aims;
        std::array<rays::Ray, kBundle> bundle;
        std::array<std::uint8_t, kBundle> blocked{};
        const Pairing partner(side_, key);
        unsigned used = 0;
        for (unsigned i = 0; i < side_ * side_; ++i) {
            const Jitter jitter(base::mix(key + 0x9e3779b97f4a7c15ULL * (i + 1)));
            const SurfaceSample p = sampler_.inStratum(i, side_, jitter.x, jitter.y);
            const double weight = p.measure * (isSky_ ? aimAtSky(p, partner(i), jitter, bundle[used])
                                                      : aimAtLight(p, bundle[used]));
            if (weight > 0.0) {
                const unsigned row = i / side_;
                aims[used++] = {weight, p.local, 2 * (i % side_) / side_ + 2 * (2 * row / side_)};
            }
        }
        rays_.occluded(std::span(bundle.data(), used), std::span(blocked.data(), used));
        for (unsigned i = 0; i < used; ++i) {
            stages.whole.addPair(aims[i].weight, blocked[i] != 0, aims[i].local, base::Vec2d(0.0));
            stages.quarter[aims[i].quarter].add(aims[i].weight, blocked[i] != 0);
        }
    }

  private:
    struct Aim {
        double weight = 0.0;
        base::Vec2d local{};
        unsigned quarter = 0;
    };

    // Directions uniform over the upper hemisphere. Both return the weight, 0 where nothing can arrive.
    double aimAtSky(const SurfaceSample& p, unsigned stratum, const Jitter& jitter, rays::Ray& ray) const {
        const double y = (stratum % side_ + jitter.z) / side_;
        const unsigned row = stratum / side_;
        const double angle = 2.0 * base::kPi * (row + jitter.w) / side_;
        const double flat = std::sqrt(std::max(0.0, 1.0 - y * y));
        const Vec3d direction(flat * std::cos(angle), y, flat * std::sin(angle));
        ray = rays_.halfLine(p.position, p.normal, direction);
        return std::max(0.0, glm::dot(p.normal, direction));
    }

    double aimAtLight(const SurfaceSample& p, rays::Ray& ray) const {
        const scene::Light& light = hierarchy_.scene().lights[hierarchy_.lightIndex(source_)];
        if (light.kind == scene::LightKind::directional) {
            ray = rays_.halfLine(p.position, p.normal, -light.direction);
            return std::max(0.0, -glm::dot(p.normal, light.direction));
        }
        const Vec3d d = light.position - p.position;
        const double r2 = std::max(glm::dot(d, d), 1e-12);
        ray = rays_.segment(p.position, p.normal, light.position, Vec3d(0.0));
        return scene::reaches(light, r2) ? std::max(0.0, glm::dot(p.normal, d)) / (r2 * std::sqrt(r2)) : 0.0;
    }

    const hierarchy::Hierarchy& hierarchy_;
    const rays::RayScene& rays_;
    NodeId source_;
    bool isSky_;
    unsigned side_;
    ElementSampler sampler_;
};

}  // namespace

VisibilitySample sampleSourceVisibility(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays,
                                        NodeId element, NodeId source, RayCount count) {
    const std::uint64_t key = base::combine(hierarchy.key(element), hierarchy.key(source));
    const SourceCaster caster(hierarchy, rays, element, source, sideOf(count), key);
    SourceStages stages;
    for (unsigned bundle = 0; bundle < bundlesOf(count); ++bundle) {
        caster.cast(bundle == 0 ? key : base::mix(key + bundle), stages);
    }
    VisibilitySample sample = toSample(stages.whole);
    sample.gradientA =
        stages.whole.shadowGradient(0, hierarchy::localFrame(hierarchy.shape(element).cornerCount));
    for (const Stage& part : stages.quarter) {
        if (part.count > 0) {
            sample.deviation =
                std::max(sample.deviation, std::abs(static_cast<float>(part.ratio()) - sample.mean));
        }
    }
    return sample;
}

}  // namespace fluxwalk::transport
