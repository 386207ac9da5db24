#pragma once

#include <algorithm>
#include <cmath>

/// Form factors known in closed form (ALGORITHMS 3.1), against which everything else is tested.
namespace fluxwalk::closed_forms {

inline constexpr double kPi = 3.14159265358979323846;

/// Parallel coaxial discs of radii r1 and r2 at distance h, F(1->2).
inline double coaxialDiscs(double r1, double r2, double h) {
    const double x = r1 / h;
    const double y = r2 / h;
    const double s = 1.0 + (1.0 + y * y) / (x * x);
    const double ratio = r2 / r1;
    // The smaller root of a quadratic, without its cancellation.
    return 2.0 * ratio * ratio / (s + std::sqrt(s * s - 4.0 * ratio * ratio));
}

/// Directly opposed rectangles a x b at distance c.
inline double parallelRectangles(double a, double b, double c) {
    const double x = a / c;
    const double y = b / c;
    const double x2 = 1.0 + x * x;
    const double y2 = 1.0 + y * y;
    return 2.0 / (kPi * x * y) *
           (0.5 * std::log(x2 * y2 / (x2 + y2 - 1.0)) + x * std::sqrt(y2) * std::atan(x / std::sqrt(y2)) +
            y * std::sqrt(x2) * std::atan(y / std::sqrt(x2)) - x * std::atan(x) - y * std::atan(y));
}

/// Perpendicular rectangles with a common edge of length l and widths w (first) and h (second).
inline double perpendicularRectangles(double w, double h, double l) {
    const double rh = h / l;
    const double rw = w / l;
    const double h2 = rh * rh;
    const double w2 = rw * rw;
    const double diagonal = std::sqrt(h2 + w2);
    const double a = (1.0 + w2) * (1.0 + h2) / (1.0 + w2 + h2);
    const double b = w2 * (1.0 + w2 + h2) / ((1.0 + w2) * (w2 + h2));
    const double c = h2 * (1.0 + h2 + w2) / ((1.0 + h2) * (h2 + w2));
    return (rw * std::atan(1.0 / rw) + rh * std::atan(1.0 / rh) - diagonal * std::atan(1.0 / diagonal) +
            0.25 * (std::log(a) + w2 * std::log(b) + h2 * std::log(c))) /
           (kPi * rw);
}

/// Point to a parallel rectangle a x b at distance c, one corner above the point.
inline double pointParallelRectangle(double a, double b, double c) {
    const double x = a / c;
    const double y = b / c;
    const double sx = std::sqrt(1.0 + x * x);
    const double sy = std::sqrt(1.0 + y * y);
    return (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2.0 * kPi);
}

/// Point to a perpendicular rectangle that stands on the receiver's plane at distance c: width y from the
/// point's foot, height z.
inline double pointPerpendicularRectangle(double y, double z, double c) {
    const double slant = std::hypot(c, z);
    return (std::atan(y / c) - c / slant * std::atan(y / slant)) / (2.0 * kPi);
}

/// Point to a parallel disc of radius r at height h, its axis at distance a from the point.
inline double pointParallelDisc(double r, double h, double a) {
    if (a == 0.0) {
        return r * r / (r * r + h * h);
    }
    const double ra = r / a;
    const double z = 1.0 + h * h / (a * a) + ra * ra;
    return 0.5 * (1.0 - (z - 2.0 * ra * ra) / std::sqrt(z * z - 4.0 * ra * ra));
}

/// Sphere to a coaxial disc of radius r at distance h from its centre.
inline double sphereDisc(double r, double h) {
    return 0.5 * (1.0 - 1.0 / std::sqrt(1.0 + r * r / (h * h)));
}

/// Finite coaxial cylinders of height h: outer (r2) to inner (r1) is F(1->2) r1 / r2.
struct CoaxialCylinders {
    double innerToOuter = 0.0;
    double outerToInner = 0.0;
    double outerToOuter = 0.0;
    double innerToEnds = 0.0;  ///< both annular ends together, by closure
};

inline CoaxialCylinders coaxialCylinders(double r1, double r2, double h) {
    const double x = r1 / h;
    const double y = r2 / h;
    const double a = y + x;
    const double b = y - x;
    CoaxialCylinders f;
    f.innerToOuter = (0.5 * (y * y - x * x - 1.0) * std::acos(x / y) + kPi * x - 0.5 * kPi * a * b -
                      2.0 * x * std::atan(std::sqrt(y * y - x * x)) +
                      std::sqrt((1.0 + a * a) * (1.0 + b * b)) *
                          std::atan(std::sqrt((1.0 + a * a) * b / ((1.0 + b * b) * a)))) /
                     (kPi * x);
    f.outerToInner = f.innerToOuter * r1 / r2;
    const double r = r2 / r1;
    const double height = h / r1;
    const double q = std::sqrt(4.0 * r * r + height * height);
    const double s = 4.0 * (r * r - 1.0);
    const double first = std::asin((s + (height / r) * (height / r) * (r * r - 2.0)) / (height * height + s));
    f.outerToOuter =
        1.0 - 1.0 / r + 2.0 / (kPi * r) * std::atan(2.0 * std::sqrt(r * r - 1.0) / height) -
        height / (2.0 * kPi * r) *
            (q / height * first - std::asin((r * r - 2.0) / (r * r)) + 0.5 * kPi * (q / height - 1.0));
    f.innerToEnds = 1.0 - f.innerToOuter;
    return f;
}

/// Inside of one right cylinder: wall to itself and base to base, H = height / diameter.
inline double cylinderWallWall(double h) {
    return 1.0 + h - std::sqrt(1.0 + h * h);
}
inline double cylinderBaseBase(double h) {
    return 1.0 + 2.0 * h * h - 2.0 * h * std::sqrt(1.0 + h * h);
}

/// A point's part of the sky that a sphere of radius r at distance d covers, its normal turned by `tilt`
/// radians (sphere above the horizon).
inline double pointSphere(double r, double d, double tilt) {
    return std::cos(tilt) * (r / d) * (r / d);
}

/// Infinite strips of unit width at a gap, by crossed strings.
inline double parallelStrips(double gap) {
    return std::hypot(1.0, gap) - gap;
}
/// Infinite wedge of equal sides.
inline double wedge(double radians) {
    return 1.0 - std::sin(0.5 * radians);
}

}  // namespace fluxwalk::closed_forms
