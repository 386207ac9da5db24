#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/check.h"
#include "core/surface/polygon_mesh.h"

/// Flat stand-ins of curved surfaces.
namespace fluxwalk::test {

/// A surface cut uniformly into triangles with their corners on it.
class Tessellation {
  public:
    /// `perSide` segments along each side of every patch.
    Tessellation(const surface::Surface& surface, std::uint32_t perSide) : perSide_(perSide) {
        surface::TriangleSoup soup;
        for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
            const bool isTriangle = surface.domain(patch) == surface::PatchDomain::triangle;
            firstOfPatch_.push_back(static_cast<std::uint32_t>(soup.triangles.size()));
            isTriangle_.push_back(isTriangle);
            const auto first = static_cast<std::uint32_t>(soup.positions.size());
            const std::uint32_t row = perSide + 1;
            for (std::uint32_t j = 0; j <= perSide; ++j) {
                for (std::uint32_t i = 0; i <= perSide; ++i) {
                    // The upper half of a triangle's square is not used.
                    const base::Vec2d uv = base::Vec2d(i, j) / static_cast<double>(perSide);
                    const bool isUsed = !isTriangle || i + j <= perSide;
                    soup.positions.emplace_back(
                        surface.evaluate(patch, isUsed ? uv : base::Vec2d(0.0)).position);
                }
            }
            for (std::uint32_t j = 0; j < perSide; ++j) {
                for (std::uint32_t i = 0; i < perSide; ++i) {
                    const std::uint32_t a = first + j * row + i;
                    if (isTriangle) {
                        if (i + j < perSide) {
                            soup.triangles.push_back({a, a + 1, a + row});
                        }
                        if (i + j + 1 < perSide) {
                            soup.triangles.push_back({a + 1, a + row + 1, a + row});
                        }
                    } else {
                        soup.triangles.push_back({a, a + 1, a + row + 1});
                        soup.triangles.push_back({a, a + row + 1, a + row});
                    }
                }
            }
        }
        mesh_ = std::make_shared<const surface::PolygonMesh>(std::move(soup));
        // Triangles are found by their number.
        FLUXWALK_CHECK_EQ(mesh_->droppedTriangleCount(), 0u);
    }

    const std::shared_ptr<const surface::PolygonMesh>& mesh() const { return mesh_; }

    /// Where the mesh stands for the point (u,v) of a patch.
    struct Place {
        std::uint32_t patch = 0;  ///< of the mesh
        base::Vec2d uv{};
    };
    Place find(std::uint32_t patch, const base::Vec2d& uv) const {
        const auto cellOf = [this](double x) {
            return std::min(perSide_ - 1, static_cast<std::uint32_t>(std::max(0.0, x * perSide_)));
        };
        std::uint32_t i = cellOf(uv.x);
        std::uint32_t j = cellOf(uv.y);
        double x = uv.x * perSide_ - i;
        double y = uv.y * perSide_ - j;
        std::uint32_t triangle = firstOfPatch_[patch];
        base::Vec3d weights;
        if (isTriangle_[patch]) {
            if (i + j >= perSide_) {  // rounding at the long side
                (x > y ? i : j) -= 1;
                (x > y ? x : y) += 1.0;
            }
            const bool isUpper = x + y > 1.0 && i + j + 1 < perSide_;
            triangle += j * (2 * perSide_ - j) + 2 * i + (isUpper ? 1 : 0);
            weights = isUpper ? base::Vec3d(1.0 - y, x + y - 1.0, 1.0 - x) : base::Vec3d(1.0 - x - y, x, y);
        } else {
            const bool isUpper = y > x;
            triangle += 2 * (j * perSide_ + i) + (isUpper ? 1 : 0);
            weights = isUpper ? base::Vec3d(1.0 - y, x, y - x) : base::Vec3d(1.0 - x, x - y, y);
        }
        const surface::TriangleView view = mesh_->triangles();
        base::Vec3d position(0.0);
        for (int k = 0; k < 3; ++k) {
            position += weights[k] *
                        base::Vec3d(view.positions[view.triangles[triangle][static_cast<std::size_t>(k)]]);
        }
        const std::uint32_t flat = view.patches[triangle];
        return {flat, mesh_->locate(flat, position)};
    }

  private:
    std::uint32_t perSide_;
    std::vector<std::uint32_t> firstOfPatch_;
    std::vector<bool> isTriangle_;
    std::shared_ptr<const surface::PolygonMesh> mesh_;
};

}  // namespace fluxwalk::test
