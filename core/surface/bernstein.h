#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

/// Polynomials on [0, 1] by their Bernstein coefficients, whose signs tell where roots can be.
namespace fluxwalk::surface {

/// Coefficients of a polynomial of degree N - 1.
template <std::size_t N>
using Bernstein = std::array<double, N>;

constexpr double binomial(std::size_t n, std::size_t k) {
    double value = 1.0;
    for (std::size_t i = 0; i < k; ++i) {
        value = value * static_cast<double>(n - i) / static_cast<double>(i + 1);
    }
    return value;
}

template <std::size_t N, std::size_t M>
constexpr Bernstein<N + M - 1> multiply(const Bernstein<N>& a, const Bernstein<M>& b) {
    Bernstein<N + M - 1> product{};
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = 0; j < M; ++j) {
            product[i + j] += binomial(N - 1, i) * a[i] * binomial(M - 1, j) * b[j];
        }
    }
    for (std::size_t k = 0; k < N + M - 1; ++k) {
        product[k] /= binomial(N + M - 2, k);
    }
    return product;
}

/// Value at s, by de Casteljau's corner cutting; `left` and `right` become the parts on both sides of s.
template <std::size_t N>
double cut(const Bernstein<N>& whole, double s, Bernstein<N>& left, Bernstein<N>& right) {
    right = whole;
    for (std::size_t level = 0; level < N; ++level) {
        left[level] = right[0];
        for (std::size_t i = 0; i + level + 1 < N; ++i) {
            right[i] = (1.0 - s) * right[i] + s * right[i + 1];
        }
    }
    return right[0];
}

template <std::size_t N>
double valueAt(Bernstein<N> c, double s) {
    for (std::size_t level = N - 1; level > 0; --level) {
        for (std::size_t i = 0; i < level; ++i) {
            c[i] = (1.0 - s) * c[i] + s * c[i + 1];
        }
    }
    return c[0];
}

/// Crossing of a polynomial that has exactly one in [0, 1], to rounding: Newton's steps as long as they stay
/// between the ends of what is left, else its middle.
template <std::size_t N>
double refineRoot(const Bernstein<N>& whole) {
    const bool isPositive = whole.front() >= 0.0;
    // A root on an end draws Newton's steps away from the crossing: divide it out.
    constexpr double kNothing = 1e-12;
    double largest = 0.0;
    for (const double c : whole) {
        largest = std::max(largest, std::abs(c));
    }
    const bool startsOnRoot = std::abs(whole.front()) <= kNothing * largest;
    const bool endsOnRoot = std::abs(whole.back()) <= kNothing * largest;
    double low = 0.0;
    double high = 1.0;
    const double middle = std::abs(whole.front()) / (std::abs(whole.front()) + std::abs(whole.back()));
    double s = startsOnRoot || endsOnRoot ? 0.5 : middle;
    for (int step = 0; step < 100 && low < s && s < high; ++step) {
        // De Casteljau down to two points: their difference is the slope.
        Bernstein<N> c = whole;
        for (std::size_t level = N - 1; level > 1; --level) {
            for (std::size_t i = 0; i < level; ++i) {
                c[i] = (1.0 - s) * c[i] + s * c[i + 1];
            }
        }
        const double value = (1.0 - s) * c[0] + s * c[1];
        const double slope = static_cast<double>(N - 1) * (c[1] - c[0]) - (startsOnRoot ? value / s : 0.0) +
                             (endsOnRoot ? value / (1.0 - s) : 0.0);
        ((value >= 0.0) == isPositive ? low : high) = s;
        const double next = s - value / slope;
        if (std::abs(next - s) <= 2e-16) {
            return next;
        }
        s = next > low && next < high ? next : 0.5 * (low + high);
    }
    return s;
}

/// First place in [0, 1] where the sign changes (0 counts as positive). Exact in what it tells apart: a part
/// whose coefficients have one sign has no root, and one change of sign means one root. Only two crossings
/// closer than 1e-12 of the interval, a ray that grazes, may be taken for none.
template <std::size_t N>
std::optional<double> firstCrossing(const Bernstein<N>& whole) {
    constexpr int kDeepest = 40;
    struct Part {
        Bernstein<N> c;
        double start;
        int depth;
    };
    std::array<Part, kDeepest + 2> stack;
    std::size_t count = 0;
    stack[count++] = {whole, 0.0, 0};
    while (count > 0) {
        const Part part = stack[--count];
        int changes = 0;
        for (std::size_t i = 0; i + 1 < N; ++i) {
            changes += (part.c[i] >= 0.0) != (part.c[i + 1] >= 0.0) ? 1 : 0;
        }
        if (changes == 0 || (part.depth == kDeepest && changes % 2 == 0)) {
            continue;
        }
        const double width = std::ldexp(1.0, -part.depth);
        if (changes == 1 || part.depth == kDeepest) {
            return part.start + width * refineRoot(part.c);
        }
        Part left{{}, part.start, part.depth + 1};
        Part right{{}, part.start + 0.5 * width, part.depth + 1};
        cut(part.c, 0.5, left.c, right.c);
        stack[count++] = right;
        stack[count++] = left;
    }
    return std::nullopt;
}

}  // namespace fluxwalk::surface
