#include <cstdio>

#include "core/base/parallel.h"
#include "core/surface/region.h"
#include "core/surface/sphere.h"

// Sums the true areas of a unit sphere's patches on the library's own threads.
int main() {
    using namespace fluxwalk;
    const surface::Sphere sphere(surface::Vec3d(0.0), 1.0);
    double areas[8] = {};
    base::Executor(2).forRange(sphere.patchCount(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto patch = static_cast<std::uint32_t>(i);
            areas[i] = sphere.area(patch, surface::wholePatch(sphere.domain(patch)));
        }
    });
    double sum = 0.0;
    for (const double area : areas) {
        sum += area;
    }
    std::printf("area of the unit sphere %.3f\n", sum);
    return 0;
}
