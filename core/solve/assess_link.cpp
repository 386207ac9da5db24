#include "core/solve/assess_link.h"

#include <algorithm>

#include "core/base/normal_cone.h"
#include "core/base/photometry.h"
#include "core/transport/certain_bounds.h"
#include "core/transport/coefficients.h"
#include "core/transport/visibility.h"

namespace fluxwalk::solve {

namespace {

using hierarchy::Hierarchy;
using hierarchy::Link;
using hierarchy::NodeKind;
using hierarchy::Shape;

// The spread that a curved end's cone of normals implies for light from `direction`.
float curvatureOf(const Shape& shape, const base::Vec3& direction) {
    const float distance = glm::length(direction);
    const bool isCluster = shape.cornerCount == 0;
    if (shape.isPlanar || isCluster || distance <= 0.0f) {
        return 0.0f;
    }
    const double angle = base::NormalCone::angleBetween(Vec3d(shape.axis), Vec3d(direction / distance));
    return transport::boundCurvature(static_cast<float>(angle), shape.halfAngle);
}

bool hasConstantKernel(const Hierarchy& h, const Link& link) {
    if (h.kind(link.a) != NodeKind::element || h.kind(link.b) != NodeKind::element) {
        return false;
    }
    const hierarchy::ElementName a = h.name(link.a);
    const hierarchy::ElementName b = h.name(link.b);
    return a.object == b.object && a.back == b.back && h.surfaceOf(link.a).exactKernel(a.back);
}

/// Of the rays between clusters, few say anything of one pair of their surfaces.
constexpr unsigned kTellingRays = 16;

float visibilityUpper(const Link& link, bool isCluster, transport::RayCount rays) {
    if (link.isOpen()) {
        return 1.0f;
    }
    const unsigned all = transport::raysOf(rays);
    return transport::visibilityUpperBound(link.visibility(), isCluster ? std::min(kTellingRays, all) : all);
}

// Whether rays were blocked and rays passed.
bool isPartlyBlocked(const Link& link) {
    return !link.isOpen() && link.visibility() > 0.0f && link.visibility() < 1.0f;
}

}  // namespace

transport::LinkAssessment assessLink(const Problem& problem, const Link& link, float enough) {
    const Hierarchy& h = problem.hierarchy;
    const hierarchy::Light& a = h.light(link.a);
    const hierarchy::Light& b = h.light(link.b);
    const Shape& shapeA = h.shape(link.a);
    const Shape& shapeB = h.shape(link.b);
    const NodeKind kindB = h.kind(link.b);
    const bool isOneWay = kindB == NodeKind::light || kindB == NodeKind::sky;
    transport::LinkBounds k;
    k.coupling = link.coupling;
    k.visibility = link.visibility();
    // Every view of the sky is a mixture; what counts is how it differs over the receiver, its spread.
    k.isMixed = isPartlyBlocked(link) && kindB != NodeKind::sky;
    k.isCluster = h.kind(link.a) == NodeKind::cluster || kindB == NodeKind::cluster;
    k.visibilityUpper = visibilityUpper(link, k.isCluster, problem.options.visibilityRays);
    k.spreadA = hierarchy::UncertaintyCode::decode(link.spreadA);
    k.spreadB = isOneWay ? 0.0f : hierarchy::UncertaintyCode::decode(link.spreadB);
    // Where the kernel is one constant, distance makes up for what the cosines do.
    const float curvature =
        hasConstantKernel(h, link) ? 0.0f : static_cast<float>(problem.options.curvatureWeight);
    k.curvatureA = curvature * curvatureOf(shapeA, shapeB.center - shapeA.center);
    k.curvatureB = isOneWay ? 0.0f : curvature * curvatureOf(shapeB, shapeA.center - shapeB.center);
    k.radiosityA = isOneWay ? 0.0f : base::channelMean(a.radiosity);
    k.radiosityB = base::channelMean(b.radiosity);
    k.residualA = isOneWay ? 0.0f : a.residual;
    k.residualB = b.residual;
    k.rangeA = isOneWay ? 0.0f : a.range();
    k.rangeB = b.range();
    k.areaA = shapeA.exposedArea();
    k.areaB = isOneWay ? 1.0f : shapeB.exposedArea();
    k.radiusA = shapeA.radius;
    k.radiusB = isOneWay ? 0.0f : shapeB.radius;
    k.distance = glm::distance(shapeA.center, shapeB.center);
    k.isOpen = link.isOpen();
    k.sceneArea = static_cast<float>(h.totalArea());
    if (problem.options.oracle == OracleKind::strict) {
        // Splitting is always safe.
        const OracleKind sampled = k.isOpen ? OracleKind::bounded : OracleKind::bfa;
        const transport::LinkAssessment quick = transport::assess(sampled, k);
        if (quick.error > enough) {
            return quick;
        }
        const transport::PairBounds bounds = transport::boundPair(h, link.a, link.b);
        k.factorA = bounds.atA;
        k.factorB = bounds.atB;
    }
    return transport::assess(problem.options.oracle, k);
}

}  // namespace fluxwalk::solve
