#pragma once

#include <cmath>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/surface/control_cage.h"

/// Control cages for tests.
namespace fluxwalk::test {

using surface::ControlCage;
using surface::SubdivisionScheme;

inline void addFace(ControlCage& cage, std::initializer_list<std::uint32_t> corners) {
    cage.faceSizes.push_back(static_cast<std::uint32_t>(corners.size()));
    cage.corners.insert(cage.corners.end(), corners);
}

/// Corners at +-1.
inline ControlCage cubeCage() {
    ControlCage cage;
    for (int i = 0; i < 8; ++i) {
        cage.positions.emplace_back((i & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1, (i >> 2 & 1) * 2 - 1);
    }
    addFace(cage, {0, 2, 3, 1});
    addFace(cage, {4, 5, 7, 6});
    addFace(cage, {0, 1, 5, 4});
    addFace(cage, {2, 6, 7, 3});
    addFace(cage, {0, 4, 6, 2});
    addFace(cage, {1, 3, 7, 5});
    return cage;
}

inline ControlCage octahedronCage() {
    ControlCage cage;
    cage.scheme = SubdivisionScheme::loop;
    cage.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    addFace(cage, {0, 2, 4});
    addFace(cage, {2, 1, 4});
    addFace(cage, {1, 3, 4});
    addFace(cage, {3, 0, 4});
    addFace(cage, {2, 0, 5});
    addFace(cage, {1, 2, 5});
    addFace(cage, {3, 1, 5});
    addFace(cage, {0, 3, 5});
    return cage;
}

/// A closed grid of `rings` x `sides` quads about the y axis.
inline ControlCage torusCage(std::uint32_t sides, std::uint32_t rings) {
    ControlCage cage;
    for (std::uint32_t i = 0; i < sides; ++i) {
        for (std::uint32_t j = 0; j < rings; ++j) {
            const double a = 2.0 * base::kPi * i / sides;
            const double b = 2.0 * base::kPi * j / rings;
            const double r = 2.0 + std::cos(b);
            cage.positions.emplace_back(r * std::cos(a), std::sin(b), -r * std::sin(a));
        }
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        for (std::uint32_t j = 0; j < rings; ++j) {
            const std::uint32_t k = (i + 1) % sides;
            const std::uint32_t l = (j + 1) % rings;
            addFace(cage, {i * rings + j, k * rings + j, k * rings + l, i * rings + l});
        }
    }
    return cage;
}

/// Ten rings of ten quads, turned on a lathe about the y axis; open above and below.
inline ControlCage vaseCage() {
    constexpr std::uint32_t kSides = 10;
    constexpr std::array<double, 11> kRadius{.5, .8, 1.0, 1.05, .95, .7, .45, .35, .4, .55, .65};
    ControlCage cage;
    for (std::uint32_t j = 0; j < kRadius.size(); ++j) {
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const double a = 2.0 * base::kPi * i / kSides;
            cage.positions.emplace_back(kRadius[j] * std::cos(a), .3 * j, -kRadius[j] * std::sin(a));
        }
    }
    for (std::uint32_t j = 0; j + 1 < kRadius.size(); ++j) {
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const std::uint32_t k = (i + 1) % kSides;
            addFace(cage, {j * kSides + i, j * kSides + k, (j + 1) * kSides + k, (j + 1) * kSides + i});
        }
    }
    return cage;
}

/// A pentagonal prism whose top is pointed, with triangles, quads and a pentagon, creases of several kinds,
/// and no symmetry.
inline ControlCage mixedCage() {
    ControlCage cage;
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 5; ++i) {
            const double a = 2.0 * base::kPi * i / 5 + .2 * j;
            cage.positions.emplace_back((1.0 + .2 * i) * std::cos(a), 1.5 * j + .1 * i, -std::sin(a));
        }
    }
    cage.positions.emplace_back(.1, 2.3, .2);
    addFace(cage, {4, 3, 2, 1, 0});
    for (std::uint32_t i = 0; i < 5; ++i) {
        const std::uint32_t k = (i + 1) % 5;
        addFace(cage, {i, k, 5 + k, 5 + i});
        addFace(cage, {5 + i, 5 + k, 10});
    }
    cage.creases = {
        {0, 1, surface::kInfinitelySharp}, {1, 2, surface::kInfinitelySharp}, {6, 7, 2.5f}, {8, 10, 1.0f}};
    return cage;
}

/// The same corners, but without the top's fan: open.
inline ControlCage openLoopCage() {
    ControlCage cage = octahedronCage();
    cage.positions[0] = {1.3, .1, .2};
    cage.faceSizes.pop_back();
    cage.corners.resize(cage.corners.size() - 3);
    cage.creases = {{0, 2, surface::kInfinitelySharp}, {2, 1, surface::kInfinitelySharp}, {1, 4, 1.5f}};
    return cage;
}

/// A closed double cone of triangles about vertices 0 and 1.
inline ControlCage wheelCage(std::uint32_t sides) {
    ControlCage cage;
    cage.positions = {{0, 1, 0}, {0, -1, 0}};
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double a = 2.0 * base::kPi * i / sides;
        cage.positions.emplace_back(std::cos(a), 0.0, -std::sin(a));
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t next = 2 + (i + 1) % sides;
        addFace(cage, {2 + i, next, 0});
        addFace(cage, {next, 2 + i, 1});
    }
    return cage;
}

/// Rotation, three scales and a shift; with a mirror.
inline base::Mat4d skewMap(bool mirrored) {
    const double c = std::cos(.7);
    const double s = std::sin(.7);
    base::Mat4d m(1.0);
    m[0] = {2.0 * c, 2.0 * s, 0, 0};
    m[1] = {-s, c, .3, 0};
    m[2] = {0, 0, mirrored ? -.5 : .5, 0};
    m[3] = {1, -2, 3, 1};
    return m;
}

}  // namespace fluxwalk::test
