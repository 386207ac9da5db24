#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

/// Eight doubles at once, through the compiler's vector extension: the same IEEE operations on any
/// instruction set, so the same bits. Functions are forced inline, so that they take on the instruction set
/// of the kernel that uses them.
namespace fluxwalk::base {

using Lanes = double __attribute__((vector_size(64)));
using LaneMask = std::int64_t __attribute__((vector_size(64)));
inline constexpr int kLanes = 8;
/// For structures that hold lanes: their natural alignment depends on the instruction set that a file is
/// compiled for, and kernels for wider ones load and store whole vectors in what others made.
inline constexpr std::size_t kLanesAlignment = 64;

#define FLUXWALK_INLINE [[gnu::always_inline]] inline

FLUXWALK_INLINE Lanes splat(double v) {
    return Lanes{v, v, v, v, v, v, v, v};
}
FLUXWALK_INLINE Lanes maxLanes(Lanes a, Lanes b) {
    return a > b ? a : b;
}
FLUXWALK_INLINE Lanes minLanes(Lanes a, Lanes b) {
    return a < b ? a : b;
}

FLUXWALK_INLINE Lanes sqrtLanes(Lanes v) {
    alignas(64) double t[kLanes];
    std::memcpy(t, &v, sizeof(t));
    for (double& x : t) {
        x = __builtin_sqrt(x);
    }
    std::memcpy(&v, t, sizeof(t));
    return v;
}

FLUXWALK_INLINE bool anyLane(LaneMask m) {
    std::int64_t any = 0;
    for (int i = 0; i < kLanes; ++i) {
        any |= m[i];
    }
    return any != 0;
}

/// Angle in [0, pi] of the direction (cosine, sine), sine >= 0; relative error below 1e-11, exact limit for
/// small angles; 0 for (0, 0).
FLUXWALK_INLINE Lanes angleLanes(Lanes sine, Lanes cosine) {
    const Lanes c = cosine < 0.0 ? -cosine : cosine;
    const LaneMask steep = sine > c;
    const Lanes large = maxLanes(sine, c);
    const Lanes small = minLanes(sine, c);
    const Lanes t = small / maxLanes(large, splat(1e-300));
    // atan on [0, 1]: above tan(pi/8) through atan t = pi/4 + atan((t - 1) / (t + 1)), then the series.
    const LaneMask upper = t > 0.41421356237309503;
    const Lanes x = upper ? (t - 1.0) / (t + 1.0) : t;
    const Lanes z = x * x;
    Lanes p = splat(1.0 / 25.0);
    p = 1.0 / 23.0 - z * p;
    p = 1.0 / 21.0 - z * p;
    p = 1.0 / 19.0 - z * p;
    p = 1.0 / 17.0 - z * p;
    p = 1.0 / 15.0 - z * p;
    p = 1.0 / 13.0 - z * p;
    p = 1.0 / 11.0 - z * p;
    p = 1.0 / 9.0 - z * p;
    p = 1.0 / 7.0 - z * p;
    p = 1.0 / 5.0 - z * p;
    p = 1.0 / 3.0 - z * p;
    Lanes a = x - x * z * p;
    a = upper ? a + 0.78539816339744828 : a;
    a = steep ? 1.5707963267948966 - a : a;
    return cosine < 0.0 ? 3.1415926535897931 - a : a;
}

struct alignas(kLanesAlignment) Lanes3 {
    Lanes x;
    Lanes y;
    Lanes z;
};

FLUXWALK_INLINE Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
FLUXWALK_INLINE Lanes dot(const Lanes3& a, const Lanes3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
FLUXWALK_INLINE Lanes3 cross(const Lanes3& a, const Lanes3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace fluxwalk::base
