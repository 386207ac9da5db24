#include "core/scene/building_solids.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/check.h"
#include "core/base/photometry.h"

namespace fluxwalk::scene::building {

namespace {

/// Patches of the exact shapes, which a count needs without making them.
constexpr std::size_t kSpherePatches = 8;
constexpr std::size_t kRevolvedPatches = 4;
constexpr std::size_t kTorusPatches = 16;

}  // namespace

Placement Placement::moved(const Vec3d& place, double degrees) const {
    const double quarters = degrees / 90.0;
    double c = std::cos(degrees * base::kPi / 180.0);
    double s = std::sin(degrees * base::kPi / 180.0);
    if (quarters == std::round(quarters)) {
        c = std::round(c);
        s = std::round(s);
    }
    return {at(place), cosine * c - sine * s, sine * c + cosine * s};
}

std::uint32_t SolidMaker::addCorners(std::initializer_list<Vec3d> corners) {
    const auto first = static_cast<std::uint32_t>(soup_.positions.size());
    for (const Vec3d& corner : corners) {
        soup_.positions.emplace_back(placement_.at(corner));
    }
    return first;
}

void SolidMaker::addQuad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    ++patchCount_;
    if (scene_ != nullptr) {
        const std::uint32_t i = addCorners({a, b, c, d});
        soup_.triangles.push_back({i, i + 1, i + 2});
        soup_.triangles.push_back({i, i + 2, i + 3});
    }
}

void SolidMaker::addSloping(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const auto rounded = [this](const Vec3d& p) { return Vec3d(base::Vec3(placement_.at(p))); };
    patchCount_ += surface::isCoplanar(rounded(a), rounded(b), rounded(c), rounded(d)) ? 0u : 1u;
    addQuad(a, b, c, d);
}

void SolidMaker::addTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    ++patchCount_;
    if (scene_ != nullptr) {
        const std::uint32_t i = addCorners({a, b, c});
        soup_.triangles.push_back({i, i + 1, i + 2});
    }
}

void SolidMaker::addHexahedron(const std::array<Vec3d, 8>& c) {
    addQuad(c[3], c[2], c[1], c[0]);
    addQuad(c[4], c[5], c[6], c[7]);
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        addQuad(c[i], c[next], c[4 + next], c[4 + i]);
    }
}

void SolidMaker::addBox(const Vec3d& a, const Vec3d& b) {
    addHexahedron({Vec3d{a.x, a.y, b.z},
                   {b.x, a.y, b.z},
                   {b.x, a.y, a.z},
                   {a.x, a.y, a.z},
                   {a.x, b.y, b.z},
                   {b.x, b.y, b.z},
                   {b.x, b.y, a.z},
                   {a.x, b.y, a.z}});
}

void SolidMaker::addCap(std::span<const Vec3d> rim, bool isTop) {
    // Strips between the two halves of the rim.
    const std::size_t last = rim.size() - 1;
    for (std::size_t i = 0; i < last - i - 1; ++i) {
        const Vec3d& a = rim[i];
        const Vec3d& b = rim[i + 1];
        const Vec3d& c = rim[last - i - 1];
        const Vec3d& d = rim[last - i];
        if (i + 1 == last - i - 1) {
            isTop ? addTriangle(a, b, d) : addTriangle(d, b, a);
        } else {
            isTop ? addQuad(a, b, c, d) : addQuad(d, c, b, a);
        }
    }
}

void SolidMaker::addPrism(std::span<const Vec2d> plan, double bottom, double top) {
    FLUXWALK_CHECK_LT(std::size_t{2}, plan.size());
    double doubled = 0.0;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const Vec2d& p = plan[i];
        const Vec2d& q = plan[(i + 1) % plan.size()];
        doubled += p.y * q.x - p.x * q.y;
    }
    lowerRim_.clear();
    upperRim_.clear();
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const Vec2d& p = doubled > 0.0 ? plan[i] : plan[plan.size() - 1 - i];
        lowerRim_.emplace_back(p.x, bottom, p.y);
        upperRim_.emplace_back(p.x, top, p.y);
    }
    addCap(lowerRim_, false);
    addCap(upperRim_, true);
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const std::size_t next = (i + 1) % plan.size();
        addQuad(lowerRim_[i], lowerRim_[next], upperRim_[next], upperRim_[i]);
    }
}

void SolidMaker::addGridSlab(std::span<const double> xs, std::span<const double> zs, double bottom,
                             double top) {
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        const double x0 = xs[i];
        const double x1 = xs[i + 1];
        for (std::size_t j = 0; j + 1 < zs.size(); ++j) {
            const double z0 = zs[j];
            const double z1 = zs[j + 1];
            addQuad({x0, top, z1}, {x1, top, z1}, {x1, top, z0}, {x0, top, z0});
            addQuad({x0, bottom, z0}, {x1, bottom, z0}, {x1, bottom, z1}, {x0, bottom, z1});
        }
        const double near = zs.front();
        const double far = zs.back();
        addQuad({x1, bottom, near}, {x0, bottom, near}, {x0, top, near}, {x1, top, near});
        addQuad({x0, bottom, far}, {x1, bottom, far}, {x1, top, far}, {x0, top, far});
    }
    for (std::size_t j = 0; j + 1 < zs.size(); ++j) {
        const double left = xs.front();
        const double right = xs.back();
        addQuad({left, bottom, zs[j]}, {left, bottom, zs[j + 1]}, {left, top, zs[j + 1]}, {left, top, zs[j]});
        addQuad({right, bottom, zs[j + 1]}, {right, bottom, zs[j]}, {right, top, zs[j]},
                {right, top, zs[j + 1]});
    }
}

void SolidMaker::addFramedSlab(const std::array<double, 4>& outer, const std::array<double, 4>& inner,
                               double bottom, double top, bool isFramedBelow) {
    // Counter-clockwise as seen from above; rectangles are (x0, z0, x1, z1).
    const auto corners = [](const std::array<double, 4>& r, double y) {
        return std::array<Vec3d, 4>{Vec3d{r[0], y, r[3]}, {r[2], y, r[3]}, {r[2], y, r[1]}, {r[0], y, r[1]}};
    };
    const auto low = corners(outer, bottom);
    const auto high = corners(outer, top);
    const auto within = corners(inner, isFramedBelow ? bottom : top);
    if (isFramedBelow) {
        addQuad(high[0], high[1], high[2], high[3]);
        addQuad(within[3], within[2], within[1], within[0]);
    } else {
        addQuad(low[3], low[2], low[1], low[0]);
        addQuad(within[0], within[1], within[2], within[3]);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        addQuad(low[i], low[next], high[next], high[i]);
        if (isFramedBelow) {
            addQuad(low[next], low[i], within[i], within[next]);
        } else {
            addQuad(high[i], high[next], within[next], within[i]);
        }
    }
}

void SolidMaker::addTurned(const Vec3d& foot, std::span<const LatheRing> rings, unsigned segments) {
    FLUXWALK_CHECK_LT(2u, segments);
    const double step = 2.0 * base::kPi / segments;
    const auto fill = [&](std::vector<Vec3d>& rim, const LatheRing& ring) {
        rim.clear();
        for (unsigned i = 0; i < segments; ++i) {
            rim.push_back(foot + Vec3d(ring.radius * std::cos(i * step), ring.height,
                                       -ring.radius * std::sin(i * step)));
        }
    };
    fill(lowerRim_, rings.front());
    addCap(lowerRim_, false);
    for (std::size_t j = 1; j < rings.size(); ++j) {
        fill(upperRim_, rings[j]);
        const bool isSloping =
            rings[j].radius != rings[j - 1].radius && rings[j].height != rings[j - 1].height;
        for (unsigned i = 0; i < segments; ++i) {
            const unsigned next = (i + 1) % segments;
            if (isSloping) {
                addSloping(lowerRim_[i], lowerRim_[next], upperRim_[next], upperRim_[i]);
            } else {
                addQuad(lowerRim_[i], lowerRim_[next], upperRim_[next], upperRim_[i]);
            }
        }
        std::swap(lowerRim_, upperRim_);
    }
    addCap(lowerRim_, true);
}

void SolidMaker::addCushion(const Vec3d& lower, const Vec3d& upper, unsigned rings) {
    const Vec3d middle = 0.5 * (lower + upper);
    const Vec3d half = 0.5 * (upper - lower);
    const unsigned around = 4 * std::max(rings, 2u);
    // A superellipse: square corners and sides well rounded.
    const auto swell = [](double v, double power) { return std::copysign(std::pow(std::abs(v), power), v); };
    const auto fill = [&](std::vector<Vec3d>& rim, unsigned ring) {
        // The first and last ring end in flat faces of a third of the width.
        const double angle = base::kPi * ((ring + 0.5) / (rings + 1.0) - 0.5);
        const double wide = std::pow(std::cos(angle), 0.45);
        rim.clear();
        for (unsigned i = 0; i < around; ++i) {
            const double turn = 2.0 * base::kPi * i / around;
            rim.push_back(middle + half * Vec3d(wide * swell(std::cos(turn), 0.4),
                                                swell(std::sin(angle), 0.8) /
                                                    std::pow(std::cos(0.5 * base::kPi / (rings + 1.0)), 0.8),
                                                -wide * swell(std::sin(turn), 0.4)));
        }
    };
    fill(lowerRim_, 0);
    addCap(lowerRim_, false);
    for (unsigned ring = 1; ring <= rings; ++ring) {
        fill(upperRim_, ring);
        for (unsigned i = 0; i < around; ++i) {
            const unsigned next = (i + 1) % around;
            addSloping(lowerRim_[i], lowerRim_[next], upperRim_[next], upperRim_[i]);
        }
        std::swap(lowerRim_, upperRim_);
    }
    addCap(lowerRim_, true);
}

void SolidMaker::addBand(std::span<const Vec2d> line, double thickness, double bottom, double top) {
    const std::size_t last = line.size() - 1;
    const auto front = [&](std::size_t i, double y) { return Vec3d(line[i].x, y, line[i].y); };
    const auto behind = [&](std::size_t i, double y) { return Vec3d(line[i].x, y, line[i].y - thickness); };
    for (std::size_t i = 0; i < last; ++i) {
        const std::size_t j = i + 1;
        addQuad(front(i, bottom), front(j, bottom), front(j, top), front(i, top));
        addQuad(behind(j, bottom), behind(i, bottom), behind(i, top), behind(j, top));
        addQuad(front(i, top), front(j, top), behind(j, top), behind(i, top));
        addQuad(behind(i, bottom), behind(j, bottom), front(j, bottom), front(i, bottom));
    }
    addQuad(behind(0, bottom), front(0, bottom), front(0, top), behind(0, top));
    addQuad(front(last, bottom), behind(last, bottom), behind(last, top), front(last, top));
}

void SolidMaker::finish(std::string_view name, std::uint32_t material) {
    if (soup_.triangles.empty()) {
        return;
    }
    scene_->objects.push_back(
        {std::string(name), std::make_shared<surface::PolygonMesh>(std::move(soup_)), material});
    soup_ = {};
}

void SolidMaker::placeSphere(std::string_view name, std::uint32_t material, const Vec3d& center,
                             double radius) {
    patchCount_ += kSpherePatches;
    if (scene_ != nullptr) {
        addSphere(*scene_, std::string(name), material, placement_.at(center), radius);
    }
}

void SolidMaker::placeCylinder(std::string_view name, std::uint32_t material, const Vec3d& foot,
                               double radius, double height) {
    patchCount_ += kRevolvedPatches;
    if (scene_ != nullptr) {
        addCylinder(*scene_, std::string(name), material, placement_.at(foot), radius, height);
    }
}

void SolidMaker::placeCone(std::string_view name, std::uint32_t material, const Vec3d& foot,
                           double radiusBottom, double radiusTop, double height) {
    patchCount_ += kRevolvedPatches;
    if (scene_ != nullptr) {
        addCone(*scene_, std::string(name), material, placement_.at(foot), radiusBottom, radiusTop, height);
    }
}

void SolidMaker::placeTorus(std::string_view name, std::uint32_t material, const Vec3d& center,
                            double majorRadius, double minorRadius) {
    patchCount_ += kTorusPatches;
    if (scene_ != nullptr) {
        addTorus(*scene_, std::string(name), material, placement_.at(center), majorRadius, minorRadius);
    }
}

}  // namespace fluxwalk::scene::building
