#include "core/solve/audit.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/hierarchy/local_frame.h"
#include "core/solve/cluster_exchange.h"

namespace fluxwalk::solve {

namespace {

using hierarchy::Hierarchy;
using hierarchy::NodeKind;

std::vector<NodeId> collectLeaves(const Hierarchy& h) {
    std::vector<NodeId> leaves;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        if (h.kind(id) == NodeKind::element && h.isLeaf(id) && h.shape(id).exposed > 0.0f) {
            leaves.push_back(id);
        }
    }
    return leaves;
}

Vec3d cosineDirection(const Vec3d& n, double u, double v) {
    const double sine = std::sqrt(u);
    const double angle = 2.0 * base::kPi * v;
    const Vec3d side = glm::normalize(glm::cross(n, std::abs(n.y) < 0.7 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1)));
    return sine * (std::cos(angle) * side + std::sin(angle) * glm::cross(n, side)) + std::sqrt(1.0 - u) * n;
}

// Flux that leaves the scene: every leaf sends rays in proportion to its power, each worth an equal part of
// the leaf's power.
Vec3d countEscaped(const Problem& problem, const std::vector<NodeId>& leaves, std::size_t rayCount) {
    const Hierarchy& h = problem.hierarchy;
    std::vector<double> before(leaves.size() + 1, 0.0);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const auto power = static_cast<double>(base::channelMean(h.light(leaves[i]).radiosity)) *
                           static_cast<double>(h.shape(leaves[i]).exposedArea());
        before[i + 1] = before[i] + power;
    }
    const double total = before.back();
    if (!(total > 0.0)) {
        return Vec3d(0.0);
    }
    base::RandomStream shifts(problem.options.seed);
    const double offset = shifts.next();
    const base::Vec2d shift = shifts.next2();
    std::vector<Vec3d> escaped(leaves.size(), Vec3d(0.0));
    problem.executor.forRange(leaves.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            // Systematic sampling: ray k belongs to the leaf whose share of the power holds (k + offset) /
            // rayCount.
            const auto scale = static_cast<double>(rayCount) / total;
            const auto first = static_cast<std::int64_t>(std::ceil(before[i] * scale - offset));
            const auto last = static_cast<std::int64_t>(std::ceil(before[i + 1] * scale - offset));
            if (first >= last) {
                continue;
            }
            const hierarchy::ElementName name = h.name(leaves[i]);
            const surface::Surface& surface = h.surfaceOf(leaves[i]);
            const surface::Region region = h.region(leaves[i]);
            base::RandomStream random(base::combine(h.key(leaves[i]), 0xe5ca9e));
            const auto mean = static_cast<double>(base::channelMean(h.light(leaves[i]).radiosity));
            const Vec3d worth = Vec3d(h.light(leaves[i]).radiosity) / (mean * scale);
            for (std::int64_t k = first; k < last; ++k) {
                base::Vec2d st = random.next2();
                const std::uint16_t cells = h.shape(leaves[i]).exposedCells;
                while ((cells >> (4 * static_cast<unsigned>(st.y * 4) + static_cast<unsigned>(st.x * 4)) &
                        1) == 0) {
                    st = random.next2();
                }
                const surface::SurfacePoint p =
                    surface.evaluate(name.patch, surface::mapToRegion(region, st).uv);
                const Vec3d n = name.back ? -p.normal : p.normal;
                // Successive rays, and so those of neighbours, cover the directions evenly.
                const base::Vec2d u = base::r2Point(static_cast<std::uint64_t>(k), shift);
                const auto hit =
                    problem.rays.closest(problem.rays.halfLine(p.position, n, cosineDirection(n, u.x, u.y)));
                escaped[i] += hit ? Vec3d(0.0) : worth;
            }
        }
    });
    Vec3d sum(0.0);
    for (const Vec3d& e : escaped) {
        sum += e;
    }
    return sum;
}

// Power of all patches over that of their leaves, less 1.
double computePullDefect(const Hierarchy& h, const std::vector<NodeId>& leaves) {
    const auto powerOf = [&h](std::span<const NodeId> nodes) {
        double power = 0.0;
        for (const NodeId id : nodes) {
            power += static_cast<double>(h.shape(id).exposedArea()) *
                     static_cast<double>(base::channelMean(h.light(id).radiosity));
        }
        return power;
    };
    const double sent = powerOf(leaves);
    return sent > 0.0 ? powerOf(h.patches()) / sent - 1.0 : 0.0;
}

}  // namespace

double Audit::relativeDefect() const {
    const Vec3d defect = emitted - absorbed - escaped;
    const double all = emitted.x + emitted.y + emitted.z;
    return all > 0.0 ? (std::abs(defect.x) + std::abs(defect.y) + std::abs(defect.z)) / all : 0.0;
}

std::vector<float> computeRowSums(const Problem& problem, const std::vector<float>& scale) {
    using base::Vec2;
    const Hierarchy& h = problem.hierarchy;
    // What arrives where everything has radiosity 1, and its slopes: ends of links are linear (Sweeper).
    std::vector<float> sums(h.nodeCount(), 0.0f);
    std::vector<Vec2> slopes(h.nodeCount(), Vec2(0.0f));
    ClusterExchange clusters(problem, scale, true);
    if (!clusters.isEmpty()) {
        std::vector<Rgb> arriving(h.patches().size());
        clusters.gather(0, arriving.size(), arriving);
        for (std::size_t i = 0; i < arriving.size(); ++i) {
            sums[base::index(h.patches()[i])] = arriving[i].g;
        }
    }
    problem.executor.forRange(h.nodeCount(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const NodeId id{static_cast<std::uint32_t>(i)};
            const float area = h.kind(id) == NodeKind::element ? h.shape(id).exposedArea() : 0.0f;
            if (area <= 0.0f) {
                continue;
            }
            double sum = 0.0;
            Vec2 slope(0.0f);
            for (const std::uint32_t l : problem.links.endingAt(id)) {
                const hierarchy::Link& link = problem.links.links[l];
                const bool isA = link.a == id;
                const NodeId source = isA ? link.b : link.a;
                const bool isCluster = h.kind(source) == NodeKind::cluster;
                if (isCluster || h.kind(source) == NodeKind::element) {
                    const float shown = isCluster       ? clusters.shownBy(l, source).g
                                        : scale.empty() ? 1.0f
                                                        : scale[base::index(source)];
                    const float transfer = (scale.empty() ? 1.0f : scale[i]) * shown * link.transfer();
                    sum += static_cast<double>(transfer);
                    slope += transfer * (isA ? link.gradientA : link.gradientB).decode();
                }
            }
            const double perArea = 1.0 / static_cast<double>(area);
            sums[i] += static_cast<float>(sum * perArea);
            slopes[i] = slope * static_cast<float>(perArea);
        }
    });
    // Parents stand before their children.
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        if (h.kind(id) != NodeKind::element || h.isLeaf(id)) {
            continue;
        }
        // Children take over the linear function about their own mean, so that the means are kept.
        const hierarchy::ChildFrame& frame =
            hierarchy::childFrame(h.shape(id).cornerCount, h.shape(id).split);
        Vec2 middle(0.0f);
        float exposed = 0.0f;
        for (unsigned c = 0; c < 4; ++c) {
            const float part = h.shape(h.child(id, c)).areaInParent();
            middle += part * frame.middle(c);
            exposed += part;
        }
        middle = exposed > 0.0f ? middle / exposed : Vec2(0.0f);
        for (unsigned c = 0; c < 4; ++c) {
            const std::uint32_t child = base::index(h.child(id, c));
            const Vec2 offset = frame.middle(c) - middle;
            const float part = h.shape(h.child(id, c)).partOfParent();
            sums[child] += part * (sums[i] + glm::dot(offset, slopes[i]));
            slopes[child] += part * frame.scale(c) * slopes[i];
        }
        sums[i] = 0.0f;
    }
    return sums;
}

Audit auditEnergy(const Problem& problem, std::size_t rayCount) {
    const Hierarchy& h = problem.hierarchy;
    Audit audit;
    const std::vector<NodeId> leaves = collectLeaves(h);
    for (const NodeId id : leaves) {
        const hierarchy::Light& light = h.light(id);
        const auto area = static_cast<double>(h.shape(id).exposedArea());
        audit.emitted += area * Vec3d(light.emission);
        audit.absorbed += area * (Vec3d(1.0) - Vec3d(light.reflectance)) * Vec3d(light.irradiance);
    }
    // Light sources without area: what arrives through their links, and what they send past everything.
    for (const NodeId id : h.sources()) {
        Vec3d arrived(0.0);
        for (const std::uint32_t l : problem.links.endingAt(id)) {
            const hierarchy::Link& link = problem.links.links[l];
            arrived += Vec3d(h.light(id).radiosity) * static_cast<double>(link.transfer());
        }
        audit.emitted += arrived;
    }
    audit.pullDefect = computePullDefect(h, leaves);
    audit.isClosed = !h.reached().isOpen;
    audit.escaped = audit.isClosed ? Vec3d(0.0) : countEscaped(problem, leaves, rayCount);

    if (audit.isClosed) {
        const std::vector<float> sums = computeRowSums(problem, {});
        std::vector<std::pair<float, float>> defects;
        double mean = 0.0;
        double area = 0.0;
        for (const NodeId id : leaves) {
            const float a = h.shape(id).exposedArea();
            const float defect = std::abs(sums[base::index(id)] - 1.0f);
            defects.emplace_back(defect, a);
            mean += static_cast<double>(a * defect);
            area += static_cast<double>(a);
        }
        std::sort(defects.begin(), defects.end());
        double passed = 0.0;
        for (const auto& [defect, a] : defects) {
            passed += static_cast<double>(a);
            if (passed >= 0.99 * area) {
                audit.rowDefectP99 = static_cast<double>(defect);
                break;
            }
        }
        audit.rowDefectMean = area > 0.0 ? mean / area : 0.0;
    }
    return audit;
}

}  // namespace fluxwalk::solve
