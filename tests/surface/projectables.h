#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/surface/bernstein.h"
#include "core/surface/dual_cage.h"
#include "core/surface/region.h"
#include "core/surface/sphere.h"

/// Known shapes that hide their parameterisation, with coarse cages.
namespace fluxwalk::test {

using base::kPi;
using base::Vec2d;
using base::Vec3d;

/// A sphere that only meets rays.
class BareSphere final : public surface::Projectable {
  public:
    BareSphere(const Vec3d& center, double radius)
        : center_(center), radius_(radius), sphere_(center, radius) {}

    std::optional<surface::ProjectedPoint> intersect(const Vec3d& origin, const Vec3d& direction,
                                                     double tNear, double tFar) const override {
        const auto hit = sphere_.intersect(origin, direction, tNear, tFar);
        if (!hit) {
            return std::nullopt;
        }
        const Vec3d position = origin + hit->t * direction;
        return surface::ProjectedPoint{position, glm::normalize(position - center_), hit->t};
    }
    double normalVariation(const Vec3d& /*point*/, double radius) const override {
        return radius >= 2.0 * radius_ ? kPi : 2.0 * std::asin(radius / (2.0 * radius_));
    }
    bool isConvex() const override { return true; }
    surface::Box bounds() const override { return sphere_.bounds(); }

    const surface::Sphere& sphere() const { return sphere_; }

  private:
    Vec3d center_;
    double radius_;
    surface::Sphere sphere_;
};

/// A torus about the y axis by its quartic alone: (|x|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + z^2).
class BareTorus final : public surface::Projectable {
  public:
    BareTorus(double major, double minor) : major_(major), minor_(minor) {}

    std::optional<surface::ProjectedPoint> intersect(const Vec3d& origin, const Vec3d& direction,
                                                     double tNear, double tFar) const override {
        // Within the sphere about it.
        const surface::Sphere around(Vec3d(0.0), 1.001 * (major_ + minor_));
        const double inf = std::numeric_limits<double>::infinity();
        const auto enter = around.intersect(origin, direction, -inf, inf);
        if (!enter) {
            return std::nullopt;
        }
        const auto leave = around.intersect(origin, direction, enter->t, inf);
        const double a = std::max(tNear, enter->t);
        const double b = std::min(tFar, leave ? leave->t : enter->t);
        if (!(a < b)) {
            return std::nullopt;
        }
        const Vec3d from = origin + a * direction;
        const Vec3d to = origin + b * direction;
        const double shift = major_ * major_ - minor_ * minor_;
        const auto flat = [](const Vec3d& v) { return Vec3d(v.x, 0.0, v.z); };
        const surface::Bernstein<3> squared{glm::dot(from, from) + shift, glm::dot(from, to) + shift,
                                            glm::dot(to, to) + shift};
        const surface::Bernstein<3> ring{glm::dot(flat(from), flat(from)), glm::dot(flat(from), flat(to)),
                                         glm::dot(flat(to), flat(to))};
        surface::Bernstein<5> f = surface::multiply(squared, squared);
        const surface::Bernstein<5> raised = surface::multiply(ring, surface::Bernstein<3>{1, 1, 1});
        for (std::size_t i = 0; i < 5; ++i) {
            f[i] -= 4.0 * major_ * major_ * raised[i];
        }
        const auto s = surface::firstCrossing(f);
        if (!s || *s <= 0.0) {
            return std::nullopt;
        }
        const double t = a + *s * (b - a);
        const Vec3d position = origin + t * direction;
        return surface::ProjectedPoint{position, normalAt(position), t};
    }
    // The normal is (x - q) / r with q the ring's point below x, and q moves by at most R / (R - r) times as
    // much as x does.
    double normalVariation(const Vec3d& /*point*/, double radius) const override {
        const double chord = radius * (1.0 + major_ / (major_ - minor_)) / minor_;
        return chord >= 2.0 ? kPi : 2.0 * std::asin(0.5 * chord);
    }
    surface::Box bounds() const override {
        const Vec3d reach(major_ + minor_, minor_, major_ + minor_);
        return {-reach, reach};
    }

    Vec3d ringPoint(const Vec3d& x) const { return major_ * glm::normalize(Vec3d(x.x, 0.0, x.z)); }
    Vec3d normalAt(const Vec3d& x) const { return glm::normalize(x - ringPoint(x)); }
    Vec3d nearestPoint(const Vec3d& x) const { return ringPoint(x) + minor_ * normalAt(x); }

  private:
    double major_;
    double minor_;
};

/// The octants of a sphere as triangles between its own corners.
inline surface::Cage octahedron(const surface::Sphere& sphere) {
    surface::Cage cage;
    const surface::Region whole = surface::wholePatch(surface::PatchDomain::triangle);
    for (std::uint32_t patch = 0; patch < 8; ++patch) {
        std::array<std::uint32_t, 4> face{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3d corner = sphere.evaluate(patch, whole.corners[k]).position;
            const auto known = std::find_if(cage.vertices.begin(), cage.vertices.end(),
                                            [&](const Vec3d& v) { return glm::distance(v, corner) < 1e-9; });
            face[k] = static_cast<std::uint32_t>(known - cage.vertices.begin());
            if (known == cage.vertices.end()) {
                cage.vertices.push_back(corner);
            }
        }
        face[3] = face[2];
        cage.faces.push_back(face);
    }
    return cage;
}

/// Quads between `around` x `across` points of a torus about the y axis.
inline surface::Cage torusCage(double major, double minor, std::uint32_t around, std::uint32_t across) {
    surface::Cage cage;
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const double phi = 2.0 * kPi * i / around;
            const double theta = 2.0 * kPi * j / across;
            const double radius = major + minor * std::cos(theta);
            cage.vertices.emplace_back(radius * std::cos(phi), minor * std::sin(theta),
                                       radius * std::sin(phi));
            const auto index = [&](std::uint32_t p, std::uint32_t q) {
                return (i + p) % around * across + (j + q) % across;
            };
            cage.faces.push_back({index(0, 0), index(0, 1), index(1, 1), index(1, 0)});
        }
    }
    return cage;
}

struct ProjectedSphere {
    std::shared_ptr<const BareSphere> object = std::make_shared<BareSphere>(Vec3d(.1, .2, .3), .7);
    surface::ProjectedSurface surface{object, octahedron(object->sphere())};
};

struct ProjectedTorus {
    static constexpr double kMajor = 1.0;
    static constexpr double kMinor = 0.35;
    std::shared_ptr<const BareTorus> object = std::make_shared<BareTorus>(kMajor, kMinor);
    surface::ProjectedSurface surface{object, torusCage(kMajor, kMinor, 8, 4)};
};

/// Four balls in a bent row: necks between them, one of them hollow on one side.
struct ProjectedUnion {
    std::shared_ptr<const surface::SmoothUnion> object =
        std::make_shared<surface::SmoothUnion>(std::vector<surface::Ball>{
            {{0, 0, 0}, .5}, {{.85, .1, 0}, .4}, {{1.4, .6, .2}, .35}, {{-.3, .75, .1}, .38}});
    surface::ProjectedSurface surface{object, surface::buildDualCage(object).value()};
};

/// The three surfaces that every general property is tested on.
struct Shapes {
    ProjectedSphere sphere;
    ProjectedTorus torus;
    ProjectedUnion blobs;
    std::array<const surface::ProjectedSurface*, 3> all() const {
        return {&sphere.surface, &torus.surface, &blobs.surface};
    }
};

inline const Shapes& shapes() {
    static const Shapes made;
    return made;
}

/// Calls visit(patch, region) for all elements of one level.
template <class Visit>
void forElements(const surface::Surface& surface, unsigned level, const Visit& visit) {
    const auto descend = [&](const auto& self, std::uint32_t patch, const surface::Region& region,
                             unsigned left) -> void {
        if (left == 0) {
            visit(patch, region);
            return;
        }
        for (const surface::Region& part :
             surface::childRegions(surface, patch, region, surface::Split::quarters)) {
            self(self, patch, part, left - 1);
        }
    };
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        descend(descend, patch, surface::wholePatch(surface.domain(patch)), level);
    }
}

inline Vec2d inRegion(const surface::Region& region, base::RandomStream& random) {
    return surface::mapToRegion(region, random.next2()).uv;
}

inline surface::Region wholeOf(const surface::Surface& surface, std::uint32_t patch) {
    return surface::wholePatch(surface.domain(patch));
}

inline double areaAt(const surface::Surface& surface, unsigned level) {
    double sum = 0.0;
    forElements(surface, level, [&](auto patch, const surface::Region& r) { sum += surface.area(patch, r); });
    return sum;
}

}  // namespace fluxwalk::test
