#include "core/image/leaf_sources.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/image/part_light.h"
#include "core/transport/element_sampler.h"
#include "core/transport/exposed_part.h"
#include "core/transport/form_factor.h"

namespace fluxwalk::image {

namespace {

using base::kLanes;
using base::Lanes;
using base::Lanes3;
using hierarchy::NodeKind;

/// A source is opened while the spread of its radiosity, seen from the element, is more than this part of
/// the element's irradiance.
constexpr float kOpenSpread = 2e-3f;
/// A cluster is opened where it may bring more than this part, or where it is nearer than this many radii.
constexpr float kOpenCluster = 4e-3f;
constexpr double kClusterGap = 1.5;
/// A curved source is opened where it is nearer than this many of its radii, to parts whose normals differ by
/// no more than some radians.
constexpr double kCurvedGap = 6.0;
constexpr float kFlatPart = 0.05f;
/// How light changes within a source is seen where that is nearer than this many of its radii and brings more
/// than this part of the irradiance.
constexpr double kLitGap = 4.0;
constexpr float kLitWithin = 0.02f;
/// The exposed part of a source nearer than so many radii is found anew at every point.
constexpr double kNearGap = 2.0;
/// Sources that bring more than this part of the irradiance have shadow rays of their own.
constexpr float kStrong = 0.04f;
/// Elements darker than this part of the scene's mean are as exact as if they were no darker.
constexpr float kDarkest = 0.03f;

double toDouble(float v) {
    return static_cast<double>(v);
}

Vec3d lane(const Lanes3& v, int i) {
    return {v.x[i], v.y[i], v.z[i]};
}

float largestLane(const Lanes& v) {
    double most = v[0];
    for (int i = 1; i < kLanes; ++i) {
        most = std::max(most, v[i]);
    }
    return static_cast<float>(most);
}

// Of triangles that are partly hidden the parts are no cells.
bool canOpenLeaf(const hierarchy::Shape& shape) {
    return shape.cornerCount == 4 || !transport::isPartlyHidden(shape);
}

// Mean radiosity of a part.
Rgb lightOf(const CellLight& light, transport::Path part) {
    const unsigned first = 4 * surface::pathStep(part, 0);
    return surface::pathLevel(part) == transport::kMaxPartLevel
               ? light[first + surface::pathStep(part, 1)]
               : 0.25f * (light[first] + light[first + 1] + light[first + 2] + light[first + 3]);
}

// Place of a direction from a plane with this normal along a curve through the disc of directions: quarters
// of quarters of a square, so that neighbours on it are neighbours in the sky.
std::uint32_t orderOf(const Vec3d& direction, const Vec3d& along, const Vec3d& across) {
    const auto cell = [](double v) {
        return static_cast<std::uint32_t>(std::clamp(256.0 * (v + 1.0), 0.0, 511.0));
    };
    std::uint32_t x = cell(glm::dot(direction, along));
    std::uint32_t y = cell(glm::dot(direction, across));
    // Hilbert's curve.
    std::uint32_t place = 0;
    for (std::uint32_t s = 256; s > 0; s /= 2) {
        const std::uint32_t rx = (x & s) != 0 ? 1 : 0;
        const std::uint32_t ry = (y & s) != 0 ? 1 : 0;
        place += s * s * ((3 * rx) ^ ry);
        if (ry == 0) {
            if (rx == 1) {
                x = 511 - x;
                y = 511 - y;
            }
            std::swap(x, y);
        }
    }
    return place;
}

}  // namespace

transport::ClusterSampler::Place samplePoint(const hierarchy::Hierarchy& hierarchy, const Source& source,
                                             const base::Vec2d& random) {
    transport::ClusterSampler::Place result;
    if (source.region != nullptr) {
        result.point = transport::sampleRegion(hierarchy, source.node, *source.region, random);
        return result;
    }
    double mean = 1.0;
    if (hierarchy.kind(source.node) == NodeKind::cluster) {
        result = transport::ClusterSampler(hierarchy, source.node).at(random.x, random.y);
    } else {
        const transport::ElementSampler sampler(hierarchy, source.node);
        result.point = sampler.inExposed(random);
        mean = sampler.meanMeasure();
    }
    result.point.measure *= toDouble(hierarchy.shape(source.node).sampledArea()) / mean;
    return result;
}

double exposedShareAt(const hierarchy::Hierarchy& hierarchy, NodeId source, const Vec3d& x, const Vec3d& n) {
    return transport::findExposedPart(hierarchy, source,
                                      [&](const transport::SurfaceSample& p) {
                                          const Vec3d d = p.position - x;
                                          const double r2 = std::max(glm::dot(d, d), 1e-300);
                                          return std::max(0.0, glm::dot(n, d)) *
                                                 std::max(0.0, -glm::dot(p.normal, d)) / (r2 * r2);
                                      })
        .share;
}

/// A leaf whose sources are looked for.
struct SourceFinder::Search {
    LeafSources found;
    transport::ElementPoints receiver;
    float reference = 0.0f;  ///< lux, that thresholds are parts of
    std::vector<Source> mixed;

    // Keeps a source with its factors at the receiver's points.
    void keep(Source source, const Lanes& factors, bool isOpen) {
        source.brightness = base::channelMean(source.radiosity);
        source.most = largestLane(factors) * source.brightness;
        (isOpen ? found.open : mixed).push_back(source);
    }
};

const transport::ClusterPoints& SourceFinder::clusterPoints(NodeId cluster) {
    std::unique_ptr<transport::ClusterPoints>& points = clusterPoints_[cluster];
    if (!points) {
        points = std::make_unique<transport::ClusterPoints>(transport::makeClusterPoints(h_, cluster));
    }
    return *points;
}

void SourceFinder::add(Search& search, NodeId source, bool isOpen, float visibility) {
    switch (h_.kind(source)) {
        case NodeKind::cluster:
            addCluster(search, source, isOpen, visibility);
            return;
        case NodeKind::element:
            addElement(search, source, isOpen, visibility);
            return;
        case NodeKind::light:
        case NodeKind::sky:
            search.found.lights.push_back(source);
            return;
    }
}

void SourceFinder::addCluster(Search& search, NodeId source, bool isOpen, float visibility) {
    const hierarchy::Shape& shape = h_.shape(source);
    const auto radius = toDouble(shape.radius);
    const double distance =
        glm::distance(Vec3d(shape.center), search.receiver.center) - search.receiver.radius;
    const bool isFar = shape.area > 0.0f && distance > kClusterGap * radius;
    const double upper =
        isFar ? toDouble(shape.exposedArea()) / (base::kPi * (distance - radius) * (distance - radius)) : 1.0;
    if (!isFar || static_cast<float>(upper) * base::channelMean(h_.light(source).radiosity) >
                      kOpenCluster * search.reference) {
        for (unsigned c = 0; c < 2; ++c) {
            add(search, h_.child(source, c), isOpen, visibility);
        }
        return;
    }
    const transport::ClusterPoints& points = clusterPoints(source);
    Lanes factors = base::splat(0.0);
    Vec3d light(0.0);
    double all = 0.0;
    for (unsigned k = 0; k < transport::kClusterPoints; ++k) {
        const unsigned block = k / kLanes;
        const int at = static_cast<int>(k % kLanes);
        const Vec3d y = lane(points.position[block], at);
        const Vec3d m = lane(points.normal[block], at);
        double sum = 0.0;
        for (int i = 0; i < kLanes; ++i) {
            const Vec3d d = y - lane(search.receiver.position, i);
            const double cosines =
                std::max(0.0, glm::dot(lane(search.receiver.normal, i), d)) * std::max(0.0, -glm::dot(m, d));
            const double r2 = glm::dot(d, d);
            const double kernel = points.area[block][at] * cosines / (base::kPi * r2 * r2);
            factors.set(i, factors[i] + kernel);
            sum += kernel;
        }
        light += sum * Vec3d(h_.light(h_.patches()[points.patch[k]]).radiosity);
        all += sum;
    }
    if (!(all > 0.0) || (light == Vec3d(0.0) && !keepsDark_)) {
        return;
    }
    // As one source of the mean radiosity that is seen.
    Source kept;
    kept.node = source;
    kept.visibility = visibility;
    kept.radiosity = Rgb(light / all);
    kept.smooth = search.found.fit.fit(factors);
    search.keep(kept, factors, isOpen);
}

// A solid hides all places that were looked at, though not the slivers beside it, which rays find. They are
// lit as what is around.
void SourceFinder::addHidden(Search& search, NodeId source, double distance) {
    if (distance > search.receiver.radius + kNearGap * toDouble(h_.shape(source).radius)) {
        return;
    }
    NodeId lit = h_.parent(source);
    while (lit != NodeId::none && h_.kind(lit) == NodeKind::element && h_.shape(lit).exposed <= 0.0f) {
        lit = h_.parent(lit);
    }
    if (lit == NodeId::none || h_.kind(lit) != NodeKind::element) {
        return;
    }
    Source kept;
    kept.node = source;
    kept.visibility = 0.0f;
    kept.radiosity = h_.light(lit).radiosity;
    for (unsigned k = 0; k < 4; ++k) {
        const SourcePart& part = points_.of(source, surface::childPath(surface::kRootPath, k));
        kept.points = &part.points;
        kept.region = &part.region;
        search.keep(kept, computeFactors(search.receiver.position, search.receiver.normal, part.points),
                    false);
    }
}

void SourceFinder::addElement(Search& search, NodeId source, bool isOpen, float visibility) {
    const hierarchy::Shape& shape = h_.shape(source);
    const transport::ElementPoints& receiver = search.receiver;
    const double distance = glm::distance(Vec3d(shape.center), receiver.center);
    if (shape.exposed <= 0.0f) {
        addHidden(search, source, distance);
        return;
    }
    const transport::ElementPoints& points = points_.of(source);
    Lanes factors = computeFactors(receiver.position, receiver.normal, points);
    const bool isPartlyHidden = transport::isPartlyHidden(shape);
    const hierarchy::Light& light = h_.light(source);
    const auto radius = toDouble(shape.radius);
    const bool isCurvedNear =
        !shape.isPlanar && distance - receiver.radius < kCurvedGap * radius && !h_.isLeaf(source);
    if (!h_.isLeaf(source) &&
        (isCurvedNear || largestLane(factors) * light.range() > kOpenSpread * search.reference)) {
        for (unsigned c = 0; c < 4; ++c) {
            add(search, h_.child(source, c), isOpen, visibility);
        }
        return;
    }
    if (!(largestLane(factors) > 0.0f) || (light.radiosity == Rgb(0.0f) && !keepsDark_)) {
        return;
    }
    Source kept;
    kept.node = source;
    kept.visibility = visibility;
    kept.radiosity = light.radiosity;
    if (h_.isLeaf(source) && canOpenLeaf(shape)) {
        const bool isLit = isLitWithin(search, kept, points, factors);
        if (isLit || isSeenWithin(search, source, points, surface::kRootPath)) {
            addParts(search, kept, surface::kRootPath, isLit ? &partLight_->of(source) : nullptr, isOpen);
            return;
        }
    }
    kept.points = &points;
    kept.isPartlyHidden = isPartlyHidden;
    if (isPartlyHidden) {
        Lanes shares;
        for (int i = 0; i < kLanes; ++i) {
            shares.set(i, exposedShareAt(h_, source, lane(receiver.position, i), lane(receiver.normal, i)));
        }
        kept.smooth = search.found.fit.fit(shares);
        kept.isHiddenNear = distance < receiver.radius + kNearGap * radius;
    }
    search.keep(kept, factors, isOpen);
}

// Whether the shape of a leaf or its part, or what is exposed of it, is seen within.
bool SourceFinder::isSeenWithin(const Search& search, NodeId leaf, const transport::ElementPoints& points,
                                transport::Path part) const {
    const hierarchy::Shape& shape = h_.shape(leaf);
    const double gap = glm::distance(points.center, search.receiver.center) - search.receiver.radius;
    if (transport::partExposure(shape, part) == transport::PartExposure::some &&
        gap < kNearGap * points.radius) {
        return true;
    }
    const float halfAngle = shape.halfAngle / static_cast<float>(1u << surface::pathLevel(part));
    return !shape.isPlanar && halfAngle > kFlatPart && gap < kCurvedGap * points.radius;
}

bool SourceFinder::isLitWithin(const Search& search, const Source& source,
                               const transport::ElementPoints& points, const Lanes& factors) const {
    const double gap = glm::distance(points.center, search.receiver.center) - search.receiver.radius;
    return partLight_ && gap < kLitGap * points.radius &&
           largestLane(factors) * base::channelMean(source.radiosity) > kLitWithin * search.reference;
}

void SourceFinder::addParts(Search& search, const Source& whole, transport::Path part, const CellLight* light,
                            bool isOpen) {
    const hierarchy::Shape& shape = h_.shape(whole.node);
    for (unsigned k = 0; k < 4; ++k) {
        const transport::Path quarter = surface::childPath(part, k);
        const transport::PartExposure exposure = transport::partExposure(shape, quarter);
        const bool isHidden = exposure == transport::PartExposure::none;
        const SourcePart& seen = points_.of(whole.node, quarter);
        const Lanes factors = computeFactors(search.receiver.position, search.receiver.normal, seen.points);
        Source kept = whole;
        if (isHidden) {
            // But for slivers beside what hides it, which rays find.
            kept.visibility = 0.0f;
        }
        if (light != nullptr) {
            kept.radiosity = lightOf(*light, quarter);
        }
        if (surface::pathLevel(quarter) < transport::kMaxPartLevel &&
            (exposure == transport::PartExposure::some ||
             isSeenWithin(search, whole.node, seen.points, quarter) ||
             isLitWithin(search, kept, seen.points, factors))) {
            addParts(search, whole, quarter, light, isOpen);
            continue;
        }
        kept.points = &seen.points;
        kept.region = &seen.region;
        if (kept.radiosity != Rgb(0.0f) || keepsDark_) {
            search.keep(kept, factors, isOpen && !isHidden);
        }
    }
}

SourceFinder::SourceFinder(const solve::Problem& problem, SourcePoints& points, NearLight nearLight)
    : problem_(problem),
      h_(problem.hierarchy),
      points_(points),
      keepsDark_(!problem.hierarchy.reached().isOpen),
      partLight_(nearLight == NearLight::gathered ? std::make_unique<PartLight>(problem, points) : nullptr) {}

SourceFinder::SourceFinder(SourceFinder&&) noexcept = default;
SourceFinder::~SourceFinder() = default;

LeafSources SourceFinder::find(NodeId leaf) {
    Search search;
    search.found.leaf = leaf;
    search.receiver = transport::makeElementPoints(h_, leaf);
    search.found.fit = TangentFit(search.receiver);
    search.reference = std::max({base::channelMean(h_.light(leaf).irradiance),
                                 kDarkest * static_cast<float>(problem_.statistics.meanIrradiance), 1e-20f});
    for (NodeId id = leaf; id != NodeId::none; id = h_.parent(id)) {
        for (const std::uint32_t l : problem_.links.endingAt(id)) {
            const hierarchy::Link& link = problem_.links.links[l];
            add(search, link.a == id ? link.b : link.a, link.isOpen(), link.visibility());
        }
    }
    const Vec3d normal = lane(search.receiver.normal, 0);
    const Vec3d along =
        glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.7 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1)));
    const Vec3d across = glm::cross(normal, along);
    std::vector<std::pair<std::uint32_t, std::size_t>> order;
    for (std::size_t i = 0; i < search.mixed.size(); ++i) {
        const Source& source = search.mixed[i];
        if (source.most > kStrong * search.reference) {
            search.found.strong.push_back(source);
        } else {
            const Vec3d d = Vec3d(h_.shape(source.node).center) - search.receiver.center;
            order.emplace_back(orderOf(d / std::max(glm::length(d), 1e-300), along, across), i);
        }
    }
    std::sort(order.begin(), order.end());
    for (const auto& [place, i] : order) {
        search.found.weak.push_back(search.mixed[i]);
    }
    return std::move(search.found);
}

}  // namespace fluxwalk::image
