#include "core/image/pixel_gather.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/transport/element_sampler.h"
#include "core/transport/form_factor.h"

namespace fluxwalk::image {

namespace {

using base::Vec2d;

/// Rays to a strong source before it is known whether its shadow's edge is near.
constexpr unsigned kFewestPilots = 4;
constexpr unsigned kMostPilots = 16;
constexpr unsigned kLeastWeakRays = 16;
/// A point of a weak source counts at most this many times as much as the source's mean: what touches the
/// receiver would else outweigh all others where a single ray meets it.
constexpr double kMostWeight = 6.0;

float atLeastZero(float v) {
    return std::max(0.0f, v);
}

// Kernel cos cos / (pi r2) in 1/m2.
double kernelBetween(const Vec3d& x, const Vec3d& n, const transport::SurfaceSample& y) {
    const Vec3d d = y.position - x;
    const double cosines = std::max(0.0, glm::dot(n, d)) * std::max(0.0, -glm::dot(y.normal, d));
    const double r2 = glm::dot(d, d);
    return cosines > 0.0 ? cosines / (base::kPi * r2 * r2) : 0.0;
}

Vec2d shiftOf(std::uint64_t key) {
    return {base::toUnit(base::mix(key)), base::toUnit(base::mix(key + 0x9e3779b97f4a7c15ULL))};
}

/// Part of the mean brightness that a dark source counts for where rays are shared.
constexpr double kDarkPart = 0.25;
/// More than this part of what a point sees is no noise, but something that nobody knows of.
constexpr double kMostMissing = 0.1;
/// Fall of likeness with the square of the difference in standard errors, and the least of these as a part of
/// the irradiance.
constexpr float kDoubt = 0.25f;
constexpr float kLeastNoise = 2e-3f;

float varianceOf(const PixelLight& light) {
    const float least = kLeastNoise * base::channelMean(light.sum());
    return std::max(light.noise * light.noise, least * least);
}

}  // namespace

float likeness(const PixelLight& a, const PixelLight& b) {
    const float off = base::channelMean(a.correction) - base::channelMean(b.correction);
    const float variance = varianceOf(a) + varianceOf(b);
    return variance > 0.0f ? std::exp(-kDoubt * off * off / variance) : 1.0f;
}

void PixelGather::findFactors(const LeafSources& sources, std::span<const PixelPoint> points) {
    base::Lanes3 x;
    base::Lanes3 n;
    std::array<Terms, kPoints> terms{};
    for (std::size_t i = 0; i < kPoints; ++i) {
        const PixelPoint& p = points[std::min(i, points.size() - 1)];
        const int lane = static_cast<int>(i);
        x.x.set(lane, p.position.x);
        x.y.set(lane, p.position.y);
        x.z.set(lane, p.position.z);
        n.x.set(lane, p.shading.x);
        n.y.set(lane, p.shading.y);
        n.z.set(lane, p.shading.z);
        terms[i] = sources.fit.termsAt(p.position);
    }
    factors_.clear();
    for (const std::vector<Source>* group : {&sources.open, &sources.strong, &sources.weak}) {
        for (const Source& source : *group) {
            base::Lanes factors =
                source.points != nullptr ? computeFactors(x, n, *source.points) : base::splat(1.0);
            if (source.points == nullptr || source.isPartlyHidden) {
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const int lane = static_cast<int>(i);
                    const double part =
                        source.isHiddenNear
                            ? exposedShareAt(problem_.hierarchy, source.node, points[i].position,
                                             points[i].shading)
                            : static_cast<double>(atLeastZero(evaluate(source.smooth, terms[i])));
                    factors.set(lane,
                                factors[lane] * (source.points != nullptr ? std::min(1.0, part) : part));
                }
            }
            factors_.push_back(factors);
        }
    }
}

void PixelGather::gather(const LeafSources& sources, std::span<const PixelPoint> points,
                         std::span<PixelLight> irradiance) {
    FLUXWALK_CHECK_LE(points.size(), kPoints);
    FLUXWALK_CHECK_EQ(points.size(), irradiance.size());
    findFactors(sources, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        irradiance[i] = gatherOne(sources, points[i], i);
    }
}

void PixelGather::aimStrong(const LeafSources& sources, const PixelPoint& point, Bundle& bundle,
                            unsigned count) {
    const Source& source = sources.strong[bundle.source];
    const Vec2d shift = shiftOf(base::combine(point.key, problem_.hierarchy.key(source.node)));
    bundle.first = rays_.size();
    for (unsigned k = bundle.tried; k < bundle.tried + count; ++k) {
        const transport::SurfaceSample y =
            samplePoint(problem_.hierarchy, source, base::r2Point(k, shift)).point;
        const double weight = y.measure * kernelBetween(point.position, point.shading, y);
        if (weight > 0.0) {
            rays_.push_back(problem_.rays.segment(point.position, point.normal, y.position, y.normal));
            weights_.push_back(weight);
        }
    }
    bundle.used = rays_.size() - bundle.first;
    bundle.tried += count;
}

void PixelGather::count(Bundle& bundle) const {
    for (std::size_t i = bundle.first; i < bundle.first + bundle.used; ++i) {
        bundle.all += weights_[i];
        bundle.seen += blocked_[i] != 0 ? 0.0 : weights_[i];
    }
}

void PixelGather::aimWeak(const LeafSources& sources, const PixelPoint& point, double share) {
    firstWeak_ = rays_.size();
    weakRays_.clear();
    double sum = 0.0;
    for (const float w : weakWeights_) {
        sum += static_cast<double>(w);
    }
    if (!(sum > 0.0)) {
        return;
    }
    const auto wanted = static_cast<unsigned>(std::lround(budget_.weak * std::sqrt(std::min(1.0, share))));
    const unsigned count = std::max(kLeastWeakRays, wanted);
    const std::uint64_t key = base::combine(point.key, 0x77);
    const Vec2d shift = shiftOf(key + 1);
    const hierarchy::Hierarchy& h = problem_.hierarchy;
    std::size_t j = 0;
    double below = 0.0;
    for (unsigned k = 0; k < count; ++k) {
        const double place = (k + point.phase) / count * sum;
        while (j + 1 < weakWeights_.size() && below + static_cast<double>(weakWeights_[j]) <= place) {
            below += static_cast<double>(weakWeights_[j++]);
        }
        const Source& source = sources.weak[j];
        const auto weight = static_cast<double>(weakWeights_[j]);
        if (!(weight > 0.0)) {
            continue;
        }
        const transport::ClusterSampler::Place at = samplePoint(h, source, base::r2Point(k, shift));
        const transport::SurfaceSample& y = at.point;
        const Rgb& radiosity = h.kind(source.node) == hierarchy::NodeKind::cluster
                                   ? h.light(h.patches()[at.patch]).radiosity
                                   : source.radiosity;
        const double kernel = y.measure * kernelBetween(point.position, point.shading, y);
        if (!(kernel > 0.0)) {
            continue;
        }
        // Relative to the weight. The factors stand in it with their mean over the source.
        Rgb light = radiosity * static_cast<float>(kernel / weight);
        auto factor = static_cast<float>(kernel / weight);
        const float most = static_cast<float>(kMostWeight);
        const float heaviest = std::max(base::channelMean(light), factor * weakFloor_);
        if (heaviest > most) {
            light *= most / heaviest;
            factor *= most / heaviest;
        }
        weakRays_.push_back({light, factor, source.visibility});
        rays_.push_back(problem_.rays.segment(point.position, point.normal, y.position, y.normal));
        weights_.push_back(0.0);
    }
}

// What the solve knows of the sources' visibility, corrected by what the rays find of it at this point: where
// it knows all, as where nothing hides anything, no noise is left. In a closed scene it is also known what
// the form factors of all that is seen sum up to; `missing` is what the others leave of that. What the rays
// find more or less than that is noise, and so is the light that it goes with.
PixelLight PixelGather::sumWeak(const LeafSources& sources, const base::Lanes* factors, int lane,
                                double missing) const {
    Rgb unoccluded(0.0f);
    double factorSum = 0.0;
    PixelLight result;
    for (std::size_t j = 0; j < sources.weak.size(); ++j) {
        const Source& source = sources.weak[j];
        const auto factor = static_cast<float>(factors[j][lane]);
        if (factor > 0.0f) {
            const Rgb light = source.radiosity * factor;
            unoccluded += light;
            factorSum += static_cast<double>(factor);
            result.steady += source.visibility * light;
            missing -= static_cast<double>(source.visibility * factor);
        }
    }
    Rgb all(0.0f);
    Rgb surplus(0.0f);
    float allFactors = 0.0f;
    float surplusFactors = 0.0f;
    Rgb together(0.0f);
    float squares = 0.0f;
    const auto moreOf = [&](std::size_t i) {
        return (weakBlocked_[i] == 0 ? 1.0f : 0.0f) - weakRays_[i].expected;
    };
    for (std::size_t i = 0; i < weakRays_.size(); ++i) {
        const WeakRay& ray = weakRays_[i];
        const float more = moreOf(i);
        all += ray.light;
        allFactors += ray.factor;
        surplus += more * ray.light;
        surplusFactors += more * ray.factor;
        together += more * more * ray.factor * ray.light;
        squares += more * more * ray.factor * ray.factor;
    }
    for (int c = 0; c < 3; ++c) {
        if (all[c] > 0.0f) {
            result.correction[c] = unoccluded[c] * surplus[c] / all[c];
        }
    }
    Rgb slope(0.0f);
    if (isClosed_ && allFactors > 0.0f) {
        // Light for each unit of form factor, by regression over the rays where these found something new.
        slope = squares > 0.0f ? together / squares : all / allFactors;
        missing -= factorSum * static_cast<double>(surplusFactors / allFactors);
        result.correction += slope * static_cast<float>(std::clamp(missing, -kMostMissing, kMostMissing));
    }
    const float brightness = base::channelMean(all);
    if (brightness > 0.0f) {
        // Neighbouring strata stand for each other (Cochran 1977, section 5A.12).
        const float slopeMean = base::channelMean(slope);
        float differences = 0.0f;
        float before = 0.0f;
        for (std::size_t i = 0; i < weakRays_.size(); ++i) {
            const WeakRay& ray = weakRays_[i];
            const float here = moreOf(i) * (base::channelMean(ray.light) - slopeMean * ray.factor);
            differences += i > 0 ? (here - before) * (here - before) : 0.0f;
            before = here;
        }
        result.noise = base::channelMean(unoccluded) * std::sqrt(0.5f * differences) / brightness;
    }
    return result;
}

void PixelGather::trace() {
    blocked_.resize(rays_.size());
    problem_.rays.occluded(rays_, blocked_);
    rayCount_ += rays_.size();
}

Vec3d PixelGather::addSky(NodeId sky, const PixelPoint& point) {
    const Vec3d& n = point.shading;
    const Vec3d across = glm::normalize(glm::cross(n, std::abs(n.y) < 0.7 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1)));
    const Vec3d along = glm::cross(n, across);
    const Vec2d shift = shiftOf(base::combine(point.key, problem_.hierarchy.key(sky)));
    rays_.clear();
    for (unsigned k = 0; k < budget_.sky; ++k) {
        const Vec2d at = base::r2Point(k, shift);
        const double sine = std::sqrt(at.x);
        const double angle = 2.0 * base::kPi * at.y;
        const Vec3d direction =
            sine * (std::cos(angle) * across + std::sin(angle) * along) + std::sqrt(1.0 - sine * sine) * n;
        if (direction.y > 0.0) {
            rays_.push_back(problem_.rays.halfLine(point.position, point.normal, direction));
        }
    }
    if (rays_.empty()) {
        return Vec3d(0.0);
    }
    trace();
    const auto seen = static_cast<double>(std::count(blocked_.begin(), blocked_.end(), 0));
    return 0.5 * (1.0 + n.y) * seen / static_cast<double>(rays_.size()) *
           Vec3d(problem_.hierarchy.light(sky).radiosity);
}

Vec3d PixelGather::addLights(const LeafSources& sources, const PixelPoint& point) {
    const hierarchy::Hierarchy& h = problem_.hierarchy;
    const rays::RayScene& rays = problem_.rays;
    Vec3d sum(0.0);
    for (const NodeId id : sources.lights) {
        if (h.kind(id) == hierarchy::NodeKind::sky) {
            sum += addSky(id, point);
            continue;
        }
        const scene::Light& light = problem_.scene->lights[h.lightIndex(id)];
        const bool isDirectional = light.kind == scene::LightKind::directional;
        const Vec3d d = isDirectional ? -light.direction : light.position - point.position;
        const double r2 = isDirectional ? 1.0 : std::max(glm::dot(d, d), 1e-12);
        const double cosine = glm::dot(point.shading, d) / std::sqrt(r2);
        if (!(cosine > 0.0) || (!isDirectional && !scene::reaches(light, r2))) {
            continue;
        }
        ++rayCount_;
        if (rays.isOccluded(isDirectional
                                ? rays.halfLine(point.position, point.normal, d)
                                : rays.segment(point.position, point.normal, light.position, Vec3d(0.0)))) {
            continue;
        }
        sum += cosine / r2 *
               (isDirectional ? Vec3d(h.light(id).emission)
                              : Vec3d(scene::intensityToward(light, -glm::normalize(d)) *
                                      h.lighting().ofLight(h.lightIndex(id))));
    }
    return sum;
}

// Weights by which rays are shared among weak sources: by light, and in closed scenes, where all that is seen
// must add up, dark ones have their part too. Returns their light, mean of the channels, unoccluded.
double PixelGather::weighWeak(const LeafSources& sources, const base::Lanes* factors, int lane) {
    weakWeights_.resize(sources.weak.size());
    double light = 0.0;
    double all = 0.0;
    for (std::size_t j = 0; j < sources.weak.size(); ++j) {
        const double factor = factors[j][lane];
        all += factor;
        light += factor * static_cast<double>(sources.weak[j].brightness);
    }
    weakFloor_ = isClosed_ && all > 0.0 ? static_cast<float>(kDarkPart * light / all) : 0.0f;
    for (std::size_t j = 0; j < sources.weak.size(); ++j) {
        weakWeights_[j] = static_cast<float>(factors[j][lane]) * (sources.weak[j].brightness + weakFloor_);
    }
    return light;
}

PixelLight PixelGather::gatherOne(const LeafSources& sources, const PixelPoint& point, std::size_t index) {
    Vec3d sum = addLights(sources, point);
    const int lane = static_cast<int>(index);
    const base::Lanes* openFactors = factors_.data();
    const base::Lanes* strongFactors = openFactors + sources.open.size();
    const base::Lanes* weakFactors = strongFactors + sources.strong.size();
    // The surface itself hides what lies below it.
    double missing = 0.5 * (1.0 + glm::dot(point.normal, point.shading));
    for (std::size_t j = 0; j < sources.open.size(); ++j) {
        sum += openFactors[j][lane] * Vec3d(sources.open[j].radiosity);
        missing -= openFactors[j][lane];
    }
    rays_.clear();
    weights_.clear();
    bundles_.clear();
    const double weak = weighWeak(sources, weakFactors, lane);
    double total = weak + (sum.x + sum.y + sum.z) / 3.0;
    for (std::size_t j = 0; j < sources.strong.size(); ++j) {
        const double factor = strongFactors[j][lane];
        if (factor > 0.0) {
            total += factor * static_cast<double>(sources.strong[j].brightness);
            bundles_.push_back({j, factor});
        }
    }
    for (Bundle& bundle : bundles_) {
        const double share =
            bundle.factor * static_cast<double>(sources.strong[bundle.source].brightness) / total;
        bundle.most = static_cast<unsigned>(std::lround(budget_.strong * std::sqrt(share)));
        aimStrong(sources, point, bundle, std::clamp(bundle.most / 2, kFewestPilots, kMostPilots));
    }
    aimWeak(sources, point, weak / total);
    trace();
    weakBlocked_.assign(blocked_.begin() + static_cast<std::ptrdiff_t>(firstWeak_), blocked_.end());
    for (Bundle& bundle : bundles_) {
        count(bundle);
    }
    rays_.clear();
    weights_.clear();
    for (Bundle& bundle : bundles_) {
        const float known = sources.strong[bundle.source].visibility;
        const bool isCertain =
            (bundle.seen == 0.0 && known == 0.0f) || (bundle.seen == bundle.all && known == 1.0f);
        bundle.used = 0;
        if (!isCertain && bundle.most > bundle.tried) {
            aimStrong(sources, point, bundle, bundle.most - bundle.tried);
        }
    }
    trace();
    for (Bundle& bundle : bundles_) {
        count(bundle);
        const double visibility = bundle.all > 0.0
                                      ? bundle.seen / bundle.all
                                      : static_cast<double>(sources.strong[bundle.source].visibility);
        sum += bundle.factor * visibility * Vec3d(sources.strong[bundle.source].radiosity);
        missing -= bundle.factor * visibility;
    }
    const PixelLight weakLight = sumWeak(sources, weakFactors, lane, missing);
    return {Rgb(sum) + weakLight.steady, weakLight.correction, weakLight.noise};
}

}  // namespace fluxwalk::image
