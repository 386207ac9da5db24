#pragma once

#include <cstddef>
#include <cstdint>

/// Eight doubles at once, through the compiler's vector extension: the same IEEE operations on any
/// instruction set, so the same bits. Functions are forced inline, so that they take on the instruction set
/// of the kernel that uses them.
namespace fluxwalk::base {

inline constexpr int kLanes = 8;
/// For structures that hold lanes: their natural alignment depends on the instruction set that a file is
/// compiled for, and kernels for wider ones load and store whole vectors in what others made.
inline constexpr std::size_t kLanesAlignment = 64;

#define FLUXWALK_INLINE [[gnu::always_inline]] inline

/// Two halves, as AVX2 has registers of that size: GCC 12 takes comparisons and selections of wider vectors
/// apart into single numbers (angleLanes was 4 times slower).
using HalfLanes = double __attribute__((vector_size(32)));
using HalfMask = std::int64_t __attribute__((vector_size(32)));

struct LaneMask {
    HalfMask low{};
    HalfMask high{};

    FLUXWALK_INLINE bool operator[](int i) const { return (i < 4 ? low[i] : high[i - 4]) != 0; }
};

struct alignas(kLanesAlignment) Lanes {
    HalfLanes low{};
    HalfLanes high{};

    FLUXWALK_INLINE double operator[](int i) const { return i < 4 ? low[i] : high[i - 4]; }
    FLUXWALK_INLINE void set(int i, double v) {
        if (i < 4) {
            low[i] = v;
        } else {
            high[i - 4] = v;
        }
    }
};

FLUXWALK_INLINE Lanes splat(double v) {
    return {HalfLanes{v, v, v, v}, HalfLanes{v, v, v, v}};
}
FLUXWALK_INLINE Lanes operator+(const Lanes& a, const Lanes& b) {
    return {a.low + b.low, a.high + b.high};
}
FLUXWALK_INLINE Lanes operator-(const Lanes& a, const Lanes& b) {
    return {a.low - b.low, a.high - b.high};
}
FLUXWALK_INLINE Lanes operator*(const Lanes& a, const Lanes& b) {
    return {a.low * b.low, a.high * b.high};
}
FLUXWALK_INLINE Lanes operator/(const Lanes& a, const Lanes& b) {
    return {a.low / b.low, a.high / b.high};
}
FLUXWALK_INLINE Lanes operator-(const Lanes& a) {
    return {-a.low, -a.high};
}
FLUXWALK_INLINE Lanes operator+(const Lanes& a, double b) {
    return a + splat(b);
}
FLUXWALK_INLINE Lanes operator-(const Lanes& a, double b) {
    return a - splat(b);
}
FLUXWALK_INLINE Lanes operator-(double a, const Lanes& b) {
    return splat(a) - b;
}
FLUXWALK_INLINE Lanes operator*(const Lanes& a, double b) {
    return a * splat(b);
}
FLUXWALK_INLINE Lanes operator*(double a, const Lanes& b) {
    return splat(a) * b;
}
FLUXWALK_INLINE Lanes& operator+=(Lanes& a, const Lanes& b) {
    return a = a + b;
}
FLUXWALK_INLINE Lanes& operator-=(Lanes& a, const Lanes& b) {
    return a = a - b;
}

FLUXWALK_INLINE LaneMask operator<(const Lanes& a, const Lanes& b) {
    return {a.low < b.low, a.high < b.high};
}
FLUXWALK_INLINE LaneMask operator>(const Lanes& a, const Lanes& b) {
    return b < a;
}
FLUXWALK_INLINE LaneMask operator&(const LaneMask& a, const LaneMask& b) {
    return {a.low & b.low, a.high & b.high};
}
FLUXWALK_INLINE LaneMask operator~(const LaneMask& m) {
    return {~m.low, ~m.high};
}
FLUXWALK_INLINE LaneMask& operator&=(LaneMask& a, const LaneMask& b) {
    return a = a & b;
}
FLUXWALK_INLINE LaneMask& operator|=(LaneMask& a, const LaneMask& b) {
    a.low |= b.low;
    a.high |= b.high;
    return a;
}

/// `a` where the mask is set, else `b`.
FLUXWALK_INLINE Lanes select(const LaneMask& mask, const Lanes& a, const Lanes& b) {
    return {mask.low ? a.low : b.low, mask.high ? a.high : b.high};
}
FLUXWALK_INLINE Lanes maxLanes(const Lanes& a, const Lanes& b) {
    return select(a > b, a, b);
}
FLUXWALK_INLINE Lanes minLanes(const Lanes& a, const Lanes& b) {
    return select(a < b, a, b);
}

FLUXWALK_INLINE HalfLanes sqrtHalf(const HalfLanes& v) {
    return HalfLanes{__builtin_sqrt(v[0]), __builtin_sqrt(v[1]), __builtin_sqrt(v[2]), __builtin_sqrt(v[3])};
}
FLUXWALK_INLINE Lanes sqrtLanes(const Lanes& v) {
    return {sqrtHalf(v.low), sqrtHalf(v.high)};
}

FLUXWALK_INLINE bool anyLane(const LaneMask& m) {
    const HalfMask both = m.low | m.high;
    return ((both[0] | both[1]) | (both[2] | both[3])) != 0;
}

/// Angle in [0, pi] of the direction (cosine, sine), sine >= 0; relative error below 1e-11, exact limit for
/// small angles; 0 for (0, 0).
FLUXWALK_INLINE Lanes angleLanes(const Lanes& sine, const Lanes& cosine) {
    const LaneMask isObtuse = cosine < splat(0.0);
    const Lanes c = select(isObtuse, -cosine, cosine);
    const LaneMask steep = sine > c;
    const Lanes large = maxLanes(sine, c);
    const Lanes small = minLanes(sine, c);
    const Lanes t = small / maxLanes(large, splat(1e-300));
    // atan on [0, 1]: above tan(pi/8) through atan t = pi/4 + atan((t - 1) / (t + 1)), then the series.
    const LaneMask upper = t > splat(0.41421356237309503);
    const Lanes x = select(upper, (t - 1.0) / (t + 1.0), t);
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
    a = select(upper, a + 0.78539816339744828, a);
    a = select(steep, 1.5707963267948966 - a, a);
    return select(isObtuse, 3.1415926535897931 - a, a);
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
