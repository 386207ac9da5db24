#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/base/vec.h"
#include "core/hierarchy/patch_table.h"

/// How a cluster shares among its patches what one link carries.
namespace fluxwalk::transport {

/// A node as a cluster sees it.
struct Ball {
    base::Vec3 center{};
    float radius = 0.0f;
};

/// Share of patches [begin, begin + shares.size()), in 1/m2: the part of a ball's light that each would
/// receive, over the squared distance. The cosine where all of the ball is above the patch's horizon; where
/// it is cut, fitted to the exact factor of a ball, which tends to (cos + s)^2 / (4 s) for small and is (1 +
/// cos) / 2 for touching ones, s being the sine of the angle that the ball and the patch's own cone of
/// normals take up. Inside the ball as on its surface.
void computeShares(const hierarchy::PatchTable& patches, std::size_t begin, const Ball& ball,
                   std::span<float> shares);
/// That of one patch.
float computeShare(const hierarchy::PatchTable& patches, std::size_t patch, const Ball& ball);

/// Sum of the shares of patches [begin, end), times their exposed areas.
float sumShares(const hierarchy::PatchTable& patches, std::size_t begin, std::size_t end, const Ball& ball);

/// Values of all patches in three channels, each in the order of the table.
using PatchValues = std::array<std::span<const float>, 3>;
/// Sum of `values` of patches [begin, end), times their shares and exposed areas.
base::Vec3d sumShared(const hierarchy::PatchTable& patches, std::size_t begin, std::size_t end,
                      const Ball& ball, const PatchValues& values);

/// Patches that are taken at once.
inline constexpr std::size_t kPatchRun = 64;
/// Sums for a run of patches, by channel.
using RunSums = std::array<std::array<float, kPatchRun>, 3>;
/// Adds `flux` times their shares, but `most` at most, to the sums of `count` patches from `begin` on, which
/// stand from `place` on.
void addShared(const hierarchy::PatchTable& patches, std::size_t begin, std::size_t count, const Ball& ball,
               const base::Rgb& flux, const base::Rgb& most, RunSums& sums, std::size_t place);

}  // namespace fluxwalk::transport
