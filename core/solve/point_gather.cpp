#include "core/solve/point_gather.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/transport/cluster_points.h"
#include "core/transport/element_sampler.h"
#include "core/transport/exposed_part.h"
#include "core/transport/form_factor.h"

namespace fluxwalk::solve {

namespace {

using base::Vec2d;
using hierarchy::Hierarchy;
using hierarchy::NodeKind;

/// A source is opened while the spread of its radiosity, seen from the point, is more than this part of the
/// mean irradiance.
constexpr float kOpenSpread = 2e-3f;
constexpr unsigned kMaxRays = 256;
/// A cluster is opened where it may bring more than this part of the mean irradiance, or where the point is
/// nearer than this many of its radii; otherwise rays go to as many points of it. (Contributions of at most c
/// whose samples deviate by s of their mean leave an error of s sqrt(c): some 1.5 %.)
constexpr float kOpenCluster = 4e-3f;
constexpr double kClusterGap = 1.5;
constexpr unsigned kClusterRays = 16;

// Variance of the mean of n samples, one from each stratum, strata that follow each other being neighbours:
// from the differences within pairs, which hold what the strata's means differ by too, so that it is rather
// too large (Cochran 1977, Sampling Techniques, section 5A.12: collapsed strata). An odd last one joins the
// pair before.
class StratifiedVariance {
  public:
    void add(double value) {
        if (count_ % 2 == 1) {
            squares_ += (value - last_) * (value - last_);
        }
        last_ = value;
        ++count_;
    }
    double ofMean() const {
        const double pairs = std::floor(0.5 * count_);
        return pairs > 0.0 ? squares_ / (2.0 * pairs * count_) : 0.0;
    }

  private:
    double squares_ = 0.0;
    double last_ = 0.0;
    unsigned count_ = 0;
};

// Variance of a visibility that n rays found all alike: of the part that they missed, under Jeffreys' prior.
double unseenVariance(unsigned rays) {
    const double n = rays;
    return 0.5 * (n + 0.5) / ((n + 1.0) * (n + 1.0) * (n + 2.0));
}

class PointGather {
  public:
    PointGather(const Problem& problem, const Vec3d& position, const Vec3d& normal,
                std::vector<Contribution>* contributions, std::vector<GatheredSource>* sources)
        : problem_(problem),
          contributions_(contributions),
          sources_(sources),
          h_(problem.hierarchy),
          x_(position),
          n_(normal),
          reference_(std::max(static_cast<float>(problem.statistics.meanIrradiance), 1e-20f)) {
        key_ = problem.options.seed;
        for (int i = 0; i < 3; ++i) {
            key_ = base::combine(key_, std::bit_cast<std::uint64_t>(position[i]));
        }
    }

    Vec3d sum() const { return sum_; }

    /// Adds what `source` sends to the point, opened where needed. `isOpen`: known to be unoccluded.
    void add(NodeId source, bool isOpen) {
        switch (h_.kind(source)) {
            case NodeKind::cluster:
                addCluster(source, isOpen);
                return;
            case NodeKind::light:
                addLight(source);
                return;
            case NodeKind::sky:
                addSky(source);
                return;
            case NodeKind::element:
                addElement(source, isOpen);
                return;
        }
    }

  private:
    void deposit(NodeId source, const Vec3d& irradiance) {
        sum_ += irradiance;
        if (contributions_ != nullptr) {
            contributions_->push_back({source, irradiance});
        }
    }

    void record(const GatheredSource& source) {
        if (sources_ != nullptr) {
            sources_->push_back(source);
        }
    }

    // Clusters that cannot matter much are sampled, others opened.
    void addCluster(NodeId source, bool isOpen) {
        const hierarchy::Shape& shape = h_.shape(source);
        const Vec3d to = Vec3d(shape.center) - x_;
        const auto radius = static_cast<double>(shape.radius);
        if (shape.area > 0.0f && glm::dot(n_, to) < -radius) {
            return;
        }
        const double distance = glm::length(to);
        const hierarchy::Light& light = h_.light(source);
        const bool isFar = shape.area > 0.0f && distance > kClusterGap * radius;
        const double upper = isFar ? static_cast<double>(shape.exposedArea()) /
                                         (base::kPi * (distance - radius) * (distance - radius))
                                   : 1.0;
        if (!isFar ||
            static_cast<float>(upper) * base::channelMean(light.radiosity) > kOpenCluster * reference_) {
            for (unsigned c = 0; c < 2; ++c) {
                add(h_.child(source, c), isOpen);
            }
            return;
        }
        const transport::ClusterSampler sampler(h_, source);
        base::RandomStream random(base::combine(key_, h_.key(source)));
        std::array<rays::Ray, kClusterRays> bundle;
        std::array<Vec3d, kClusterRays> sent{};
        std::array<NodeId, kClusterRays> senders{};
        std::array<std::uint8_t, kClusterRays> blocked{};
        std::array<double, kClusterRays> parts{};
        std::array<unsigned, kClusterRays> strata{};
        unsigned used = 0;
        for (unsigned k = 0; k < kClusterRays; ++k) {
            const double place = (k + random.next()) / kClusterRays;
            const transport::ClusterSampler::Place at = sampler.at(place, random.next());
            const Vec3d d = at.point.position - x_;
            const double cosines =
                std::max(0.0, glm::dot(n_, d)) * std::max(0.0, -glm::dot(at.point.normal, d));
            if (cosines > 0.0) {
                const double r2 = glm::dot(d, d);
                const double part = static_cast<double>(shape.exposedArea()) / kClusterRays;
                senders[used] = h_.patches()[at.patch];
                parts[used] = at.point.measure * part * cosines / (base::kPi * r2 * r2);
                sent[used] = parts[used] * Vec3d(h_.light(senders[used]).radiosity);
                strata[used] = k;
                bundle[used++] = problem_.rays.segment(x_, n_, at.point.position, at.point.normal);
            }
        }
        if (!isOpen) {
            problem_.rays.occluded(std::span(bundle.data(), used), std::span(blocked.data(), used));
        }
        GatheredSource found;
        found.source = source;
        found.isSampled = true;
        found.isOpen = isOpen;
        std::array<double, kClusterRays> arriving{};
        for (unsigned k = 0; k < used; ++k) {
            found.factor += parts[k];
            if (blocked[k] == 0) {
                deposit(senders[k], sent[k]);
                found.irradiance += sent[k];
                found.transfer += parts[k];
                arriving[strata[k]] = parts[k];
            }
        }
        if (sources_ != nullptr && found.factor > 0.0) {
            StratifiedVariance variance;
            for (const double value : arriving) {
                variance.add(kClusterRays * value);
            }
            found.variance =
                std::max(variance.ofMean(), found.factor * found.factor * unseenVariance(kClusterRays));
            record(found);
        }
    }

    void addElement(NodeId source, bool isOpen) {
        const hierarchy::Shape& shape = h_.shape(source);
        if (shape.exposed <= 0.0f) {
            return;
        }
        const Vec3d toSource = Vec3d(shape.center) - x_;
        if (glm::dot(n_, toSource) < -static_cast<double>(shape.radius)) {
            return;
        }
        const transport::ElementPoints points = transport::makeElementPoints(h_, source);
        const double factor = transport::computePointFactor(x_, n_, points) * exposedShare(source);
        const hierarchy::Light& light = h_.light(source);
        const bool isNear =
            !shape.isPlanar && glm::length(toSource) < 6.0 * static_cast<double>(shape.radius);
        if (!h_.isLeaf(source) &&
            (isNear || static_cast<float>(factor) * light.range() > kOpenSpread * reference_)) {
            for (unsigned c = 0; c < 4; ++c) {
                add(h_.child(source, c), isOpen);
            }
            return;
        }
        const float contribution =
            static_cast<float>(factor) * base::channelMean(light.radiosity) / reference_;
        if (contribution <= 0.0f) {
            return;
        }
        const Visibility visibility = isOpen ? Visibility{} : sampleVisibility(source, contribution);
        const double transfer = factor * visibility.mean;
        deposit(source, transfer * Vec3d(light.radiosity));
        if (sources_ != nullptr) {
            // Over a small source the kernel changes by its cosines and distance, at most twice each.
            const double span =
                std::min(1.0, 2.0 * static_cast<double>(shape.radius) / glm::length(toSource));
            const double hidden = visibility.mean > 0.0 ? (1.0 - visibility.mean) / visibility.mean : 0.0;
            record({source, transfer * Vec3d(light.radiosity), factor, transfer,
                    factor * factor * visibility.variance, span + std::sqrt(hidden), !shape.isPlanar,
                    isOpen});
        }
    }

    // Part of the source's kernel at the point that comes from its exposed cells.
    double exposedShare(NodeId source) const {
        if (!transport::isPartlyHidden(h_.shape(source))) {
            return 1.0;
        }
        return transport::findExposedPart(h_, source,
                                          [&](const transport::SurfaceSample& p) {
                                              const Vec3d d = p.position - x_;
                                              const double r2 = std::max(glm::dot(d, d), 1e-300);
                                              return std::max(0.0, glm::dot(n_, d)) *
                                                     std::max(0.0, -glm::dot(p.normal, d)) / (r2 * r2);
                                          })
            .share;
    }

    static unsigned chooseSide(float contribution) {
        return contribution > 0.1f ? 16 : contribution > 0.01f ? 8 : contribution > 5e-4f ? 4 : 2;
    }

    struct Visibility {
        double mean = 1.0;
        double variance = 0.0;  ///< of the mean
    };

    Visibility sampleVisibility(NodeId source, float contribution) {
        const unsigned side = chooseSide(contribution);
        const hierarchy::Shape& shape = h_.shape(source);
        const hierarchy::ElementName name = h_.name(source);
        const surface::Surface& surface = h_.surfaceOf(source);
        const surface::Region region = h_.region(source);
        base::RandomStream random(base::combine(key_, h_.key(source)));
        std::array<rays::Ray, kMaxRays> bundle;
        std::array<double, kMaxRays> weights{};
        std::array<std::uint8_t, kMaxRays> blocked{};
        unsigned used = 0;
        for (unsigned i = 0; i < side * side; ++i) {
            const Vec2d jitter = random.next2();
            const unsigned row = i / side;
            const Vec2d st((i % side + jitter.x) / side, (row + jitter.y) / side);
            const unsigned cell = 4 * static_cast<unsigned>(st.y * 4.0) + static_cast<unsigned>(st.x * 4.0);
            if ((shape.exposedCells >> cell & 1u) == 0) {
                continue;
            }
            const surface::RegionPoint where = surface::mapToRegion(region, st);
            const surface::SurfacePoint p = surface.evaluate(name.patch, where.uv);
            const Vec3d m = name.back ? -p.normal : p.normal;
            const Vec3d d = p.position - x_;
            const double cosines = std::max(0.0, glm::dot(n_, d)) * std::max(0.0, -glm::dot(m, d));
            const double r2 = glm::dot(d, d);
            if (cosines <= 0.0) {
                continue;
            }
            weights[used] = cosines / (r2 * r2) * p.jacobian * where.jacobian;
            bundle[used++] = problem_.rays.segment(x_, n_, p.position, m);
        }
        if (used == 0) {
            return {};
        }
        problem_.rays.occluded(std::span(bundle.data(), used), std::span(blocked.data(), used));
        double all = 0.0;
        double seen = 0.0;
        for (unsigned i = 0; i < used; ++i) {
            all += weights[i];
            seen += blocked[i] != 0 ? 0.0 : weights[i];
        }
        Visibility result{seen / all};
        if (sources_ != nullptr) {
            StratifiedVariance variance;
            for (unsigned i = 0; i < used; ++i) {
                const double free = blocked[i] != 0 ? 0.0 : 1.0;
                variance.add(weights[i] * used / all * (free - result.mean));
            }
            // No more than that of one ray where few points make up nearly all of the kernel.
            result.variance = std::max(std::min(variance.ofMean(), result.mean * (1.0 - result.mean)),
                                       unseenVariance(used));
        }
        return result;
    }

    void addLight(NodeId source) {
        const scene::Light& light = problem_.scene->lights[h_.lightIndex(source)];
        if (light.kind == scene::LightKind::directional) {
            const double cosine = -glm::dot(n_, light.direction);
            if (cosine > 0.0 && !problem_.rays.isOccluded(problem_.rays.halfLine(x_, n_, -light.direction))) {
                deposit(source, cosine * Vec3d(h_.light(source).emission));
                record({source, cosine * Vec3d(h_.light(source).emission)});
            }
            return;
        }
        const Vec3d d = light.position - x_;
        const double r2 = std::max(glm::dot(d, d), 1e-12);
        const double cosine = glm::dot(n_, d) / std::sqrt(r2);
        if (cosine > 0.0 && scene::reaches(light, r2) &&
            !problem_.rays.isOccluded(problem_.rays.segment(x_, n_, light.position, Vec3d(0.0)))) {
            const Vec3d irradiance = cosine / r2 *
                                     Vec3d(scene::intensityToward(light, -glm::normalize(d)) *
                                           h_.lighting().ofLight(h_.lightIndex(source)));
            deposit(source, irradiance);
            record({source, irradiance});
        }
    }

    void addSky(NodeId source) {
        // Strata of the hemisphere over the point, by projected solid angle: all rays that rise count alike.
        constexpr unsigned kSide = 32;
        base::RandomStream random(base::combine(key_, h_.key(source)));
        const Vec3d across =
            glm::normalize(glm::cross(n_, std::abs(n_.y) < 0.7 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1)));
        const Vec3d along = glm::cross(n_, across);
        std::array<rays::Ray, kMaxRays> bundle;
        std::array<std::uint8_t, kMaxRays> blocked{};
        unsigned used = 0;
        unsigned all = 0;
        unsigned seen = 0;
        StratifiedVariance variance;
        for (unsigned i = 0; i < kSide * kSide; ++i) {
            const Vec2d jitter = random.next2();
            const double sine = std::sqrt((i % kSide + jitter.x) / kSide);
            const unsigned row = i / kSide;
            const double angle = 2.0 * base::kPi * (row + jitter.y) / kSide;
            const Vec3d direction = sine * (std::cos(angle) * across + std::sin(angle) * along) +
                                    std::sqrt(1.0 - sine * sine) * n_;
            if (direction.y > 0.0) {
                bundle[used++] = problem_.rays.halfLine(x_, n_, direction);
            }
            if (used == kMaxRays || (i + 1 == kSide * kSide && used > 0)) {
                problem_.rays.occluded(std::span(bundle.data(), used), std::span(blocked.data(), used));
                for (unsigned k = 0; k < used; ++k) {
                    seen += blocked[k] == 0 ? 1u : 0u;
                    variance.add(blocked[k] == 0 ? 1.0 : 0.0);
                }
                all += used;
                used = 0;
            }
        }
        if (all > 0) {
            const double factor = 0.5 * (1.0 + n_.y);
            const double transfer = factor * seen / all;
            deposit(source, transfer * Vec3d(h_.light(source).radiosity));
            record({source, transfer * Vec3d(h_.light(source).radiosity), factor, transfer,
                    factor * factor * std::max(variance.ofMean(), unseenVariance(all))});
        }
    }

    const Problem& problem_;
    std::vector<Contribution>* contributions_;
    std::vector<GatheredSource>* sources_;
    const Hierarchy& h_;
    Vec3d x_;
    Vec3d n_;
    float reference_;
    std::uint64_t key_ = 0;
    Vec3d sum_{0.0};
};

}  // namespace

Rgb gatherAtPoint(const Problem& problem, const GatherPoint& point, std::vector<Contribution>* contributions,
                  std::vector<GatheredSource>* sources) {
    const Hierarchy& h = problem.hierarchy;
    PointGather gather(problem, point.position, point.normal, contributions, sources);
    for (NodeId id = point.leaf; id != NodeId::none; id = h.parent(id)) {
        for (const std::uint32_t l : problem.links.endingAt(id)) {
            const hierarchy::Link& link = problem.links.links[l];
            gather.add(link.a == id ? link.b : link.a, link.isOpen());
        }
    }
    return Rgb(gather.sum());
}

Rgb gatherInSpace(const Problem& problem, const Vec3d& position, const Vec3d& normal,
                  std::vector<GatheredSource>* sources) {
    PointGather gather(problem, position, normal, nullptr, sources);
    if (problem.hierarchy.root() != NodeId::none) {
        gather.add(problem.hierarchy.root(), false);
    }
    return Rgb(gather.sum());
}

std::optional<NodeId> findLeaf(const Problem& problem, std::uint32_t object, std::uint32_t patch, bool back,
                               const base::Vec2d& uv) {
    const Hierarchy& h = problem.hierarchy;
    NodeId id = h.patchNode(object, patch, back);
    if (id == NodeId::none) {
        return std::nullopt;
    }
    const surface::Surface& surface = *problem.scene->objects[object].surface;
    surface::Region region = surface::wholePatch(surface.domain(patch));
    while (!h.isLeaf(id)) {
        const surface::Split split = h.shape(id).split;
        const unsigned child = surface::childAt(surface, patch, region, split, uv);
        region = surface::childRegion(surface, patch, region, split, child);
        id = h.child(id, child);
    }
    return id;
}

}  // namespace fluxwalk::solve
