#include "core/surface/projected_surface.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/surface/region.h"

namespace fluxwalk::surface {

namespace {

/// The object's normal must be within 85 degrees of the direction of projection (ALGORITHMS 1.6).
constexpr double kLeastCosine = 0.08715574274765817;
/// An area below this part of the planar one is a fold.
constexpr double kLeastArea = 1e-3;
constexpr unsigned kLattice = 8;

double determinant(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return glm::dot(a, glm::cross(b, c));
}

// To a multiple of 2^-53, so that 1 - s is exact in double and both sides of an edge read the same s.
double quantize(double s) {
    return std::round(s * 0x1.0p53) * 0x1.0p-53;
}

}  // namespace

std::optional<ProjectedPoint> Projectable::closestPoint(const Vec3d& /*position*/) const {
    return std::nullopt;
}

ProjectedSurface::ProjectedSurface(std::shared_ptr<const Projectable> object, Cage cage)
    : object_(std::move(object)), cage_(std::move(cage)) {
    FLUXWALK_CHECK(object_ != nullptr);
    for (const auto& face : cage_.faces) {
        double longest = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
            FLUXWALK_CHECK_LT(face[k], cage_.vertices.size());
            longest =
                std::max(longest, glm::distance(cage_.vertices[face[k]], cage_.vertices[face[(k + 1) % 4]]));
        }
        capture_.push_back(longest);
    }
    snapCorners();
    countProjections();
    for (std::uint32_t patch = 0; patch < patchCount(); ++patch) {
        boxes_.push_back(bounds(patch, wholePatch(domain(patch))).box);
    }
}

void ProjectedSurface::snapCorners() {
    normals_.assign(cage_.vertices.size(), Vec3d(0.0));
    std::vector<double> reach(cage_.vertices.size(), 0.0);
    for (std::size_t f = 0; f < cage_.faces.size(); ++f) {
        const auto& face = cage_.faces[f];
        const auto& v = cage_.vertices;
        const Vec3d across = glm::cross(v[face[2]] - v[face[0]], v[face[3]] - v[face[1]]);
        const Vec3d normal =
            face[2] == face[3] ? glm::cross(v[face[1]] - v[face[0]], v[face[2]] - v[face[0]]) : across;
        for (std::size_t k = 0; k < (face[2] == face[3] ? 3u : 4u); ++k) {
            normals_[face[k]] += glm::normalize(normal);
            reach[face[k]] = std::max(reach[face[k]], capture_[f]);
        }
    }
    for (std::size_t i = 0; i < cage_.vertices.size(); ++i) {
        if (reach[i] == 0.0) {
            continue;
        }
        const Placed placed = project(cage_.vertices[i], normals_[i], reach[i]);
        if (placed.outcome == Outcome::planar) {
            ++count_.unsnapped;
            normals_[i] = glm::normalize(normals_[i]);
        } else {
            cage_.vertices[i] = placed.at.position;
            normals_[i] = placed.at.normal;
        }
    }
}

void ProjectedSurface::countProjections() {
    for (std::uint32_t patch = 0; patch < patchCount(); ++patch) {
        bool isSmooth = true;
        for (unsigned j = 0; j <= kLattice; ++j) {
            for (unsigned i = 0; i <= (isTriangle(patch) ? kLattice - j : kLattice); ++i) {
                const Vec2d uv(static_cast<double>(i) / kLattice, static_cast<double>(j) / kLattice);
                const Chart chart = chartAt(patch, uv);
                const Placed placed = place(patch, uv, chart);
                ++count_.points;
                count_.reversed += placed.outcome == Outcome::ray && placed.at.t < 0.0 ? 1 : 0;
                count_.closest += placed.outcome == Outcome::closest ? 1 : 0;
                count_.unsnapped += placed.outcome == Outcome::planar ? 1 : 0;
                isSmooth = isSmooth && placed.outcome == Outcome::ray;
                if (placed.outcome == Outcome::ray) {
                    const double cosine = glm::dot(placed.at.normal, glm::normalize(chart.direction));
                    const double growth = spread(chart, placed.at.t) / spread(chart, 0.0);
                    count_.leastCosine = std::min(count_.leastCosine, cosine);
                    count_.leastGrowth = std::min(count_.leastGrowth, growth);
                }
            }
        }
        isSmooth_.push_back(isSmooth ? 1 : 0);
    }
}

PatchDomain ProjectedSurface::domain(std::uint32_t patch) const {
    return isTriangle(patch) ? PatchDomain::triangle : PatchDomain::quad;
}

ProjectedSurface::Chart ProjectedSurface::chartAt(std::uint32_t patch, const Vec2d& uv) const {
    const auto& face = cage_.faces[patch];
    // Bilinear c0 + u c1 + v c2 + u v c3; for triangles c3 is 0.
    const auto interpolate = [&](const std::vector<Vec3d>& at, Vec3d& value, std::array<Vec3d, 2>& slope) {
        const Vec3d& a = at[face[0]];
        const Vec3d& b = at[face[1]];
        const Vec3d& c = at[face[2]];
        const Vec3d& d = at[face[3]];
        if (isTriangle(patch)) {
            value = (1.0 - uv.x - uv.y) * a + uv.x * b + uv.y * c;
            slope = {b - a, c - a};
        } else {
            value = (1.0 - uv.y) * ((1.0 - uv.x) * a + uv.x * b) + uv.y * ((1.0 - uv.x) * d + uv.x * c);
            slope = {(1.0 - uv.y) * (b - a) + uv.y * (c - d), (1.0 - uv.x) * (d - a) + uv.x * (c - b)};
        }
    };
    Chart chart;
    interpolate(cage_.vertices, chart.point, chart.pointSlope);
    interpolate(normals_, chart.direction, chart.directionSlope);
    return chart;
}

std::optional<ProjectedSurface::Edge> ProjectedSurface::edgeAt(std::uint32_t patch, unsigned side,
                                                               const Vec2d& uv) const {
    const unsigned corners = isTriangle(patch) ? 3 : 4;
    double s = 0.0;
    if (corners == 3) {
        const std::array<bool, 3> isOn{uv.y == 0.0, 1.0 - uv.x == uv.y, uv.x == 0.0};
        if (!isOn[side]) {
            return std::nullopt;
        }
        s = std::array{uv.x, uv.y, 1.0 - uv.y}[side];
    } else {
        const std::array<bool, 4> isOn{uv.y == 0.0, uv.x == 1.0, uv.y == 1.0, uv.x == 0.0};
        if (!isOn[side]) {
            return std::nullopt;
        }
        s = std::array{uv.x, uv.y, 1.0 - uv.x, 1.0 - uv.y}[side];
    }
    const std::uint32_t from = cage_.faces[patch][side];
    const std::uint32_t to = cage_.faces[patch][(side + 1) % corners];
    return from < to ? Edge{from, to, s} : Edge{to, from, 1.0 - s};
}

Vec2d ProjectedSurface::onEdge(std::uint32_t patch, unsigned side, double s) const {
    const unsigned corners = isTriangle(patch) ? 3 : 4;
    if (cage_.faces[patch][side] > cage_.faces[patch][(side + 1) % corners]) {
        s = 1.0 - s;
    }
    if (corners == 3) {
        return std::array{Vec2d(s, 0.0), Vec2d(1.0 - s, s), Vec2d(0.0, 1.0 - s)}[side];
    }
    return std::array{Vec2d(s, 0.0), Vec2d(1.0, s), Vec2d(1.0 - s, 1.0), Vec2d(0.0, 1.0 - s)}[side];
}

ProjectedSurface::Placed ProjectedSurface::project(const Vec3d& point, const Vec3d& direction,
                                                   double capture) const {
    const double length = glm::length(direction);
    if (length < kLeastCosine) {
        return {{point, {}, 0.0}, Outcome::planar};
    }
    const auto faces = [&](const ProjectedPoint& p) {
        return glm::dot(p.normal, direction) >= kLeastCosine * length;
    };
    // Both ways, starting a little behind the point, which may lie on the object already.
    const double tiny = 1e-12 * capture / length;
    double reach = capture / length;
    Placed best;
    for (const double sign : {1.0, -1.0}) {
        double from = -tiny;
        while (auto hit = object_->intersect(point, sign * direction, from, reach)) {
            if (faces(*hit)) {
                reach = std::abs(hit->t);
                best = {{hit->position, hit->normal, sign * hit->t}, Outcome::ray};
                break;
            }
            from = hit->t + tiny;
        }
    }
    if (best.outcome == Outcome::ray) {
        return best;
    }
    if (auto nearest = object_->closestPoint(point)) {
        if (faces(*nearest) && glm::distance(nearest->position, point) <= capture) {
            return {*nearest, Outcome::closest};
        }
    }
    return {{point, {}, 0.0}, Outcome::planar};
}

ProjectedSurface::Placed ProjectedSurface::place(std::uint32_t patch, const Vec2d& uv,
                                                 const Chart& chart) const {
    const unsigned corners = isTriangle(patch) ? 3 : 4;
    for (unsigned side = 0; side < corners; ++side) {
        if (const auto edge = edgeAt(patch, side, uv)) {
            if (edge->s == 0.0 || edge->s == 1.0) {
                const std::uint32_t corner = edge->s == 0.0 ? edge->first : edge->second;
                return {{cage_.vertices[corner], normals_[corner], 0.0}, Outcome::ray};
            }
            const Vec3d& a = cage_.vertices[edge->first];
            const Vec3d& b = cage_.vertices[edge->second];
            const Vec3d direction =
                (1.0 - edge->s) * normals_[edge->first] + edge->s * normals_[edge->second];
            return project((1.0 - edge->s) * a + edge->s * b, direction, glm::distance(a, b));
        }
    }
    Placed placed = project(chart.point, chart.direction, capture_[patch]);
    if (placed.outcome == Outcome::ray) {
        const double flat = spread(chart, 0.0);
        const double grown = spread(chart, placed.at.t);
        if (!(flat > 0.0 && grown >= kLeastArea * flat)) {
            return {{chart.point, {}, 0.0}, Outcome::planar};
        }
    }
    return placed;
}

double ProjectedSurface::spread(const Chart& chart, double t) {
    return determinant(chart.pointSlope[0] + t * chart.directionSlope[0],
                       chart.pointSlope[1] + t * chart.directionSlope[1], chart.direction);
}

SurfacePoint ProjectedSurface::evaluate(std::uint32_t patch, const Vec2d& uv) const {
    const Chart chart = chartAt(patch, uv);
    const Placed placed = place(patch, uv, chart);
    if (placed.outcome == Outcome::ray) {
        // x_u = p_u + t d_u + t_u d lies in the tangent plane, which gives t_u; then
        // x_u x x_v = n det(p_u + t d_u, p_v + t d_v, d) / (n . d).
        return {placed.at.position, placed.at.normal,
                std::abs(spread(chart, placed.at.t) / glm::dot(placed.at.normal, chart.direction))};
    }
    const Vec3d flat = glm::cross(chart.pointSlope[0], chart.pointSlope[1]);
    const double measure = glm::length(flat);
    if (placed.outcome == Outcome::planar) {
        const Vec3d normal = measure > 0.0 ? flat / measure : glm::normalize(chart.direction);
        return {placed.at.position, normal, measure};
    }
    // The nearest point has no formula for its derivative; the step balances cutting off (h^2) and rounding
    // (1e-16 / h).
    constexpr double kStep = 1e-5;
    std::array<Vec3d, 2> slope{};
    for (int k = 0; k < 2; ++k) {
        Vec2d step(0.0);
        step[k] = kStep;
        const auto at = [&](const Vec2d& where) {
            const Chart c = chartAt(patch, where);
            return project(c.point, c.direction, capture_[patch]).at.position;
        };
        slope[static_cast<std::size_t>(k)] = (at(uv + step) - at(uv - step)) / (2.0 * kStep);
    }
    return {placed.at.position, placed.at.normal, glm::length(glm::cross(slope[0], slope[1]))};
}

Vec2d ProjectedSurface::splitPoint(std::uint32_t patch, const Vec2d& a, const Vec2d& b) const {
    for (unsigned side = 0; side < (isTriangle(patch) ? 3u : 4u); ++side) {
        const auto first = edgeAt(patch, side, a);
        const auto second = edgeAt(patch, side, b);
        if (first && second) {
            // As both neighbours see it: weights from the edge's ends alone.
            const auto weight = [&](double s) {
                return 1.0 / glm::length((1.0 - s) * normals_[first->first] + s * normals_[first->second]);
            };
            const double wa = weight(first->s);
            const double wb = weight(second->s);
            return onEdge(patch, side, quantize((wa * first->s + wb * second->s) / (wa + wb)));
        }
    }
    const double weightA = 1.0 / glm::length(chartAt(patch, a).direction);
    const double weightB = 1.0 / glm::length(chartAt(patch, b).direction);
    return (weightA * a + weightB * b) / (weightA + weightB);
}

Vec2d ProjectedSurface::texcoord(std::uint32_t /*patch*/, const Vec2d& uv, unsigned /*set*/) const {
    return uv;
}

bool ProjectedSurface::canSeeItself(std::uint32_t /*patch*/, bool back) const {
    return back || !object_->isConvex();
}

double ProjectedSurface::area(std::uint32_t patch, const Region& region) const {
    double measure = 0.0;
    for (std::uint32_t k = 1; k + 1 < region.cornerCount; ++k) {
        const Vec2d a = region.corners[k] - region.corners[0];
        const Vec2d b = region.corners[k + 1] - region.corners[0];
        measure += 0.5 * (a.x * b.y - a.y * b.x);
    }
    const double whole = isTriangle(patch) ? 0.5 : 1.0;
    if (measure < whole / 32.0) {
        return Surface::area(patch, region);
    }
    double sum = 0.0;
    for (const Region& part : childRegions(*this, patch, region, Split::quarters)) {
        sum += area(patch, part);
    }
    return sum;
}

ProjectedSurface::Located ProjectedSurface::locateIn(std::uint32_t patch, const Vec3d& position) const {
    // Newton on p(u,v) + t d(u,v) = position: no ray is needed to undo the projection.
    constexpr int kMostSteps = 24;
    Located at;
    at.uv = isTriangle(patch) ? Vec2d(1.0 / 3.0) : Vec2d(0.5);
    for (int step = 0; step < kMostSteps; ++step) {
        const Chart c = chartAt(patch, at.uv);
        const Vec3d u = c.pointSlope[0] + at.t * c.directionSlope[0];
        const Vec3d v = c.pointSlope[1] + at.t * c.directionSlope[1];
        const Vec3d rest = position - c.point - at.t * c.direction;
        const double det = determinant(u, v, c.direction);
        if (det == 0.0) {
            return at;
        }
        const Vec2d move(determinant(rest, v, c.direction) / det, determinant(u, rest, c.direction) / det);
        const double size = std::max(std::abs(move.x), std::abs(move.y));
        if (!(size < 1e6)) {
            return at;
        }
        // Far steps are shortened: the equations bend.
        const double part = std::min(1.0, 0.5 / size);
        at.uv += part * move;
        at.t += part * determinant(u, v, rest) / det;
        if (size < 1e-14) {
            at.converged = true;
            return at;
        }
        at.converged = size < 1e-10;
    }
    return at;
}

Vec2d ProjectedSurface::locate(std::uint32_t patch, const Vec3d& position) const {
    Vec2d uv = glm::max(locateIn(patch, position).uv, Vec2d(0.0));
    if (!isTriangle(patch)) {
        return glm::min(uv, Vec2d(1.0));
    }
    const double sum = uv.x + uv.y;
    return sum > 1.0 ? uv / sum : uv;
}

std::optional<SurfaceHit> ProjectedSurface::intersect(const Vec3d& origin, const Vec3d& direction,
                                                      double tNear, double tFar) const {
    const auto hit = object_->intersect(origin, direction, tNear, tFar);
    if (!hit || patchCount() == 0) {
        return std::nullopt;
    }
    // Faces overlap nowhere, but their direction fields reach through the object: the nearest face whose
    // inside holds the point, else the one whose inside is least missed.
    SurfaceHit found{hit->t, 0, Vec2d(0.0)};
    double best = -std::numeric_limits<double>::infinity();
    for (std::uint32_t patch = 0; patch < patchCount(); ++patch) {
        const Box& box = boxes_[patch];
        const double slack = 1e-9 * capture_[patch];
        const Vec3d& p = hit->position;
        if (glm::any(glm::lessThan(p, box.lower - slack)) ||
            glm::any(glm::greaterThan(p, box.upper + slack))) {
            continue;
        }
        const Located at = locateIn(patch, p);
        if (!at.converged || glm::dot(hit->normal, chartAt(patch, at.uv).direction) <= 0.0) {
            continue;
        }
        const double least = isTriangle(patch) ? std::min({at.uv.x, at.uv.y, 1.0 - at.uv.x - at.uv.y})
                                               : std::min({at.uv.x, at.uv.y, 1.0 - at.uv.x, 1.0 - at.uv.y});
        const double distance = std::abs(at.t) / capture_[patch];
        const double rank = least >= -1e-9 ? 1.0 / (1.0 + distance) : least - distance;
        if (rank > best) {
            best = rank;
            found.patch = patch;
        }
    }
    found.uv = locate(found.patch, hit->position);
    return found;
}

}  // namespace fluxwalk::surface
