#include "core/surface/bezier_piece.h"

#include <cmath>
#include <span>

namespace fluxwalk::surface {

namespace {

/// Points of a cubic or quadratic in u for each power of v, and for triangles what quarticIndex does at
/// another degree.
constexpr std::size_t triangleIndex(std::size_t degree, std::size_t i, std::size_t j) {
    return j * (degree + 1) - j * (j - 1) / 2 + i;
}

constexpr std::array<double, 4> kCubic{1, 3, 3, 1};
constexpr std::array<double, 3> kQuadratic{1, 2, 1};

constexpr double factorial(std::size_t n) {
    return n < 2 ? 1.0 : static_cast<double>(n) * factorial(n - 1);
}

constexpr double multinomial(std::size_t degree, std::size_t i, std::size_t j) {
    return factorial(degree) / (factorial(i) * factorial(j) * factorial(degree - i - j));
}

/// Control vectors of a derivative; 12 for bicubics, 10 for quartic triangles.
struct Derivative {
    std::array<Vec3d, 12> vectors{};
    std::size_t count = 0;
    std::span<const Vec3d> all() const { return {vectors.data(), count}; }
};

// du has 3 vectors a row; dv has 4.
Derivative alongU(const BezierPiece& piece) {
    Derivative d;
    if (piece.domain == PatchDomain::quad) {
        for (std::size_t j = 0; j < 4; ++j) {
            for (std::size_t i = 0; i < 3; ++i) {
                d.vectors[d.count++] = 3.0 * (piece.points[4 * j + i + 1] - piece.points[4 * j + i]);
            }
        }
        return d;
    }
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i + j < 4; ++i) {
            d.vectors[d.count++] =
                4.0 * (piece.points[quarticIndex(i + 1, j)] - piece.points[quarticIndex(i, j)]);
        }
    }
    return d;
}

Derivative alongV(const BezierPiece& piece) {
    Derivative d;
    if (piece.domain == PatchDomain::quad) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t i = 0; i < 4; ++i) {
                d.vectors[d.count++] = 3.0 * (piece.points[4 * (j + 1) + i] - piece.points[4 * j + i]);
            }
        }
        return d;
    }
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i + j < 4; ++i) {
            d.vectors[d.count++] =
                4.0 * (piece.points[quarticIndex(i, j + 1)] - piece.points[quarticIndex(i, j)]);
        }
    }
    return d;
}

/// Bernstein polynomials of degree 3 and their derivatives.
struct Cubic {
    std::array<double, 4> value;
    std::array<double, 4> slope;
};

Cubic cubicAt(double t) {
    const double s = 1.0 - t;
    return {{s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t},
            {-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t}};
}

Tangents evaluateQuad(const BezierPiece& piece, const Vec2d& uv) {
    const Cubic u = cubicAt(uv.x);
    const Cubic v = cubicAt(uv.y);
    Tangents result;
    for (std::size_t j = 0; j < 4; ++j) {
        const Vec3d* row = piece.points.data() + 4 * j;
        const Vec3d value =
            u.value[0] * row[0] + u.value[1] * row[1] + u.value[2] * row[2] + u.value[3] * row[3];
        const Vec3d slope =
            u.slope[0] * row[0] + u.slope[1] * row[1] + u.slope[2] * row[2] + u.slope[3] * row[3];
        result.position += v.value[j] * value;
        result.du += v.value[j] * slope;
        result.dv += v.slope[j] * value;
    }
    return result;
}

// One step of de Casteljau's scheme leaves cubics whose values are the point and, by differences, the
// derivatives.
Tangents evaluateTriangle(const BezierPiece& piece, const Vec2d& uv) {
    const double u = uv.x;
    const double v = uv.y;
    const double w = 1.0 - u - v;
    const std::array<double, 10> cubic{w * w * w,       3.0 * u * w * w, 3.0 * u * u * w, u * u * u,
                                       3.0 * v * w * w, 6.0 * u * v * w, 3.0 * u * u * v, 3.0 * v * v * w,
                                       3.0 * u * v * v, v * v * v};
    Vec3d here(0.0);
    Vec3d right(0.0);
    Vec3d above(0.0);
    std::size_t k = 0;
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i + j < 4; ++i) {
            here += cubic[k] * piece.points[quarticIndex(i, j)];
            right += cubic[k] * piece.points[quarticIndex(i + 1, j)];
            above += cubic[k] * piece.points[quarticIndex(i, j + 1)];
            ++k;
        }
    }
    return {w * here + u * right + v * above, 4.0 * (right - here), 4.0 * (above - here)};
}

// The cubic with control points p[0], p[stride]... over [a, b] of its parameter.
void restrictCubic(Vec3d* p, std::size_t stride, double a, double b) {
    const auto blossom = [&](double x, double y, double z) {
        const auto mix = [](const Vec3d& from, const Vec3d& to, double t) {
            return (1.0 - t) * from + t * to;
        };
        const Vec3d p01 = mix(p[0], p[stride], x);
        const Vec3d p12 = mix(p[stride], p[2 * stride], x);
        const Vec3d p23 = mix(p[2 * stride], p[3 * stride], x);
        return mix(mix(p01, p12, y), mix(p12, p23, y), z);
    };
    const std::array<Vec3d, 4> q{blossom(a, a, a), blossom(a, a, b), blossom(a, b, b), blossom(b, b, b)};
    for (std::size_t i = 0; i < 4; ++i) {
        p[i * stride] = q[i];
    }
}

BezierPiece restrictTriangle(const BezierPiece& piece, const ParameterMap& part) {
    const std::array<Vec2d, 3> corner{part.origin, part.origin + part.du, part.origin + part.dv};
    BezierPiece result;
    result.domain = PatchDomain::triangle;
    for (std::size_t j = 0; j <= 4; ++j) {
        for (std::size_t i = 0; i + j <= 4; ++i) {
            // Blossom: corner 1 i times, corner 2 j times, corner 0 for the rest.
            std::array<Vec3d, 16> p = piece.points;
            for (std::size_t degree = 4; degree > 0; --degree) {
                const std::size_t step = 4 - degree;
                const Vec2d& at = corner[step < i ? 1 : step < i + j ? 2 : 0];
                const double w = 1.0 - at.x - at.y;
                for (std::size_t l = 0; l < degree; ++l) {
                    for (std::size_t k = 0; k + l < degree; ++k) {
                        p[triangleIndex(degree - 1, k, l)] = w * p[triangleIndex(degree, k, l)] +
                                                             at.x * p[triangleIndex(degree, k + 1, l)] +
                                                             at.y * p[triangleIndex(degree, k, l + 1)];
                    }
                }
            }
            result.points[quarticIndex(i, j)] = p[0];
        }
    }
    return result;
}

/// Vectors by their coordinates, which the loops over them take several of at a time.
template <std::size_t N>
struct Vectors {
    std::array<double, N> x{};
    std::array<double, N> y{};
    std::array<double, N> z{};

    Vec3d at(std::size_t i) const { return {x[i], y[i], z[i]}; }
    void set(std::size_t i, const Vec3d& v) {
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
};

/// Bezier coefficients of du x dv up to positive factors: 36 of degree (5, 5), or 28 of degree 6.
struct NormalNet {
    Vectors<36> vectors;
    std::size_t count = 0;
};

NormalNet normalNetOfQuad(const Derivative& du, const Derivative& dv) {
    NormalNet net;
    net.count = 36;
    Vectors<12> second;
    for (std::size_t i = 0; i < 12; ++i) {
        second.set(i, dv.vectors[i]);
    }
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3d first = du.vectors[3 * j + i];
            for (std::size_t l = 0; l < 3; ++l) {
                const double outer = kQuadratic[i] * kCubic[j];
                const double* bx = second.x.data() + 4 * l;
                const double* by = second.y.data() + 4 * l;
                const double* bz = second.z.data() + 4 * l;
                double* x = net.vectors.x.data() + 6 * (j + l) + i;
                double* y = net.vectors.y.data() + 6 * (j + l) + i;
                double* z = net.vectors.z.data() + 6 * (j + l) + i;
                for (std::size_t k = 0; k < 4; ++k) {
                    const double weight = outer * kCubic[k] * kQuadratic[l];
                    x[k] += weight * (first.y * bz[k] - by[k] * first.z);
                    y[k] += weight * (first.z * bx[k] - bz[k] * first.x);
                    z[k] += weight * (first.x * by[k] - bx[k] * first.y);
                }
            }
        }
    }
    return net;
}

NormalNet normalNet(const BezierPiece& piece) {
    const Derivative du = alongU(piece);
    const Derivative dv = alongV(piece);
    if (piece.domain == PatchDomain::quad) {
        return normalNetOfQuad(du, dv);
    }
    NormalNet net;
    net.count = 28;
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i + j < 4; ++i) {
            for (std::size_t l = 0; l < 4; ++l) {
                for (std::size_t k = 0; k + l < 4; ++k) {
                    const std::size_t at = triangleIndex(6, i + k, j + l);
                    net.vectors.set(at,
                                    net.vectors.at(at) + multinomial(3, i, j) * multinomial(3, k, l) *
                                                             glm::cross(du.vectors[triangleIndex(3, i, j)],
                                                                        dv.vectors[triangleIndex(3, k, l)]));
                }
            }
        }
    }
    return net;
}

/// Largest and smallest of dot(v, n) over the unit vectors n of a cone.
double supportOf(const NormalCone& cone, const Vec3d& v) {
    const double length = glm::length(v);
    if (length == 0.0) {
        return 0.0;
    }
    return length * std::cos(std::max(0.0, NormalCone::angleBetween(v / length, cone.axis) - cone.halfAngle));
}

}  // namespace

Vec2d ParameterMap::inverse(const Vec2d& uv) const {
    const Vec2d p = uv - origin;
    const double det = determinant();
    return {(p.x * dv.y - p.y * dv.x) / det, (du.x * p.y - du.y * p.x) / det};
}

ParameterMap ParameterMap::then(const ParameterMap& part) const {
    return {at(part.origin), part.du.x * du + part.du.y * dv, part.dv.x * du + part.dv.y * dv};
}

ParameterMap quarterMap(PatchDomain domain, unsigned quarter) {
    constexpr std::array<Vec2d, 4> kQuad{Vec2d{0, 0}, Vec2d{.5, 0}, Vec2d{.5, .5}, Vec2d{0, .5}};
    constexpr std::array<Vec2d, 4> kTriangle{Vec2d{0, 0}, Vec2d{.5, 0}, Vec2d{0, .5}, Vec2d{.5, .5}};
    if (domain == PatchDomain::quad) {
        return {kQuad[quarter], {.5, 0}, {0, .5}};
    }
    const double half = quarter == 3 ? -.5 : .5;
    return {kTriangle[quarter], {half, 0}, {0, half}};
}

Tangents evaluatePiece(const BezierPiece& piece, const Vec2d& uv) {
    return piece.domain == PatchDomain::quad ? evaluateQuad(piece, uv) : evaluateTriangle(piece, uv);
}

BezierPiece restrictPiece(const BezierPiece& piece, const ParameterMap& part) {
    if (piece.domain == PatchDomain::triangle) {
        return restrictTriangle(piece, part);
    }
    BezierPiece result = piece;
    for (std::size_t k = 0; k < 4; ++k) {
        restrictCubic(result.points.data() + 4 * k, 1, part.origin.x, part.origin.x + part.du.x);
    }
    for (std::size_t k = 0; k < 4; ++k) {
        restrictCubic(result.points.data() + k, 4, part.origin.y, part.origin.y + part.dv.y);
    }
    return result;
}

Box boundPiece(const BezierPiece& piece) {
    Box box;
    const std::size_t count = piece.domain == PatchDomain::quad ? 16 : 15;
    for (std::size_t i = 0; i < count; ++i) {
        box.extend(piece.points[i]);
    }
    return box;
}

namespace {

/// The mean direction of a piece's normals and the one that is farthest from it, where they have a mean.
struct NormalSpread {
    Vec3d axis{0, 0, 1};
    Vec3d farthest{};
    bool hasAxis = false;
};

NormalSpread spreadOfNormals(const BezierPiece& piece) {
    NormalNet net = normalNet(piece);
    Vectors<36>& v = net.vectors;
    for (std::size_t i = 0; i < net.count; ++i) {
        const double length = std::sqrt(v.x[i] * v.x[i] + v.y[i] * v.y[i] + v.z[i] * v.z[i]);
        v.x[i] = length > 0.0 ? v.x[i] / length : 0.0;
        v.y[i] = length > 0.0 ? v.y[i] / length : 0.0;
        v.z[i] = length > 0.0 ? v.z[i] / length : 0.0;
    }
    Vec3d sum(0.0);
    for (std::size_t i = 0; i < net.count; ++i) {
        sum += v.at(i);
    }
    NormalSpread spread;
    const double length = glm::length(sum);
    if (!(length > 1e-6)) {
        return spread;
    }
    spread.hasAxis = true;
    spread.axis = sum / length;
    double distance = -1.0;
    for (std::size_t i = 0; i < net.count; ++i) {
        const Vec3d away = v.at(i) - spread.axis;
        const double squared = glm::dot(away, away);
        if (squared > distance && v.at(i) != Vec3d(0.0)) {
            distance = squared;
            spread.farthest = v.at(i);
        }
    }
    return spread;
}

}  // namespace

NormalCone boundNormals(const BezierPiece& piece) {
    const NormalSpread spread = spreadOfNormals(piece);
    const double halfAngle =
        spread.hasAxis ? NormalCone::angleBetween(spread.farthest, spread.axis) : base::kPi;
    return {spread.axis, halfAngle >= 0.5 * base::kPi ? base::kPi : halfAngle};
}

bool normalsLieWithin(const BezierPiece& piece, double halfAngle) {
    if (halfAngle >= 0.5 * base::kPi) {
        return boundNormals(piece).halfAngle <= halfAngle;
    }
    const NormalSpread spread = spreadOfNormals(piece);
    return spread.hasAxis && base::AngleLimit(halfAngle).holds(spread.farthest, spread.axis);
}

LinearModel linearize(const BezierPiece& piece) {
    LinearModel model{evaluatePiece(piece, middleOf(piece.domain)), 0.0, 0.0};
    const auto farthest = [](const Derivative& derivative, const Vec3d& from) {
        double squared = 0.0;
        for (const Vec3d& v : derivative.all()) {
            squared = std::max(squared, glm::dot(v - from, v - from));
        }
        return squared;
    };
    model.deviationU = std::sqrt(farthest(alongU(piece), model.middle.du));
    model.deviationV = std::sqrt(farthest(alongV(piece), model.middle.dv));
    return model;
}

Vec2d clampToDomain(PatchDomain domain, const Vec2d& st, double margin) {
    if (domain == PatchDomain::quad) {
        return glm::clamp(st, Vec2d(-margin), Vec2d(1.0 + margin));
    }
    Vec2d p = glm::max(st, Vec2d(-margin));
    const double excess = p.x + p.y - (1.0 + margin);
    if (excess > 0.0) {
        p.x = std::clamp(p.x - 0.5 * excess, -margin, 1.0 + 2.0 * margin);
        p.y = 1.0 + margin - p.x;
    }
    return p;
}

bool bendsAway(const BezierPiece& piece, const NormalCone& normals, double sign, double tolerance) {
    const Derivative du = alongU(piece);
    const Derivative dv = alongV(piece);
    // Largest second derivatives along any of the normals, and the largest mixed one by size.
    double uu = -std::numeric_limits<double>::infinity();
    double vv = uu;
    double uv = 0.0;
    const auto most = [&](const Vec3d& v) { return supportOf(normals, sign * v); };
    const auto mixed = [&](const Vec3d& v) {
        return std::max(supportOf(normals, v), supportOf(normals, -v));
    };
    if (piece.domain == PatchDomain::quad) {
        for (std::size_t j = 0; j < 4; ++j) {
            for (std::size_t i = 0; i < 2; ++i) {
                uu = std::max(uu, most(2.0 * (du.vectors[3 * j + i + 1] - du.vectors[3 * j + i])));
                vv = std::max(vv, most(2.0 * (dv.vectors[4 * (i + 1) + j] - dv.vectors[4 * i + j])));
            }
        }
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t i = 0; i < 3; ++i) {
                uv = std::max(uv, mixed(3.0 * (du.vectors[3 * (j + 1) + i] - du.vectors[3 * j + i])));
            }
        }
    } else {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t i = 0; i + j < 3; ++i) {
                const std::size_t here = triangleIndex(3, i, j);
                const std::size_t right = triangleIndex(3, i + 1, j);
                const std::size_t above = triangleIndex(3, i, j + 1);
                uu = std::max(uu, most(3.0 * (du.vectors[right] - du.vectors[here])));
                vv = std::max(vv, most(3.0 * (dv.vectors[above] - dv.vectors[here])));
                uv = std::max(uv, mixed(3.0 * (du.vectors[above] - du.vectors[here])));
            }
        }
    }
    return uu <= tolerance && vv <= tolerance && (uv <= tolerance || uu * vv >= uv * uv);
}

}  // namespace fluxwalk::surface
