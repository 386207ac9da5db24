#include "core/image/leaf_sources.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
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
/// A curved source is opened where it is nearer than this many of its radii.
constexpr double kCurvedGap = 6.0;
/// The exposed part of a source nearer than so many radii is found anew at every point.
constexpr double kNearGap = 2.0;
/// Sources farther away from all points than this many times their radius are integrated by their cubature
/// points: relative error below 1e-3.
constexpr double kFar = 5.0;
/// Sources that bring more than this part of the irradiance have shadow rays of their own.
constexpr float kStrong = 0.04f;
/// Elements darker than this part of the scene's mean are as exact as if they were no darker.
constexpr float kDarkest = 0.03f;

double toDouble(float v) {
    return static_cast<double>(v);
}

// Solves the symmetric system m x = y in place; m is well conditioned by its ridge.
void solveSystem(std::array<std::array<double, kTerms>, kTerms> m,
                 std::array<std::array<double, kLanes>, kTerms>& y) {
    for (std::size_t i = 0; i < kTerms; ++i) {
        for (std::size_t j = i + 1; j < kTerms; ++j) {
            const double factor = m[j][i] / m[i][i];
            for (std::size_t k = i; k < kTerms; ++k) {
                m[j][k] -= factor * m[i][k];
            }
            for (std::size_t k = 0; k < kLanes; ++k) {
                y[j][k] -= factor * y[i][k];
            }
        }
    }
    for (std::size_t i = kTerms; i-- > 0;) {
        for (std::size_t k = 0; k < kLanes; ++k) {
            for (std::size_t j = i + 1; j < kTerms; ++j) {
                y[i][k] -= m[i][j] * y[j][k];
            }
            y[i][k] /= m[i][i];
        }
    }
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

transport::ClusterSampler::Place samplePoint(const hierarchy::Hierarchy& hierarchy, NodeId source,
                                             const base::Vec2d& random) {
    transport::ClusterSampler::Place result;
    double mean = 1.0;
    if (hierarchy.kind(source) == NodeKind::cluster) {
        result = transport::ClusterSampler(hierarchy, source).at(random.x, random.y);
    } else {
        const transport::ElementSampler sampler(hierarchy, source);
        result.point = sampler.inExposed(random);
        mean = sampler.meanMeasure();
    }
    result.point.measure *= toDouble(hierarchy.shape(source).sampledArea()) / mean;
    return result;
}

TangentFit::TangentFit(const transport::ElementPoints& element) : middle_(element.center) {
    const Vec3d normal = lane(element.normal, 0);
    const Vec3d edge = element.corners[1] - element.corners[0];
    Vec3d along = edge - glm::dot(edge, normal) * normal;
    if (!(glm::length(along) > 1e-9 * element.radius)) {
        along = glm::cross(normal, std::abs(normal.y) < 0.7 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1));
    }
    along = glm::normalize(along);
    const Vec3d across = glm::cross(normal, along);
    double longest = 1e-300;
    double widest = 1e-300;
    for (int i = 0; i < kLanes; ++i) {
        const Vec3d d = lane(element.position, i) - middle_;
        longest = std::max(longest, std::abs(glm::dot(d, along)));
        widest = std::max(widest, std::abs(glm::dot(d, across)));
    }
    along_ = along / longest;
    across_ = across / widest;
    std::array<std::array<double, kTerms>, kTerms> normalMatrix{};
    for (std::size_t i = 0; i < kLanes; ++i) {
        const Terms terms = termsAt(lane(element.position, static_cast<int>(i)));
        for (std::size_t k = 0; k < kTerms; ++k) {
            solution_[k][i] = toDouble(terms[k]);
            for (std::size_t l = 0; l < kTerms; ++l) {
                normalMatrix[k][l] += toDouble(terms[k]) * toDouble(terms[l]);
            }
        }
    }
    for (std::size_t k = 0; k < kTerms; ++k) {
        normalMatrix[k][k] += 1e-5;
    }
    solveSystem(normalMatrix, solution_);
}

Terms TangentFit::termsAt(const Vec3d& position) const {
    const Vec3d d = position - middle_;
    const auto a = static_cast<float>(glm::dot(d, along_));
    const auto b = static_cast<float>(glm::dot(d, across_));
    return {1.0f, a, b, a * a, a * b, b * b};
}

Terms TangentFit::fit(const Lanes& values) const {
    Terms result{};
    for (std::size_t k = 0; k < kTerms; ++k) {
        double sum = 0.0;
        for (int i = 0; i < kLanes; ++i) {
            sum += solution_[k][static_cast<std::size_t>(i)] * values[i];
        }
        result[k] = static_cast<float>(sum);
    }
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

namespace {

// By the source's cubature points, for points that are far from it.
FLUXWALK_INLINE Lanes farFactors(const Lanes3& x, const Lanes3& normal,
                                 const transport::ElementPoints& source) {
    constexpr int kCubaturePoints = 4;
    Lanes sum = base::splat(0.0);
    for (int j = 0; j < kCubaturePoints; ++j) {
        const Lanes3 to = {source.position.x[j] - x.x, source.position.y[j] - x.y,
                           source.position.z[j] - x.z};
        const Lanes r2 = base::dot(to, to);
        const Lanes here = base::maxLanes(base::dot(normal, to), base::splat(0.0));
        const Lanes there = base::maxLanes(
            -(source.normal.x[j] * to.x + source.normal.y[j] * to.y + source.normal.z[j] * to.z),
            base::splat(0.0));
        sum += source.weight[j] * here * there / (base::kPi * r2 * r2);
    }
    return source.area * sum;
}

[[gnu::target("avx2")]] Lanes farFactorsAvx2(const Lanes3& x, const Lanes3& normal,
                                             const transport::ElementPoints& source) {
    return farFactors(x, normal, source);
}

Lanes farFactorsBaseline(const Lanes3& x, const Lanes3& normal, const transport::ElementPoints& source) {
    return farFactors(x, normal, source);
}

bool hasAvx2() {
    static const bool kHas = __builtin_cpu_supports("avx2") != 0;
    return kHas;
}

bool isFar(const Lanes3& x, const transport::ElementPoints& source) {
    const double far = kFar * source.radius;
    for (int i = 0; i < kLanes; ++i) {
        const Vec3d d = lane(x, i) - source.center;
        if (!(glm::dot(d, d) > far * far)) {
            return false;
        }
    }
    return true;
}

}  // namespace

Lanes computeFactors(const Lanes3& x, const Lanes3& normal, const transport::ElementPoints& source) {
    if (!isFar(x, source)) {
        return transport::computePointFactors(x, normal, source);
    }
    return hasAvx2() ? farFactorsAvx2(x, normal, source) : farFactorsBaseline(x, normal, source);
}

SourcePoints::SourcePoints(const hierarchy::Hierarchy& hierarchy)
    : hierarchy_(hierarchy), points_(hierarchy.nodeCount()) {}

SourcePoints::~SourcePoints() {
    for (const auto& points : points_) {
        delete points.load();
    }
}

const transport::ElementPoints& SourcePoints::of(NodeId element) {
    std::atomic<const transport::ElementPoints*>& place = points_[base::index(element)];
    if (const transport::ElementPoints* known = place.load(std::memory_order_acquire)) {
        return *known;
    }
    auto made =
        std::make_unique<const transport::ElementPoints>(transport::makeElementPoints(hierarchy_, element));
    const transport::ElementPoints* before = nullptr;
    // Another thread may have been faster, with the same.
    return place.compare_exchange_strong(before, made.get(), std::memory_order_acq_rel) ? *made.release()
                                                                                        : *before;
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
    const hierarchy::Light& light = h_.light(source);
    const auto radius = toDouble(shape.radius);
    const double distance =
        glm::distance(Vec3d(shape.center), search.receiver.center) - search.receiver.radius;
    const bool isFar = shape.area > 0.0f && distance > kClusterGap * radius;
    const double upper =
        isFar ? toDouble(shape.exposedArea()) / (base::kPi * (distance - radius) * (distance - radius)) : 1.0;
    if (!isFar ||
        static_cast<float>(upper) * base::channelMean(light.radiosity) > kOpenCluster * search.reference) {
        for (unsigned c = 0; c < 2; ++c) {
            add(search, h_.child(source, c), isOpen, visibility);
        }
        return;
    }
    const transport::ClusterPoints& points = clusterPoints(source);
    std::array<double, kLanes> factors{};
    Vec3d colour(0.0);
    for (unsigned k = 0; k < transport::kClusterPoints; ++k) {
        const unsigned block = k / kLanes;
        const int at = static_cast<int>(k % kLanes);
        const Vec3d y = lane(points.position[block], at);
        const Vec3d m = lane(points.normal[block], at);
        const Rgb& radiosity = h_.light(h_.patches()[points.patch[k]]).radiosity;
        const double brightness = toDouble(base::channelMean(radiosity));
        double sum = 0.0;
        for (int i = 0; i < kLanes; ++i) {
            const Vec3d d = y - lane(search.receiver.position, i);
            const double cosines =
                std::max(0.0, glm::dot(lane(search.receiver.normal, i), d)) * std::max(0.0, -glm::dot(m, d));
            const double r2 = glm::dot(d, d);
            const double kernel = points.area[block][at] * cosines / (base::kPi * r2 * r2);
            factors[static_cast<std::size_t>(i)] += kernel * brightness;
            sum += kernel;
        }
        colour += sum * Vec3d(radiosity);
    }
    const double mean = (colour.x + colour.y + colour.z) / 3.0;
    if (!(mean > 0.0)) {
        return;
    }
    // As one source of brightness 1 and the mean colour.
    Source kept;
    kept.node = source;
    kept.visibility = visibility;
    kept.radiosity = Rgb(colour / mean);
    Lanes values;
    for (int i = 0; i < kLanes; ++i) {
        values.set(i, factors[static_cast<std::size_t>(i)]);
    }
    kept.smooth = search.found.fit.fit(values);
    search.keep(kept, values, isOpen);
}

void SourceFinder::addElement(Search& search, NodeId source, bool isOpen, float visibility) {
    const hierarchy::Shape& shape = h_.shape(source);
    const transport::ElementPoints& receiver = search.receiver;
    if (shape.exposed <= 0.0f) {
        return;
    }
    const double distance = glm::distance(Vec3d(shape.center), receiver.center);
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
    if (!(largestLane(factors) > 0.0f) || light.radiosity == Rgb(0.0f)) {
        return;
    }
    Source kept;
    kept.node = source;
    kept.visibility = visibility;
    kept.radiosity = light.radiosity;
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
