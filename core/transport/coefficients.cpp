#include "core/transport/coefficients.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/hierarchy/local_frame.h"
#include "core/transport/cluster_factor.h"
#include "core/transport/contact_visibility.h"
#include "core/transport/exposed_part.h"
#include "core/transport/form_factor.h"
#include "core/transport/isotropic_cluster.h"
#include "core/transport/shaft.h"
#include "core/transport/touching_factor.h"
#include "core/transport/visibility.h"

namespace fluxwalk::transport {

namespace {

/// Where the bounding spheres of planar elements overlap and this part of the smaller one's light meets the
/// other, the kernel's peak at the contact counts.
constexpr float kContactFactor = 0.01f;

// Kernel in 1/m2 at the edge of a light's range, where that may lie within the element though none of its
// points is reached.
double reachedBetweenPoints(const ElementPoints& e, const hierarchy::Hierarchy& h, NodeId source) {
    if (h.kind(source) != hierarchy::NodeKind::light) {
        return 0.0;
    }
    const scene::Light& light = h.scene().lights[h.lightIndex(source)];
    const bool isNear = light.kind != scene::LightKind::directional && light.range > 0.0 &&
                        glm::distance(e.center, light.position) - e.radius < light.range;
    return isNear ? 1.0 / (light.range * light.range) : 0.0;
}

// Mean and relative deviation over an element of what a light source without area, or the sky, sends to it.
void factorFromSource(const ElementPoints& e, const hierarchy::Hierarchy& h, NodeId source,
                      Coefficient& out) {
    std::array<double, base::kLanes> factor{};
    double mean = 0.0;
    for (int i = 0; i < base::kLanes; ++i) {
        const Vec3d x(e.position.x[i], e.position.y[i], e.position.z[i]);
        const Vec3d n(e.normal.x[i], e.normal.y[i], e.normal.z[i]);
        double f = 0.0;
        if (h.kind(source) == hierarchy::NodeKind::sky) {
            // A uniform upper hemisphere over a plane tilted by beta: (1 + cos beta) / 2 of it.
            f = 0.5 * (1.0 + n.y);
        } else {
            const scene::Light& light = h.scene().lights[h.lightIndex(source)];
            if (light.kind == scene::LightKind::directional) {
                f = std::max(0.0, -glm::dot(n, light.direction));
            } else {
                const Vec3d d = light.position - x;
                const double r2 = std::max(glm::dot(d, d), 1e-12);
                f = scene::reaches(light, r2) ? std::max(0.0, glm::dot(n, d)) / (r2 * std::sqrt(r2)) : 0.0;
                if (light.kind == scene::LightKind::spot) {
                    const float full = std::max({light.intensity.r, light.intensity.g, light.intensity.b});
                    const base::Rgb there = scene::intensityToward(light, -glm::normalize(d));
                    f *=
                        full > 0.0f ? static_cast<double>(std::max({there.r, there.g, there.b}) / full) : 0.0;
                }
            }
        }
        factor[static_cast<std::size_t>(i)] = f;
        mean += e.weight[i] * f;
    }
    out.coupling = static_cast<float>(e.area * mean);
    const LinearFit fit = fitLinear(e, factor, mean);
    if (mean > 0.0) {
        out.gradientA = base::Vec2(fit.gradient);
        out.spreadA = static_cast<float>(fit.deviation / mean);
    } else if (const double highest = std::max(fit.largest, reachedBetweenPoints(e, h, source));
               highest > 0.0) {
        // Only a corner is lit: a rough value that the oracle will not trust.
        out.coupling = static_cast<float>(e.area * highest / 64.0);
        out.spreadA = 64.0f;
    }
    out.evaluations = base::kLanes;
}

PairFactor factorOf(const hierarchy::Hierarchy& h, const Query& query, const ElementPoints& a,
                    const ElementPoints& b) {
    if (query.a == query.b) {
        return computeSelfFactor(a, makeSelfGrid(h, query.a));
    }
    const PairFactor factor = computePairFactor(a, b);
    if (factor.coupling <= 0.0 || !isCurvedContact(a, b)) {
        return factor;
    }
    return computePairFactor(a, b, computeTouchingCoupling(h, query.a, a, query.b, b));
}

// Leaves of a pair's coefficient what element `id`'s exposed cells exchange with `other`.
void limitToExposed(const hierarchy::Hierarchy& h, NodeId id, const ElementPoints& other, double& coupling,
                    base::Vec2& gradient) {
    if (!isPartlyHidden(h.shape(id))) {
        return;
    }
    const ExposedPart part = findExposedPart(
        h, id, [&](const SurfaceSample& p) { return computePointFactor(p.position, p.normal, other); });
    coupling *= part.share;
    gradient = base::Vec2(part.gradient);
}

// Scales the gradients down where the link, taken alone, would send back more than it got: gradients of
// peaked kernels are steeper than what a linear function over a whole element can hold.
void limitGradients(const hierarchy::Shape& a, const hierarchy::Shape& b, Coefficient& c) {
    const double areas = static_cast<double>(a.sampledArea()) * static_cast<double>(b.sampledArea());
    const auto transfer = static_cast<double>(c.coupling * c.visibility);
    if (!(areas > 0.0) || !(transfer > 0.0)) {
        return;
    }
    const auto excess = [](const hierarchy::Shape& shape, const base::Vec2& gradient) {
        return static_cast<double>(hierarchy::localFrame(shape.cornerCount).product(gradient, gradient));
    };
    const double excessA = excess(a, c.gradientA);
    const double excessB = excess(b, c.gradientB);
    // (1 + x excessA) (1 + x excessB) <= most for the scale sqrt(x).
    const double most = std::max(1.0, areas / (transfer * transfer));
    if ((1.0 + excessA) * (1.0 + excessB) <= most) {
        return;
    }
    const double half = 0.5 * (excessA + excessB);
    const double x = (most - 1.0) / (half + std::sqrt(half * half + excessA * excessB * (most - 1.0)));
    c.gradientA *= static_cast<float>(std::sqrt(x));
    c.gradientB *= static_cast<float>(std::sqrt(x));
}

}  // namespace

float visibilityUpperBound(float visibility, unsigned rays) {
    if (visibility >= 1.0f) {
        return 1.0f;
    }
    const auto n = static_cast<float>(rays);
    const float p = (visibility * n + 1.0f) / (n + 2.0f);
    return std::min(1.0f, p + std::sqrt(p * (1.0f - p) / (n + 3.0f)));
}

void CoefficientService::compute(std::span<const Query> queries, std::span<Coefficient> out) const {
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const hierarchy::NodeKind kindA = hierarchy_.kind(queries[i].a);
        const hierarchy::NodeKind kindB = hierarchy_.kind(queries[i].b);
        out[i] = kindA == hierarchy::NodeKind::cluster || kindB == hierarchy::NodeKind::cluster
                     ? withClusters(queries[i])
                 : kindB == hierarchy::NodeKind::element ? betweenElements(queries[i])
                                                         : fromSource(queries[i]);
        if (kindB == hierarchy::NodeKind::element || kindB == hierarchy::NodeKind::cluster) {
            limitGradients(hierarchy_.shape(queries[i].a), hierarchy_.shape(queries[i].b), out[i]);
        }
    }
}

Coefficient CoefficientService::withClusters(const Query& query) const {
    Coefficient out;
    if (isCutOff(hierarchy_, rays_, query.a, query.b, shaftTolerance(hierarchy_, rays_, query.a, query.b))) {
        out.isBlocked = true;
        out.visibility = 0.0f;
        return out;
    }
    const bool isFog = model_ == ClusterModel::isotropic;
    const PairFactor factor = isFog ? computeIsotropicFactor(hierarchy_, query.a, query.b)
                                    : computeClusterFactor(hierarchy_, query.a, query.b);
    // Points of clusters that overlap may come too near to each other; nothing sends more than it has.
    out.coupling = std::min({static_cast<float>(factor.coupling), hierarchy_.shape(query.a).sampledArea(),
                             hierarchy_.shape(query.b).sampledArea()});
    out.gradientA = base::Vec2(factor.gradientA);
    out.gradientB = base::Vec2(factor.gradientB);
    out.spreadA = static_cast<float>(factor.spreadA);
    out.spreadB = static_cast<float>(factor.spreadB);
    out.evaluations = static_cast<std::uint16_t>(std::min(factor.evaluations, 0xffffU));
    if (out.coupling <= 0.0f) {
        return out;
    }
    if (isFog) {
        out.visibility = attenuate(hierarchy_, query.a, query.b);
        out.isMixed = out.visibility > 0.0f && out.visibility < 1.0f;
        return out;
    }
    const VisibilitySample seen = sampleVisibility(hierarchy_, rays_, query.a, query.b, rayCount_);
    out.visibility = seen.mean;
    out.gradientA += base::Vec2(seen.gradientA);
    out.gradientB += base::Vec2(seen.gradientB);
    out.rays = seen.rays;
    out.isMixed = seen.isMixed;
    if (!out.isMixed && out.visibility > 0.0f) {
        // With 95 % certainty no more than this is hidden, if none of n rays was blocked: 3 / n.
        const float hidden = 3.0f / static_cast<float>(seen.rays + 2);
        out.spreadA += hidden;
        out.spreadB += hidden;
    }
    return out;
}

Coefficient CoefficientService::betweenElements(const Query& query) const {
    Coefficient out;
    const hierarchy::ElementName nameA = hierarchy_.name(query.a);
    const hierarchy::ElementName nameB = hierarchy_.name(query.b);
    const bool isSameSide = nameA.object == nameB.object && nameA.back == nameB.back;
    const auto constant = isSameSide ? hierarchy_.surfaceOf(query.a).exactKernel(nameA.back) : std::nullopt;
    const ElementPoints a = makeElementPoints(hierarchy_, query.a);
    const ElementPoints b = makeElementPoints(hierarchy_, query.b);
    double coupling = 0.0;
    if (constant) {
        coupling = a.area * b.area * *constant;
    } else {
        const PairFactor factor = factorOf(hierarchy_, query, a, b);
        coupling = factor.coupling;
        out.gradientA = base::Vec2(factor.gradientA);
        out.gradientB = base::Vec2(factor.gradientB);
        out.spreadA = static_cast<float>(factor.spreadA);
        out.spreadB = static_cast<float>(factor.spreadB);
        out.evaluations = static_cast<std::uint16_t>(factor.evaluations);
    }
    if (!constant) {
        limitToExposed(hierarchy_, query.a, b, coupling, out.gradientA);
        limitToExposed(hierarchy_, query.b, a, coupling, out.gradientB);
    } else {
        const hierarchy::Shape& shapeA = hierarchy_.shape(query.a);
        const hierarchy::Shape& shapeB = hierarchy_.shape(query.b);
        coupling *=
            static_cast<double>(shapeA.sampledArea() / shapeA.area * (shapeB.sampledArea() / shapeB.area));
    }
    // Where two surfaces lie upon each other and part of one is hidden, what is left may come out larger than
    // all that it can send; light would grow without end between them.
    out.coupling = std::min({static_cast<float>(coupling), hierarchy_.shape(query.a).exposedArea(),
                             hierarchy_.shape(query.b).exposedArea()});
    if (out.coupling <= 0.0f || query.isOpen) {
        out.isOpen = query.isOpen;
        return out;
    }
    switch (inspectShaft(hierarchy_, query.a, query.b, shaftTolerance(hierarchy_, rays_, query.a, query.b))) {
        case ShaftContent::empty:
            out.isOpen = true;
            return out;
        case ShaftContent::blocked:
            out.isBlocked = true;
            out.visibility = 0.0f;
            return out;
        case ShaftContent::unknown:
            break;
    }
    const VisibilitySample seen = sampleVisibility(hierarchy_, rays_, query.a, query.b, rayCount_);
    out.visibility = seen.mean;
    out.shadowA = base::Vec2(seen.gradientA);
    out.shadowB = base::Vec2(seen.gradientB);
    out.gradientA += out.shadowA;
    out.gradientB += out.shadowB;
    out.rays = seen.rays;
    out.isMixed = seen.isMixed;
    if (constant && !out.isMixed) {
        // A constant kernel has no spread, so a shadow that no ray met would never be looked for: it may take
        // as much as one ray more (Laplace's rule of succession).
        out.spreadA = out.spreadB = 1.0f / static_cast<float>(seen.rays + 2);
    }
    return out;
}

bool CoefficientService::settleContact(const Query& query, Coefficient& coefficient) const {
    const hierarchy::Shape& a = hierarchy_.shape(query.a);
    const hierarchy::Shape& b = hierarchy_.shape(query.b);
    const float least = std::min(a.sampledArea(), b.sampledArea());
    if (!coefficient.isMixed || hierarchy_.kind(query.b) != hierarchy::NodeKind::element || !a.isPlanar ||
        !b.isPlanar || glm::distance(a.center, b.center) >= a.radius + b.radius ||
        coefficient.coupling <= kContactFactor * least) {
        return false;
    }
    const std::uint64_t keyA = hierarchy_.key(query.a);
    const std::uint64_t keyB = hierarchy_.key(query.b);
    const bool isFirst = keyA <= keyB;
    const ContactSample contact = sampleContact(
        hierarchy_, rays_, isFirst ? query.a : query.b, isFirst ? query.b : query.a,
        static_cast<double>(coefficient.coupling), base::combine(std::min(keyA, keyB), std::max(keyA, keyB)));
    coefficient.rays = static_cast<std::uint16_t>(std::min(coefficient.rays + contact.rays, 0xffffU));
    if (contact.seen > 0.0 && contact.seen < contact.sent) {
        coefficient.visibility = static_cast<float>(contact.seen / contact.sent);
        coefficient.gradientA +=
            base::Vec2(isFirst ? contact.gradientA : contact.gradientB) - coefficient.shadowA;
        coefficient.gradientB +=
            base::Vec2(isFirst ? contact.gradientB : contact.gradientA) - coefficient.shadowB;
    }
    return true;
}

Coefficient CoefficientService::fromSource(const Query& query) const {
    Coefficient out;
    const ElementPoints a = makeElementPoints(hierarchy_, query.a);
    factorFromSource(a, hierarchy_, query.b, out);
    out.coupling *= hierarchy_.shape(query.a).sampledArea() / hierarchy_.shape(query.a).area;
    if (out.coupling <= 0.0f) {
        return out;
    }
    const VisibilitySample seen = sampleSourceVisibility(hierarchy_, rays_, query.a, query.b, rayCount_);
    out.visibility = seen.mean;
    out.gradientA += base::Vec2(seen.gradientA);
    out.rays = seen.rays;
    const bool isSky = hierarchy_.kind(query.b) == hierarchy::NodeKind::sky;
    // Every view of the sky is a mixture; what counts is how it differs over the receiver.
    out.isMixed = seen.isMixed && !isSky;
    if (isSky) {
        out.spreadA += seen.deviation;
    }
    return out;
}

}  // namespace fluxwalk::transport
