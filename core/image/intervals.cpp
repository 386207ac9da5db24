#include "core/image/intervals.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/image/sensors.h"
#include "core/transport/element_sampler.h"
#include "core/transport/kernel_bounds.h"

namespace fluxwalk::image {

namespace {

using base::NodeId;
using base::Vec3d;
using hierarchy::Hierarchy;
using hierarchy::NodeKind;
using solve::GatheredSource;

/// Two-sided 99 % of a normal distribution.
constexpr double kDeviations = 2.5758;
/// Factors on the parts, fixed together.
constexpr double kShadows = 1.0;
constexpr double kRange = 1.25;
constexpr double kKernel = 1.0;
constexpr double kSolution = 1.0;
constexpr double kGaps = 1.0;
/// Sensors whose sources fill less than this part of their hemisphere look for gaps, by so many rays.
constexpr double kFilled = 0.97;
constexpr unsigned kGapRays = 64;
/// Single rounding of what is summed, relative to the value.
constexpr double kRounding = 1e-5;
constexpr double kStrictDeviations = 3.0;

double luminanceOf(const base::Rgb& c) {
    return base::luminance(Vec3d(c));
}

// The patch that an element belongs to; clusters and lights are their own.
NodeId patchOf(const Hierarchy& h, NodeId id) {
    while (h.kind(id) == NodeKind::element && h.parent(id) != NodeId::none &&
           h.kind(h.parent(id)) == NodeKind::element) {
        id = h.parent(id);
    }
    return id;
}

class Intervals {
  public:
    Intervals(const solve::Problem& problem, const solve::SolutionErrors& errors)
        : problem_(problem), h_(problem.hierarchy), errors_(errors) {}

    ErrorParts partsOf(const scene::Sensor& at, const std::vector<GatheredSource>& sources) const {
        double shadows = 0.0;
        double range = 0.0;
        double kernel = 0.0;
        double reflected = 0.0;
        double seen = 0.0;
        double received = 0.0;
        std::vector<std::pair<NodeId, double>> byPatch;
        for (const GatheredSource& s : sources) {
            const hierarchy::Light& light = h_.light(s.source);
            const double radiosity = luminanceOf(light.radiosity);
            shadows += radiosity * radiosity * s.variance;
            seen += s.transfer;
            received += base::luminance(s.irradiance);
            if (h_.kind(s.source) == NodeKind::light || h_.kind(s.source) == NodeKind::sky) {
                continue;
            }
            if (h_.kind(s.source) == NodeKind::element) {
                // A linear radiosity deviates by its half range over the root of 3 at most.
                const double uneven = s.transfer * s.spread * static_cast<double>(light.range());
                range += uneven * uneven / 3.0;
            }
            if (s.isSampled) {
                const hierarchy::Shape& shape = h_.shape(s.source);
                const double turn = std::min(1.0, static_cast<double>(shape.halfAngle));
                const double off = radiosity * s.transfer * s.spread * turn * turn;
                kernel += off * off;
            }
            reflected += luminanceOf(solve::reflectedBy(problem_, s.source)) * s.transfer;
            const double error = luminanceOf(light.reflectance) * s.transfer *
                                 static_cast<double>(errors_.ofNode[base::index(s.source)]);
            byPatch.emplace_back(patchOf(h_, s.source), error);
        }
        std::sort(byPatch.begin(), byPatch.end());
        double solution = errors_.defectError * errors_.defectError * reflected * reflected;
        for (std::size_t i = 0; i < byPatch.size();) {
            const NodeId patch = byPatch[i].first;
            double sum = 0.0;
            for (; i < byPatch.size() && byPatch[i].first == patch; ++i) {
                sum += byPatch[i].second;
            }
            solution += sum * sum;
        }
        const double hidden = seen < kFilled ? lookForGaps(at) : 0.0;
        return {std::sqrt(shadows),
                std::sqrt(range),
                std::sqrt(kernel),
                std::sqrt(solution),
                hidden > 0.0 ? hidden * received / std::max(seen, 1.0 / kGapRays) : 0.0,
                errors_.defect * reflected};
    }

    // Likely interval around the value.
    void setLikely(Measurement& m) const {
        const double s = kShadows * m.parts.shadows;
        const double r = kRange * m.parts.range;
        const double k = kKernel * m.parts.kernel;
        const double e = kSolution * m.parts.solution;
        const double g = kGaps * m.parts.gaps;
        const double half =
            kDeviations * std::sqrt(s * s + r * r + k * k + e * e + g * g) + kRounding * m.illuminance;
        m.low = std::max(0.0, m.illuminance - half + std::min(0.0, m.parts.defect));
        m.high = m.illuminance + half + std::max(0.0, m.parts.defect);
    }

    // `leaf`: where the sensor sits, NodeId::none in space.
    void setStrict(Measurement& m, const std::vector<GatheredSource>& sources, NodeId leaf) const {
        struct Share {
            double brightness = 0.0;
            double factor = 0.0;
        };
        std::vector<Share> shares;
        double low = 0.0;
        double fromLights = 0.0;
        for (const GatheredSource& s : sources) {
            const NodeKind kind = h_.kind(s.source);
            if (kind == NodeKind::light) {
                fromLights += base::luminance(s.irradiance);
                continue;
            }
            const hierarchy::Light& light = h_.light(s.source);
            const double radiosity = luminanceOf(light.radiosity);
            if (kind == NodeKind::sky) {
                shares.push_back({radiosity, s.factor});
                continue;
            }
            const double within = rangeOf(light) +
                                  kStrictDeviations * luminanceOf(light.reflectance) *
                                      static_cast<double>(errors_.ofNode[base::index(s.source)]) +
                                  (std::abs(errors_.defect) + kStrictDeviations * errors_.defectError) *
                                      luminanceOf(solve::reflectedBy(problem_, s.source));
            const transport::FactorBounds factor = boundFactor(s, leaf);
            shares.push_back({radiosity + within, factor.upper});
            if (s.isOpen) {
                low += factor.lower * std::max(0.0, radiosity - within);
            }
        }
        // Factors of what is seen sum to 1 at most: the brightest first.
        std::sort(shares.begin(), shares.end(),
                  [](const Share& a, const Share& b) { return a.brightness > b.brightness; });
        double high = fromLights;
        double left = 1.0;
        for (const Share& share : shares) {
            const double part = std::min(left, share.factor);
            high += part * share.brightness;
            left -= part;
        }
        m.low = std::min(low + fromLights, m.illuminance);
        m.high = std::max(high, m.illuminance);
    }

    // Whether a point of a leaf lies in a part of it that counts as dark.
    bool isInHiddenCell(NodeId leaf, const Vec3d& where) const {
        if (h_.shape(leaf).exposedCells == 0xffff) {
            return false;
        }
        const transport::ElementSampler sampler(h_, leaf);
        unsigned nearest = 0;
        double least = INFINITY;
        for (unsigned cell = 0; cell < 16; ++cell) {
            const double distance = glm::distance(sampler.inCell(cell).position, where);
            if (distance < least) {
                least = distance;
                nearest = cell;
            }
        }
        return (std::uint32_t{h_.shape(leaf).exposedCells} >> nearest & 1u) == 0;
    }

  private:
    // Part of the hemisphere in which a sensor sees parts of surfaces that count as dark.
    double lookForGaps(const scene::Sensor& at) const {
        unsigned hidden = 0;
        for (unsigned i = 0; i < kGapRays; ++i) {
            // By projected solid angle.
            const base::Vec2d p = base::r2Point(i, base::Vec2d(0.5));
            const double sine = std::sqrt(p.x);
            const double turn = 2.0 * base::kPi * p.y;
            const Vec3d across = glm::normalize(
                glm::cross(at.normal, std::abs(at.normal.y) < 0.7 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1)));
            const Vec3d along = glm::cross(at.normal, across);
            const Vec3d direction =
                sine * (std::cos(turn) * across + std::sin(turn) * along) + std::sqrt(1.0 - p.x) * at.normal;
            const rays::Ray ray = problem_.rays.halfLine(at.position, at.normal, direction);
            const auto hit = problem_.rays.closest(ray);
            if (hit && isHidden(*hit, Vec3d(ray.origin) + static_cast<double>(hit->t) * direction)) {
                ++hidden;
            }
        }
        return static_cast<double>(hidden) / kGapRays;
    }

    bool isHidden(const rays::Hit& hit, const Vec3d& where) const {
        const std::uint32_t object = base::index(hit.object);
        const base::Vec2d uv = problem_.scene->objects[object].surface->locate(hit.patch, where);
        const auto leaf = solve::findLeaf(problem_, object, hit.patch, hit.back, uv);
        return leaf && isInHiddenCell(*leaf, where);
    }

    // Half the range of a luminance at most: the channels' mean may have less than it.
    static double rangeOf(const hierarchy::Light& light) {
        const double mean = static_cast<double>(base::channelMean(light.radiosity));
        const double scale = mean > 0.0 ? std::max(1.0, luminanceOf(light.radiosity) / mean) : 1.0;
        return scale * static_cast<double>(light.range());
    }

    transport::FactorBounds boundFactor(const GatheredSource& s, NodeId leaf) const {
        if (!s.isSampled) {
            return {s.factor, s.factor};
        }
        if (h_.kind(s.source) == NodeKind::element && leaf != NodeId::none) {
            return transport::boundPointFactor(h_, leaf, transport::makeSourceParts(h_, s.source));
        }
        return {0.0, 1.0};
    }

    const solve::Problem& problem_;
    const Hierarchy& h_;
    const solve::SolutionErrors& errors_;
};

}  // namespace

std::vector<Measurement> measureIntervals(const solve::Solver& solver, std::span<const scene::Sensor> sensors,
                                          IntervalKind kind) {
    const solve::Problem& problem = solver.problem();
    const solve::SolutionErrors errors = solve::estimateSolutionErrors(problem);
    const Intervals intervals(problem, errors);
    std::vector<Measurement> measured(sensors.size());
    problem.executor.forRange(sensors.size(), 2, [&](std::size_t begin, std::size_t end) {
        std::vector<GatheredSource> sources;
        for (std::size_t i = begin; i < end; ++i) {
            Measurement& m = measured[i];
            sources.clear();
            const auto point = findSurfacePoint(problem, sensors[i]);
            m.irradiance =
                point ? solve::gatherAtPoint(problem, *point, nullptr, &sources)
                      : solve::gatherInSpace(problem, sensors[i].position, sensors[i].normal, &sources);
            m.illuminance = luminanceOf(m.irradiance);
            m.place = isInSolid(problem.rays, problem.hierarchy.reached(), sensors[i]) ? SensorPlace::solid
                      : point                                                          ? SensorPlace::surface
                                                                                       : SensorPlace::space;
            m.parts = intervals.partsOf(sensors[i], sources);
            if (point && intervals.isInHiddenCell(point->leaf, point->position)) {
                m.parts.gaps = std::max(m.parts.gaps, m.illuminance);
            }
            if (kind == IntervalKind::likely) {
                intervals.setLikely(m);
            } else {
                intervals.setStrict(m, sources, point ? point->leaf : NodeId::none);
            }
        }
    });
    return measured;
}

}  // namespace fluxwalk::image
