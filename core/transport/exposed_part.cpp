#include "core/transport/exposed_part.h"

#include <cmath>

namespace fluxwalk::transport {

ExposedPart findExposedPart(const hierarchy::Hierarchy& hierarchy, NodeId id,
                            const std::function<double(const SurfaceSample&)>& kernel) {
    const hierarchy::Shape& shape = hierarchy.shape(id);
    const ElementSampler sampler(hierarchy, id);
    std::array<double, 16> values{};
    std::array<base::Vec2d, 16> locals{};
    unsigned count = 0;
    double all = 0.0;
    double exposed = 0.0;
    base::Vec2d middle(0.0);
    for (unsigned cell = 0; cell < 16; ++cell) {
        const SurfaceSample p = sampler.inCell(cell);
        const double value = p.measure * kernel(p);
        all += value;
        if ((shape.exposedCells >> cell & 1u) != 0) {
            exposed += value;
            values[count] = value;
            locals[count] = p.local;
            middle += p.local;
            ++count;
        }
    }
    ExposedPart part;
    part.share = all > 0.0 ? exposed / all : static_cast<double>(shape.sampledArea() / shape.area);
    if (!(exposed > 0.0)) {
        return part;
    }
    middle /= count;
    const double mean = exposed / count;
    double ss = 0.0;
    double st = 0.0;
    double tt = 0.0;
    base::Vec2d rise(0.0);
    for (unsigned i = 0; i < count; ++i) {
        const base::Vec2d at = locals[i] - middle;
        ss += at.x * at.x;
        st += at.x * at.y;
        tt += at.y * at.y;
        rise += at * (values[i] / mean - 1.0);
    }
    // Cells in one row tell nothing of the slope across it.
    const double determinant = ss * tt - st * st;
    if (determinant > 1e-3 * (ss + tt) * (ss + tt)) {
        part.gradient = base::Vec2d(tt * rise.x - st * rise.y, ss * rise.y - st * rise.x) / determinant;
    }
    return part;
}

}  // namespace fluxwalk::transport
