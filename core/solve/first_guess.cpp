#include "core/solve/first_guess.h"

#include "core/base/photometry.h"

namespace fluxwalk::solve {

double estimateAmbient(const Problem& problem) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    double flux = 0.0;
    double reflected = 0.0;
    for (const NodeId id : h.patches()) {
        const auto area = static_cast<double>(h.shape(id).exposedArea());
        flux += area * static_cast<double>(base::channelMean(h.light(id).emission));
        reflected += area * static_cast<double>(base::channelMean(h.light(id).reflectance));
    }
    for (const NodeId id : h.sources()) {
        const bool isPointLike =
            h.kind(id) == hierarchy::NodeKind::light &&
            problem.scene->lights[h.lightIndex(id)].kind != scene::LightKind::directional;
        const double measure = isPointLike ? 4.0 * base::kPi : 0.1 * h.totalArea();
        flux += measure * static_cast<double>(base::channelMean(h.light(id).radiosity));
    }
    const double area = h.totalArea();
    return area > reflected ? 0.5 * flux / (area - reflected) : 0.0;
}

void seedRadiosity(Problem& problem, double ambient) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    const auto e = static_cast<float>(ambient);
    for (const NodeId id : h.patches()) {
        hierarchy::Light& light = h.light(id);
        light.irradiance = Rgb(e);
        light.radiosity = light.emission + light.reflectance * e;
        light.residual = 0.5f * base::channelMean(light.reflectance) * e;
    }
    h.pullClusters();
}

void darken(Problem& problem) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        hierarchy::Light& light = h.light(NodeId{i});
        light.irradiance = light.radiosity = light.slopeS = light.slopeT = Rgb(0.0f);
        light.residual = 0.0f;
    }
}

double meanIrradiance(const hierarchy::Hierarchy& h) {
    double sum = 0.0;
    for (const NodeId id : h.patches()) {
        sum += static_cast<double>(h.shape(id).exposedArea() * base::channelMean(h.light(id).irradiance));
    }
    return h.totalArea() > 0.0 ? sum / h.totalArea() : 0.0;
}

double firstThreshold(OracleKind oracle, double ambient) {
    return ambient * (oracle == OracleKind::bf ? 0.3 : 1e-3);
}

}  // namespace fluxwalk::solve
