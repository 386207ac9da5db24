#include "core/reference/full_matrix.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "core/base/check.h"
#include "core/base/random.h"

namespace fluxwalk::reference {

namespace {

using base::Vec2d;

std::vector<surface::Path> pathsOfLevel(unsigned level) {
    std::vector<surface::Path> paths{surface::kRootPath};
    for (unsigned i = 0; i < level; ++i) {
        std::vector<surface::Path> finer;
        for (const surface::Path path : paths) {
            for (unsigned child = 0; child < 4; ++child) {
                finer.push_back(surface::childPath(path, child));
            }
        }
        paths = std::move(finer);
    }
    return paths;
}

double sumOf(const Vec3d& v) {
    return v.x + v.y + v.z;
}

std::uint64_t keyOf(const MatrixElement& element) {
    const std::uint64_t key = base::combine(element.object, element.patch);
    return base::combine(base::combine(key, element.path), element.back ? 1 : 0);
}

/// Point of an element for (s,t) in the unit square, and its share of the area, for area-true sampling.
struct ElementPoint {
    Vec3d position{};
    double measure = 0.0;
};

ElementPoint pointOf(const scene::Scene& scene, const MatrixElement& element, const Vec2d& st) {
    const surface::RegionPoint at = mapToRegion(element.region, st);
    const surface::SurfacePoint point = scene.objects[element.object].surface->evaluate(element.patch, at.uv);
    return {point.position, at.jacobian * point.jacobian};
}

Vec3d lightAt(const scene::Scene& scene, const rays::RayScene& rays, const Vec3d& position,
              const Vec3d& normal) {
    Vec3d sum(0.0);
    for (const scene::Light& light : scene.lights) {
        if (light.kind == scene::LightKind::directional) {
            const double cosine = -glm::dot(normal, light.direction);
            if (cosine > 0.0 && !rays.isOccluded(rays.halfLine(position, normal, -light.direction))) {
                sum += cosine * Vec3d(light.intensity);
            }
            continue;
        }
        const Vec3d between = light.position - position;
        const double distance = glm::length(between);
        const double cosine = glm::dot(normal, between) / distance;
        if (cosine > 0.0 && (light.range <= 0.0 || distance <= light.range) &&
            !rays.isOccluded(rays.segment(position, normal, light.position, Vec3d(0.0)))) {
            sum +=
                Vec3d(scene::intensityToward(light, -between / distance)) * (cosine / (distance * distance));
        }
    }
    return sum;
}

// Mean over the element by the 4 x 4 Gauss rule.
Vec3d meanLight(const scene::Scene& scene, const rays::RayScene& rays, const MatrixElement& element) {
    constexpr std::array<double, 4> kNodes{0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                           0.93056815579702629};
    constexpr std::array<double, 4> kWeights{0.17392742256872692, 0.32607257743127308, 0.32607257743127308,
                                             0.17392742256872692};
    Vec3d sum(0.0);
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            const ElementPoint point = pointOf(scene, element, {kNodes[i], kNodes[j]});
            sum += kWeights[i] * kWeights[j] * point.measure *
                   lightAt(scene, rays, point.position, element.normal);
        }
    }
    return sum / element.area;
}

// Share of rays between two elements that arrive: n x n strata on each side, matched by a random permutation.
double visibility(const scene::Scene& scene, const rays::RayScene& rays, const MatrixElement& a,
                  const MatrixElement& b, const FullMatrixOptions& options) {
    const auto strata =
        static_cast<unsigned>(std::lround(std::sqrt(static_cast<double>(options.visibilityRays))));
    base::RandomStream random(base::combine(base::combine(options.seed, keyOf(a)), keyOf(b)));
    std::vector<unsigned> order(static_cast<std::size_t>(strata) * strata);
    for (unsigned i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    for (std::size_t i = order.size() - 1; i > 0; --i) {
        std::swap(order[i], order[static_cast<std::size_t>(random.next() * static_cast<double>(i + 1))]);
    }
    const auto stratum = [&](unsigned index) {
        return (Vec2d(index % strata, index / strata) + random.next2()) / static_cast<double>(strata);
    };
    double total = 0.0;
    double seen = 0.0;
    for (unsigned i = 0; i < order.size(); ++i) {
        const ElementPoint p = pointOf(scene, a, stratum(i));
        const ElementPoint q = pointOf(scene, b, stratum(order[i]));
        const Vec3d between = q.position - p.position;
        const double cosines = glm::dot(a.normal, between) * -glm::dot(b.normal, between);
        if (glm::dot(a.normal, between) <= 0.0 || cosines <= 0.0) {
            continue;
        }
        const double distance2 = glm::dot(between, between);
        const double weight = p.measure * q.measure * cosines / (distance2 * distance2);
        total += weight;
        if (!rays.isOccluded(rays.segment(p.position, a.normal, q.position, b.normal))) {
            seen += weight;
        }
    }
    return total > 0.0 ? seen / total : 1.0;
}

}  // namespace

FullMatrix::FullMatrix(const scene::Scene& scene, const rays::RayScene& rays, const base::Executor& executor,
                       std::span<const ObjectSide> sides, const PolygonCoupling& coupling,
                       const FullMatrixOptions& options) {
    const std::vector<surface::Path> paths = pathsOfLevel(options.level);
    for (const ObjectSide& side : sides) {
        const scene::Object& object = scene.objects[side.object];
        const scene::Material& material = scene.materials[object.material];
        FLUXWALK_CHECK(!material.reflectanceTexture.isSet() && !material.emissionTexture.isSet());
        for (std::uint32_t patch = 0; patch < object.surface->patchCount(); ++patch) {
            FLUXWALK_CHECK(object.surface->isPlanar(patch));
            for (const surface::Path path : paths) {
                MatrixElement element;
                element.object = side.object;
                element.patch = patch;
                element.path = path;
                element.back = side.back;
                element.region = surface::regionOf(*object.surface, patch, path);
                for (std::uint32_t i = 0; i < element.region.cornerCount; ++i) {
                    element.corners.push_back(
                        object.surface->evaluate(patch, element.region.corners[i]).position);
                }
                element.normal = object.surface->evaluate(patch, element.region.corners[0]).normal;
                if (side.back) {
                    std::reverse(element.corners.begin(), element.corners.end());
                    element.normal = -element.normal;
                }
                element.area = object.surface->area(patch, element.region);
                element.reflectance = Vec3d(material.reflectance);
                element.emission = side.back && !material.doubleSided ? Vec3d(0.0) : Vec3d(material.emission);
                element.lightIrradiance = meanLight(scene, rays, element);
                elements_.push_back(std::move(element));
            }
        }
    }
    const std::size_t n = elements_.size();
    couplings_.assign(n * n, 0.0);
    executor.forRange(n, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t j = i + 1; j < n; ++j) {
                double g = coupling(elements_[i].corners, elements_[j].corners);
                if (g > 0.0 && options.visibilityRays > 0) {
                    g *= visibility(scene, rays, elements_[i], elements_[j], options);
                }
                couplings_[i * n + j] = g;
                couplings_[j * n + i] = g;
            }
        }
    });
}

MatrixSolution FullMatrix::solve(SweepKind kind, double tolerance, unsigned maxSweeps) const {
    const std::size_t n = elements_.size();
    MatrixSolution solution;
    solution.radiosity.assign(n, Vec3d(0.0));
    solution.irradiance.assign(n, Vec3d(0.0));
    double emitted = 0.0;
    for (const MatrixElement& element : elements_) {
        emitted += element.area * sumOf(element.emission + element.reflectance * element.lightIrradiance);
    }
    std::vector<Vec3d> previous;
    while (true) {
        previous = solution.radiosity;
        const std::vector<Vec3d>& read = kind == SweepKind::jacobi ? previous : solution.radiosity;
        double change = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            const MatrixElement& element = elements_[i];
            Vec3d gathered(0.0);
            for (std::size_t j = 0; j < n; ++j) {
                gathered += couplings_[i * n + j] * read[j];
            }
            solution.irradiance[i] = gathered / element.area + element.lightIrradiance;
            solution.radiosity[i] = element.emission + element.reflectance * solution.irradiance[i];
            change += element.area * sumOf(glm::abs(solution.radiosity[i] - previous[i]));
        }
        ++solution.sweeps;
        if (change <= tolerance * emitted || solution.sweeps == maxSweeps) {
            return solution;
        }
    }
}

}  // namespace fluxwalk::reference
