#pragma once

#include <string>
#include <vector>

#include "core/surface/polygon_mesh.h"
#include "tests/support/built.h"
#include "tests/support/random_scenes.h"

/// Random pairs of polygons in the positions that matter to form factors.
namespace fluxwalk::test {

using base::Vec3d;
using Polygon = std::vector<Vec3d>;

struct PolygonPair {
    Polygon a;
    Polygon b;
};

enum class Placement { far, middle, near, sharedEdge, sharedCorner, horizon, tinyOverHuge };

inline const char* nameOf(Placement placement) {
    switch (placement) {
        case Placement::far:
            return "far";
        case Placement::middle:
            return "middle";
        case Placement::near:
            return "near";
        case Placement::sharedEdge:
            return "shared edge";
        case Placement::sharedCorner:
            return "shared corner";
        case Placement::horizon:
            return "horizon";
        case Placement::tinyOverHuge:
            return "tiny over huge";
    }
    return "";
}

/// Convex polygon about the origin in z = 0, counter-clockwise, corners near the unit circle: a triangle or a
/// quad.
inline Polygon randomPolygon(base::RandomStream& random) {
    const unsigned count = random.next() < 0.4 ? 3 : 4;
    const double turn = 2.0 * base::kPi * random.next();
    Polygon polygon;
    for (unsigned i = 0; i < count; ++i) {
        const double angle = turn + 2.0 * base::kPi * (i + 0.5 * random.next()) / count;
        polygon.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    return polygon;
}

/// The polygon turned from +z to `normal`, scaled and moved.
inline Polygon place(Polygon polygon, const Vec3d& normal, double scale, const Vec3d& at) {
    const Vec3d helper = std::abs(normal.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d s = glm::normalize(glm::cross(helper, normal));
    const Vec3d t = glm::cross(normal, s);
    for (Vec3d& p : polygon) {
        p = at + scale * (p.x * s + p.y * t);
    }
    return polygon;
}

// A direction that leans from `axis` by at most `most` radians.
inline Vec3d leaning(const Vec3d& axis, double most, base::RandomStream& random) {
    const Vec3d side = glm::normalize(glm::cross(axis, randomDirection(random)));
    const double angle = most * random.next();
    return std::cos(angle) * axis + std::sin(angle) * side;
}

inline PolygonPair randomPair(Placement placement, base::RandomStream& random) {
    const Vec3d up(0, 0, 1);
    PolygonPair pair;
    pair.a = randomPolygon(random);
    const Polygon shape = randomPolygon(random);
    const double size = std::exp2(2.0 * random.next() - 1.0);
    switch (placement) {
        case Placement::far:
        case Placement::middle: {
            const double gap =
                (1.0 + size) * (placement == Placement::far ? 4.5 + 15.0 * random.next() : 1.2 + 2.6 * random.next());
            const Vec3d d = leaning(up, 1.2, random);
            pair.b = place(shape, leaning(-d, 1.0, random), size, gap * d);
            break;
        }
        case Placement::near:
            // Over each other, tilted little enough not to touch.
            pair.b = place(shape, leaning(-up, 0.2, random), size,
                           Vec3d(random.next() - 0.5, random.next() - 0.5, 0.25 * size + 0.1 + 0.4 * random.next()));
            break;
        case Placement::sharedEdge: {
            // The edge of a turned up by 20 to 160 degrees about itself.
            const Vec3d p = pair.a[0];
            const Vec3d q = pair.a[1];
            const Vec3d along = glm::normalize(q - p);
            const Vec3d outwards = glm::cross(along, up);
            const double angle = base::kPi * (20.0 + 140.0 * random.next()) / 180.0;
            const Vec3d slope = -std::cos(angle) * outwards + std::sin(angle) * up;
            const double height = size * (0.3 + random.next());
            if (random.next() < 0.5) {
                pair.b = {p, p + height * slope, q + height * slope, q};
            } else {
                pair.b = {p, 0.5 * (p + q) + height * slope, q};
            }
            break;
        }
        case Placement::sharedCorner: {
            const Vec3d p = pair.a[0];
            const Vec3d inwards = glm::normalize(-p);
            const Vec3d axis = leaning(glm::normalize(up + 0.3 * inwards), 0.7, random);
            const Vec3d side = glm::normalize(glm::cross(axis, randomDirection(random)));
            const Vec3d end1 = p + size * glm::normalize(axis + 0.5 * side);
            const Vec3d end2 = p + size * glm::normalize(axis - 0.5 * side);
            pair.b = {p, end1, end2};
            // Its front sees the middle of a.
            if (glm::dot(glm::cross(end1 - p, end2 - p), -p) < 0.0) {
                std::swap(pair.b[1], pair.b[2]);
            }
            break;
        }
        case Placement::horizon: {
            const double angle = 2.0 * base::kPi * random.next();
            const Vec3d d(std::cos(angle), std::sin(angle), 0.0);
            pair.b = place(shape, leaning(-d, 0.6, random), size,
                           (1.1 + size + 2.0 * random.next()) * d + (random.next() - 0.5) * size * up);
            break;
        }
        case Placement::tinyOverHuge: {
            const double tiny = 0.003 + 0.02 * random.next();
            const Vec3d at(random.next() - 0.5, random.next() - 0.5, tiny + 0.5 * random.next() * random.next());
            pair.b = place(shape, leaning(-up, 1.3, random), tiny, at);
            break;
        }
    }
    return pair;
}

/// Each polygon is an object of one patch that glows on both sides: object i is polygon i.
inline scene::Scene sceneOf(const std::vector<Polygon>& polygons) {
    scene::Scene scene;
    scene::addMaterial(scene, "glow", base::Rgb(0.5f), base::Rgb(1.0f));
    scene.materials[0].doubleSided = true;
    for (const Polygon& polygon : polygons) {
        surface::TriangleSoup soup;
        for (const Vec3d& p : polygon) {
            soup.positions.emplace_back(p);
        }
        soup.triangles.push_back({0, 1, 2});
        if (polygon.size() == 4) {
            soup.triangles.push_back({0, 2, 3});
        }
        scene.objects.push_back({"polygon", std::make_shared<surface::PolygonMesh>(std::move(soup)), 0});
    }
    return scene;
}

/// Corners of a planar element.
inline Polygon cornersOf(const hierarchy::Shape& shape) {
    Polygon polygon;
    for (std::uint32_t i = 0; i < shape.cornerCount; ++i) {
        polygon.emplace_back(shape.corners[i]);
    }
    return polygon;
}

}  // namespace fluxwalk::test
