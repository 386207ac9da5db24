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
                              float radius) {
    const float r2 = std::max(dx * dx + dy * dy + dz * dz, 1e-30f);
    const float r = std::sqrt(r2);
    const float cosine = (nx * dx + ny * dy + nz * dz) / r;
    const float s = std::max(std::min(1.0f, radius / r + spread), 1e-6f);
    const float t = std::max(0.0f, 0.5f * (cosine + s) / s);
    const float s2 = s * s;
    const float s4 = s2 * s2;
    const float touching = s4 * s4 * s4 * s4;
    const float cut = s * t * (t + touching * (1.0f - t));
    const float lit = cosine < s ? cut : cosine;
    const float away = std::max(r, radius);
    return lit / (away * away);
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
    for (std::size_t i = 0; i < count; ++i) {
        out[i] = shareOf(x - cx[i], y - cy[i], z - cz[i], nx[i], ny[i], nz[i], spread[i], radius);
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

}  // namespace

void computeShares(const hierarchy::PatchTable& patches, std::size_t begin, const Ball& ball,
                   std::span<float> shares) {
    static const bool kHasAvx2 = __builtin_cpu_supports("avx2") != 0;
    (kHasAvx2 ? fillAvx2 : fillBaseline)(patches, begin, ball, shares.data(), shares.size());
}

float computeShare(const hierarchy::PatchTable& patches, std::size_t patch, const Ball& ball) {
    float share = 0.0f;
    fill(patches, patch, ball, &share, 1);
    return share;
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
