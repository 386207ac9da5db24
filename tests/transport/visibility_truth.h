#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/surface/region.h"
#include "tests/support/built.h"
#include "tests/support/statistics.h"

/// What visibility estimates are compared with.
namespace fluxwalk::test {

struct Truth {
    double value = 0.0;
    double error = 0.0;
};

/// Kernel-weighted visibility by `count` random rays, by area measure over the exposed cells.
inline Truth findTruth(const Built& built, base::NodeId a, base::NodeId b, int count) {
    base::RandomStream random(4242);
    const std::array<base::NodeId, 2> ids{a, b};
    const std::array<surface::Region, 2> regions{built.tree.region(a), built.tree.region(b)};
    // Ratio of means over independent batches.
    Sample batches;
    for (int batch = 0; batch < 50; ++batch) {
        std::vector<rays::Ray> bundle;
        std::vector<double> weights;
        for (int i = 0; i < count / 50; ++i) {
            std::array<surface::SurfacePoint, 2> p;
            double weight = 1.0;
            for (std::size_t end = 0; end < 2; ++end) {
                const hierarchy::ElementName name = built.tree.name(ids[end]);
                const base::Vec2d st = random.next2();
                const auto cell = static_cast<unsigned>(st.x * 4.0) + 4 * static_cast<unsigned>(st.y * 4.0);
                const surface::RegionPoint where = surface::mapToRegion(regions[end], st);
                p[end] = built.tree.surfaceOf(ids[end]).evaluate(name.patch, where.uv);
                p[end].normal = name.back ? -p[end].normal : p[end].normal;
                weight *= (static_cast<unsigned>(built.tree.shape(ids[end]).exposedCells) >> cell & 1u) != 0
                              ? p[end].jacobian * where.jacobian
                              : 0.0;
            }
            const base::Vec3d d = p[1].position - p[0].position;
            const double r2 = glm::dot(d, d);
            weight *= std::max(0.0, glm::dot(p[0].normal, d)) * std::max(0.0, -glm::dot(p[1].normal, d)) /
                      (r2 * r2);
            if (weight > 0.0) {
                bundle.push_back(built.rays.segment(p[0].position, p[0].normal, p[1].position, p[1].normal));
                weights.push_back(weight);
            }
        }
        std::vector<std::uint8_t> blocked(bundle.size());
        built.rays.occluded(bundle, blocked);
        double seen = 0.0;
        double all = 0.0;
        for (std::size_t i = 0; i < bundle.size(); ++i) {
            all += weights[i];
            seen += blocked[i] != 0 ? 0.0 : weights[i];
        }
        batches.add(seen / all);
    }
    return {batches.mean(), batches.standardError()};
}

}  // namespace fluxwalk::test
