#include "core/solve/probes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "core/hierarchy/exposure.h"

namespace fluxwalk::solve {

std::vector<Probe> drawProbes(const Problem& problem, std::size_t count, std::uint64_t seed) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    std::vector<double> before{0.0};
    for (const NodeId id : h.patches()) {
        before.push_back(before.back() + static_cast<double>(h.shape(id).area));
    }
    std::vector<Probe> probes;
    if (!(before.back() > 0.0)) {
        return probes;
    }
    base::RandomStream random(base::combine(seed, 0x9206e5));
    // Points under solids are drawn again; a scene of hidden points only would never end, hence the bound.
    for (std::size_t tries = 0; probes.size() < count && tries < 100 * count; ++tries) {
        const double stratum =
            (static_cast<double>(probes.size()) + random.next()) / static_cast<double>(count);
        const auto at =
            std::upper_bound(before.begin(), before.end(), stratum * before.back()) - before.begin() - 1;
        const NodeId id = h.patches()[std::min(static_cast<std::size_t>(at), h.patches().size() - 1)];
        const hierarchy::ElementName name = h.name(id);
        const surface::Surface& surface = h.surfaceOf(id);
        const base::Vec2d st = random.next2();
        const base::Vec2d uv = surface::mapToRegion(surface::wholePatch(surface.domain(name.patch)), st).uv;
        const surface::SurfacePoint p = surface.evaluate(name.patch, uv);
        const Vec3d n = name.back ? -p.normal : p.normal;
        const auto hit = problem.rays.closest(problem.rays.halfLine(p.position, n, n));
        if (!hit || h.reached().isReached(base::index(hit->object), hit->back)) {
            probes.push_back({name.object, name.patch, name.back, uv, p.position, n});
        }
    }
    return probes;
}

std::vector<Rgb> gatherProbes(const Problem& problem, const std::vector<Probe>& probes) {
    std::vector<Rgb> values(probes.size(), Rgb(0.0f));
    problem.executor.forRange(probes.size(), 2, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Probe& p = probes[i];
            const auto leaf = findLeaf(problem, p.object, p.patch, p.back, p.uv);
            values[i] = leaf ? gatherAtPoint(problem, {*leaf, p.position, p.normal}) : Rgb(0.0f);
        }
    });
    return values;
}

double relativeRms(const std::vector<Rgb>& values, const std::vector<Rgb>& reference) {
    double squares = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Vec3d difference = Vec3d(values[i]) - Vec3d(reference[i]);
        squares += glm::dot(difference, difference);
        sum += static_cast<double>(reference[i].r + reference[i].g + reference[i].b);
    }
    const double n = 3.0 * static_cast<double>(std::max<std::size_t>(1, values.size()));
    return sum > 0.0 ? std::sqrt(squares / n) / (sum / n) : 0.0;
}

double relativeRmsOffLamps(const std::vector<Rgb>& values, const std::vector<Rgb>& reference) {
    constexpr double kLampward = 10.0;
    const auto sumOf = [](const Rgb& e) { return static_cast<double>(e.r + e.g + e.b); };
    std::vector<std::size_t> order(reference.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return sumOf(reference[a]) < sumOf(reference[b]); });
    double rest = 0.0;
    for (const Rgb& e : reference) {
        rest += sumOf(e);
    }
    while (order.size() > 1) {
        const double brightest = sumOf(reference[order.back()]);
        rest -= brightest;
        if (brightest * static_cast<double>(order.size() - 1) <= kLampward * rest) {
            break;
        }
        order.pop_back();
    }
    std::vector<Rgb> kept;
    std::vector<Rgb> keptReference;
    for (const std::size_t i : order) {
        kept.push_back(values[i]);
        keptReference.push_back(reference[i]);
    }
    return relativeRms(kept, keptReference);
}

}  // namespace fluxwalk::solve
