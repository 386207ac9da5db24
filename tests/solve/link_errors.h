#pragma once

#include "core/base/random.h"
#include "core/hierarchy/local_frame.h"
#include "core/transport/element_sampler.h"
#include "tests/support/solving.h"

/// What links do wrong, measured by many rays.
namespace fluxwalk::test {

/// Error of a link's transport, both ways, as the oracles express it: power over the scene's area, in lux.
struct LinkError {
    double rms = 0.0;   ///< over points of the receiver
    double mean = 0.0;  ///< of the power that arrives
};

/// Radiosity of a node at local coordinates, as the solver's linear functions have it.
inline double radiosityAt(const hierarchy::Light& light, const base::Vec2d& local) {
    const base::Vec2d slope(base::channelMean(light.slopeS), base::channelMean(light.slopeT));
    return static_cast<double>(base::channelMean(light.radiosity)) + glm::dot(slope, local);
}

/// Irradiance that `receiver` gets through the link less what it should get, at side x side of its points,
/// from side x side points of `source` each.
inline LinkError measureOneWay(const Problem& problem, const hierarchy::Link& link, bool isAtA,
                               unsigned side) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const NodeId receiver = isAtA ? link.a : link.b;
    const NodeId source = isAtA ? link.b : link.a;
    const transport::ElementSampler onReceiver(h, receiver);
    const transport::ElementSampler onSource(h, source);
    const hierarchy::Light& light = h.light(source);
    const double area = static_cast<double>(h.shape(receiver).exposedArea());
    const double sourceArea = static_cast<double>(h.shape(source).exposedArea());
    const auto ownFrame = [&h](NodeId id, const base::Vec2d& local) {
        return h.name(id).back ? hierarchy::mirrorGradient(h.shape(id).cornerCount, base::Vec2(local))
                               : base::Vec2(local);
    };
    // Gradients and slopes are dual to coordinates: both stand in the region's order.
    const base::Vec2 gradientHere = (isAtA ? link.gradientA : link.gradientB).decode();
    const base::Vec2 gradientThere = (isAtA ? link.gradientB : link.gradientA).decode();
    const hierarchy::LocalFrame& frame = hierarchy::localFrame(h.shape(source).cornerCount);
    const double sent = static_cast<double>(
        base::channelMean(light.radiosity) +
        frame.product(gradientThere, {base::channelMean(light.slopeS), base::channelMean(light.slopeT)}));
    const double arriving = static_cast<double>(link.transfer()) * sent / area;
    std::vector<rays::Ray> rays(side * side);
    std::vector<std::uint8_t> blocked(side * side);
    std::vector<double> weights(side * side);
    double measure = 0.0;
    double squares = 0.0;
    double sum = 0.0;
    base::RandomStream random(base::combine(h.key(link.a), h.key(link.b)));
    for (unsigned i = 0; i < side * side; ++i) {
        const transport::SurfaceSample x = onReceiver.inStratum(i, side, random.next(), random.next());
        double all = 0.0;
        for (unsigned j = 0; j < side * side; ++j) {
            const transport::SurfaceSample y = onSource.inStratum(j, side, random.next(), random.next());
            const Vec3d d = y.position - x.position;
            const double r2 = std::max(glm::dot(d, d), 1e-12);
            const double kernel = std::max(0.0, glm::dot(d, x.normal)) *
                                  std::max(0.0, -glm::dot(d, y.normal)) / (base::kPi * r2 * r2);
            weights[j] = y.measure * kernel * radiosityAt(light, base::Vec2d(ownFrame(source, y.local)));
            all += y.measure;
            rays[j] = problem.rays.segment(x.position, x.normal, y.position, y.normal);
        }
        problem.rays.occluded(rays, blocked);
        double irradiance = 0.0;
        for (unsigned j = 0; j < side * side; ++j) {
            irradiance += blocked[j] != 0 ? 0.0 : weights[j] * sourceArea / all;
        }
        const double deviation =
            arriving * (1.0 + static_cast<double>(glm::dot(gradientHere, ownFrame(receiver, x.local)))) -
            irradiance;
        squares += x.measure * deviation * deviation;
        sum += x.measure * deviation;
        measure += x.measure;
    }
    const double scale = area / h.totalArea();
    return {std::sqrt(squares / measure) * scale, std::abs(sum / measure) * scale};
}

/// Of the direction that is worse.
inline LinkError measureLink(const Problem& problem, const hierarchy::Link& link, unsigned side) {
    const LinkError a = measureOneWay(problem, link, true, side);
    const LinkError b = measureOneWay(problem, link, false, side);
    return {std::max(a.rms, b.rms), std::max(a.mean, b.mean)};
}

}  // namespace fluxwalk::test
