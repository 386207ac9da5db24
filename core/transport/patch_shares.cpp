#include "core/transport/patch_shares.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/simd.h"

namespace fluxwalk::transport {

namespace {

// Written without branches, so that the compiler takes several patches at once; the same operations on any
// instruction set, so the same bits.
FLUXWALK_INLINE float shareOf(float dx, float dy, float dz, float nx, float ny, float nz, float spread,
                              float radius, float mostPerArea) {
    const float perDistance = 1.0f / std::sqrt(std::max(dx * dx + dy * dy + dz * dz, 1e-30f));
    const float cosine = (nx * dx + ny * dy + nz * dz) * perDistance;
    const float s = std::max(std::min(1.0f, radius * perDistance + spread), 1e-6f);
    const float t = std::max(0.0f, 0.5f * (cosine + s) / s);
    const float s2 = s * s;
    const float s4 = s2 * s2;
    const float touching = s4 * s4 * s4 * s4;
    const float cut = s * t * (t + touching * (1.0f - t));
    const float lit = cosine < s ? cut : cosine;
    return lit * std::min(perDistance * perDistance, mostPerArea);
}

FLUXWALK_INLINE void fill(const hierarchy::PatchTable& p, std::size_t begin, const Ball& ball, float* out,
                          std::size_t count) {
    const float* cx = p.center[0].data() + begin;
    const float* cy = p.center[1].data() + begin;
    const float* cz = p.center[2].data() + begin;
    const float* nx = p.axis[0].data() + begin;
    const float* ny = p.axis[1].data() + begin;
    const float* nz = p.axis[2].data() + begin;
    const float* spread = p.spread.data() + begin;
    const float x = ball.center.x;
    const float y = ball.center.y;
    const float z = ball.center.z;
    const float radius = ball.radius;
    // At its surface and inside.
    const float mostPerArea = 1.0f / std::max(radius * radius, 1e-30f);
    for (std::size_t i = 0; i < count; ++i) {
        out[i] =
            shareOf(x - cx[i], y - cy[i], z - cz[i], nx[i], ny[i], nz[i], spread[i], radius, mostPerArea);
    }
}

[[gnu::target("avx2")]] void fillAvx2(const hierarchy::PatchTable& p, std::size_t begin, const Ball& ball,
                                      float* out, std::size_t count) {
    fill(p, begin, ball, out, count);
}

void fillBaseline(const hierarchy::PatchTable& p, std::size_t begin, const Ball& ball, float* out,
                  std::size_t count) {
    fill(p, begin, ball, out, count);
}

constexpr std::size_t kWidth = 8;

// Sums in lanes, so that their order is the same on any instruction set.
FLUXWALK_INLINE base::Vec3d sumRuns(const hierarchy::PatchTable& p, std::size_t begin, std::size_t end,
                                    const Ball& ball, const PatchValues& values) {
    std::array<float, kPatchRun> weights;
    base::Vec3d sum(0.0);
    for (std::size_t i = begin; i < end; i += kPatchRun) {
        const std::size_t count = std::min(kPatchRun, end - i);
        fill(p, i, ball, weights.data(), count);
        const float* area = p.area.data() + i;
        for (std::size_t k = 0; k < count; ++k) {
            weights[k] *= area[k];
        }
        const std::size_t whole = count - count % kWidth;
        for (std::size_t c = 0; c < 3; ++c) {
            const float* value = values[c].data() + i;
            std::array<float, kWidth> lanes{};
            for (std::size_t k = 0; k < whole; k += kWidth) {
                for (std::size_t lane = 0; lane < kWidth; ++lane) {
                    lanes[lane] += weights[k + lane] * value[k + lane];
                }
            }
            for (std::size_t k = whole; k < count; ++k) {
                lanes[k - whole] += weights[k] * value[k];
            }
            sum[static_cast<int>(c)] += static_cast<double>(((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) +
                                                            ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7])));
        }
    }
    return sum;
}

[[gnu::target("avx2")]] base::Vec3d sumRunsAvx2(const hierarchy::PatchTable& p, std::size_t begin,
                                                std::size_t end, const Ball& ball,
                                                const PatchValues& values) {
    return sumRuns(p, begin, end, ball, values);
}

base::Vec3d sumRunsBaseline(const hierarchy::PatchTable& p, std::size_t begin, std::size_t end,
                            const Ball& ball, const PatchValues& values) {
    return sumRuns(p, begin, end, ball, values);
}

FLUXWALK_INLINE void addRun(const hierarchy::PatchTable& p, std::size_t begin, std::size_t count,
                            const Ball& ball, const base::Rgb& flux, const base::Rgb& most, RunSums& sums,
                            std::size_t place) {
    std::array<float, kPatchRun> shares;
    fill(p, begin, ball, shares.data(), count);
    for (std::size_t c = 0; c < 3; ++c) {
        float* sum = sums[c].data() + place;
        const float f = flux[static_cast<int>(c)];
        const float m = most[static_cast<int>(c)];
        for (std::size_t k = 0; k < count; ++k) {
            sum[k] += std::min(shares[k] * f, m);
        }
    }
}

[[gnu::target("avx2")]] void addRunAvx2(const hierarchy::PatchTable& p, std::size_t begin, std::size_t count,
                                        const Ball& ball, const base::Rgb& flux, const base::Rgb& most,
                                        RunSums& sums, std::size_t place) {
    addRun(p, begin, count, ball, flux, most, sums, place);
}

void addRunBaseline(const hierarchy::PatchTable& p, std::size_t begin, std::size_t count, const Ball& ball,
                    const base::Rgb& flux, const base::Rgb& most, RunSums& sums, std::size_t place) {
    addRun(p, begin, count, ball, flux, most, sums, place);
}

bool hasAvx2() {
    static const bool kHas = __builtin_cpu_supports("avx2") != 0;
    return kHas;
}

}  // namespace

void computeShares(const hierarchy::PatchTable& patches, std::size_t begin, const Ball& ball,
                   std::span<float> shares) {
    (hasAvx2() ? fillAvx2 : fillBaseline)(patches, begin, ball, shares.data(), shares.size());
}

float computeShare(const hierarchy::PatchTable& patches, std::size_t patch, const Ball& ball) {
    float share = 0.0f;
    fill(patches, patch, ball, &share, 1);
    return share;
}

base::Vec3d sumShared(const hierarchy::PatchTable& patches, std::size_t begin, std::size_t end,
                      const Ball& ball, const PatchValues& values) {
    return (hasAvx2() ? sumRunsAvx2 : sumRunsBaseline)(patches, begin, end, ball, values);
}

void addShared(const hierarchy::PatchTable& patches, std::size_t begin, std::size_t count, const Ball& ball,
               const base::Rgb& flux, const base::Rgb& most, RunSums& sums, std::size_t place) {
    (hasAvx2() ? addRunAvx2 : addRunBaseline)(patches, begin, count, ball, flux, most, sums, place);
}

float sumShares(const hierarchy::PatchTable& patches, std::size_t begin, std::size_t end, const Ball& ball) {
    std::array<float, 64> shares;
    double sum = 0.0;
    for (std::size_t i = begin; i < end; i += shares.size()) {
        const std::size_t count = std::min(shares.size(), end - i);
        computeShares(patches, i, ball, std::span(shares.data(), count));
        for (std::size_t k = 0; k < count; ++k) {
            sum += static_cast<double>(patches.area[i + k] * shares[k]);
        }
    }
    return static_cast<float>(sum);
}

}  // namespace fluxwalk::transport
