#pragma once

#include <memory>
#include <vector>

#include "core/surface/surface.h"

namespace fluxwalk::test {

/// Some patches of a surface as an object of their own, so that one exact shape can carry two materials.
class PatchSubset final : public surface::Surface {
  public:
    PatchSubset(std::shared_ptr<const surface::Surface> whole, std::vector<std::uint32_t> patches)
        : whole_(std::move(whole)), patches_(std::move(patches)) {}

    std::uint32_t patchCount() const override { return static_cast<std::uint32_t>(patches_.size()); }
    surface::PatchDomain domain(std::uint32_t patch) const override {
        return whole_->domain(patches_[patch]);
    }
    surface::SurfacePoint evaluate(std::uint32_t patch, const base::Vec2d& uv) const override {
        return whole_->evaluate(patches_[patch], uv);
    }
    base::Vec2d splitPoint(std::uint32_t patch, const base::Vec2d& a, const base::Vec2d& b) const override {
        return whole_->splitPoint(patches_[patch], a, b);
    }
    base::Vec2d locate(std::uint32_t patch, const base::Vec3d& position) const override {
        return whole_->locate(patches_[patch], position);
    }
    base::Vec2d texcoord(std::uint32_t patch, const base::Vec2d& uv, unsigned set) const override {
        return whole_->texcoord(patches_[patch], uv, set);
    }
    bool isPlanar(std::uint32_t patch) const override { return whole_->isPlanar(patches_[patch]); }
    bool canSeeItself(std::uint32_t patch, bool back) const override {
        return whole_->canSeeItself(patches_[patch], back);
    }
    surface::RegionBounds bounds(std::uint32_t patch, const surface::Region& region) const override {
        return whole_->bounds(patches_[patch], region);
    }
    double area(std::uint32_t patch, const surface::Region& region) const override {
        return whole_->area(patches_[patch], region);
    }
    std::optional<double> exactKernel(bool back) const override { return whole_->exactKernel(back); }
    std::optional<surface::SurfaceHit> intersect(const base::Vec3d& origin, const base::Vec3d& direction,
                                                 double tNear, double tFar) const override {
        for (auto hit = whole_->intersect(origin, direction, tNear, tFar); hit;
             hit = whole_->intersect(origin, direction, hit->t, tFar)) {
            for (std::uint32_t i = 0; i < patches_.size(); ++i) {
                if (patches_[i] == hit->patch) {
                    hit->patch = i;
                    return hit;
                }
            }
        }
        return std::nullopt;
    }
    base::Box bounds() const override { return whole_->bounds(); }

  private:
    std::shared_ptr<const surface::Surface> whole_;
    std::vector<std::uint32_t> patches_;
};

}  // namespace fluxwalk::test
