#pragma once

#include <array>
#include <span>
#include <string_view>

#include "core/scene/polygons.h"
#include "core/scene/shapes.h"
#include "core/surface/polygon_mesh.h"

/// Closed solids from which the built-in scene `building` is made.
namespace fluxwalk::scene::building {

using base::Vec2d;

/// A turn about the vertical, then a shift. Quarter turns are exact, so that parts that touch in their own
/// coordinates touch bit for bit in the building.
struct Placement {
    Vec3d origin{0.0};
    double cosine = 1.0;
    double sine = 0.0;

    Vec3d at(const Vec3d& p) const {
        return origin + Vec3d(cosine * p.x + sine * p.z, p.y, cosine * p.z - sine * p.x);
    }
    /// A placement inside this one: at `place`, turned counter-clockwise as seen from above.
    Placement moved(const Vec3d& place, double degrees = 0.0) const;
};

/// Collects closed solids into one mesh at a time and adds exact shapes. Coordinates are those of the present
/// placement.
class SolidMaker {
  public:
    /// Without a scene it only counts patches.
    explicit SolidMaker(Scene* scene) : scene_(scene) {}

    void setPlacement(const Placement& placement) { placement_ = placement; }

    void addBox(const Vec3d& lower, const Vec3d& upper);
    /// Six planar faces between two quads of corners: the lower ones counter-clockwise as seen from above,
    /// the upper ones above them.
    void addHexahedron(const std::array<Vec3d, 8>& corners);
    /// Upright prism over a convex plan of (x, z), in either order.
    void addPrism(std::span<const Vec2d> plan, double bottom, double top);
    /// Box of which one horizontal face is cut into a grid at the given lines, the other faces accordingly.
    void addGridSlab(std::span<const double> xs, std::span<const double> zs, double bottom, double top);
    /// Box whose bottom (or top) has a face of its own over the inner rectangle and four around it.
    void addFramedSlab(const std::array<double, 4>& outer, const std::array<double, 4>& inner, double bottom,
                       double top, bool isFramedBelow);
    /// Turned solid about the vertical through `foot`: rings from below upwards outside, and down again
    /// inside of a vessel. The first and last ring are closed by flat faces.
    void addTurned(const Vec3d& foot, std::span<const LatheRing> rings, unsigned segments);
    /// Rounded cushion that fills a box; `rings` of it above each other, four times as many around.
    void addCushion(const Vec3d& lower, const Vec3d& upper, unsigned rings);
    /// Upright band of even thickness along points of (x, z), ordered by x; the thickness goes towards -z.
    void addBand(std::span<const Vec2d> line, double thickness, double bottom, double top);

    /// Corners counter-clockwise seen from the front.
    void addQuad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);
    void addTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c);

    /// Makes one object of all solids since the last call, if any.
    void finish(std::string_view name, std::uint32_t material);

    void placeSphere(std::string_view name, std::uint32_t material, const Vec3d& center, double radius);
    void placeCylinder(std::string_view name, std::uint32_t material, const Vec3d& foot, double radius,
                       double height);
    void placeCone(std::string_view name, std::uint32_t material, const Vec3d& foot, double radiusBottom,
                   double radiusTop, double height);
    void placeTorus(std::string_view name, std::uint32_t material, const Vec3d& center, double majorRadius,
                    double minorRadius);

    /// Patches of everything so far.
    std::size_t patchCount() const { return patchCount_; }

  private:
    // Of a body turned or rounded: rounding to float may bend it into two triangles.
    void addSloping(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);
    // Horizontal convex cap over points of one height, counter-clockwise as seen from above.
    void addCap(std::span<const Vec3d> rim, bool isTop);
    std::uint32_t addCorners(std::initializer_list<Vec3d> corners);

    Scene* scene_;
    Placement placement_;
    surface::TriangleSoup soup_;
    std::size_t patchCount_ = 0;
    std::vector<Vec3d> lowerRim_;
    std::vector<Vec3d> upperRim_;
};

}  // namespace fluxwalk::scene::building
