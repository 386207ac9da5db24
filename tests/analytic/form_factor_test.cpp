#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "core/transport/exact_form_factor.h"
#include "tests/analytic/closed_forms.h"

namespace fluxwalk {

namespace {

using base::Vec3d;
using transport::pointToDisc;
using transport::pointToPolygon;
using transport::pointToSphere;
using transport::polygonArea;
using transport::polygonCoupling;
namespace cf = closed_forms;
using Polygon = std::vector<Vec3d>;

double formFactor(const Polygon& from, const Polygon& to) {
    return polygonCoupling(from, to) / polygonArea(from);
}

// Rectangle [0,x] x [0,y] at height z, seen from above or, where `down`, from below.
Polygon plate(double x, double y, double z, bool down) {
    Polygon p{{0, 0, z}, {x, 0, z}, {x, y, z}, {0, y, z}};
    if (down) {
        std::reverse(p.begin(), p.end());
    }
    return p;
}

Polygon reversed(Polygon p) {
    std::reverse(p.begin(), p.end());
    return p;
}

// Unit squares on both sides of the x axis, including `degrees`.
std::array<Polygon, 2> wedgeSquares(double degrees) {
    const double angle = degrees * cf::kPi / 180.0;
    const Vec3d slope(0.0, std::cos(angle), std::sin(angle));
    const Vec3d edge(1, 0, 0);
    return {Polygon{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
            Polygon{{0, 0, 0}, slope, slope + edge, edge}};
}

// Irradiance at x from what `emits` says of directions, by the midpoint rule over the hemisphere.
template <class Emits>
double hemisphereSum(const Vec3d& normal, const Emits& emits, int n) {
    const Vec3d helper = std::abs(normal.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d tangent = glm::normalize(glm::cross(normal, helper));
    const Vec3d bitangent = glm::cross(normal, tangent);
    int hits = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double r = std::sqrt((i + 0.5) / n);
            const double phi = 2.0 * cf::kPi * (j + 0.5) / n;
            const Vec3d d =
                r * std::cos(phi) * tangent + r * std::sin(phi) * bitangent + std::sqrt(1.0 - r * r) * normal;
            hits += emits(d) ? 1 : 0;
        }
    }
    return static_cast<double>(hits) / (static_cast<double>(n) * n);
}

}  // namespace

// Check 1 of ALGORITHMS section 4: the closed forms give the published digits.
TEST(ClosedForms, coaxialDiscs) {
    EXPECT_NEAR(cf::coaxialDiscs(1, 1, 1), .381966011, 1e-9);
    EXPECT_NEAR(cf::coaxialDiscs(1, 2, 1), .763932023, 1e-9);
    EXPECT_NEAR(cf::coaxialDiscs(.5, 1, 1), .468871126, 1e-9);
    EXPECT_NEAR(cf::coaxialDiscs(2, 1, 1), .190983006, 1e-9);
    EXPECT_NEAR(cf::coaxialDiscs(1, 1, .1), .904875078, 1e-9);
    EXPECT_NEAR(cf::coaxialDiscs(1, 1, .01), .990049875, 1e-9);
    EXPECT_NEAR(cf::coaxialDiscs(1, 1, 10), .009804864, 1e-9);
}

TEST(ClosedForms, cylinders) {
    struct Row {
        double r2, h, inOut, outIn, outOut, ends;
    };
    for (const Row& row : {Row{2, 1, .46454900, .23227450, .13772861, .62999689},
                           Row{2, 2, .67421206, .33710603, .22848102, .43441295},
                           Row{2, 10, .92851833, .46425916, .42372278, .11201805},
                           Row{1.5, 2, .81659463, .54439642, .19778404, -1}}) {
        const cf::CoaxialCylinders f = cf::coaxialCylinders(1, row.r2, row.h);
        EXPECT_NEAR(f.innerToOuter, row.inOut, 1e-8);
        EXPECT_NEAR(f.outerToInner, row.outIn, 1e-8);
        EXPECT_NEAR(f.outerToOuter, row.outOut, 1e-8);
        if (row.ends > 0) {
            // Of the outer cylinder, by closure.
            EXPECT_NEAR(1.0 - f.outerToInner - f.outerToOuter, row.ends, 2e-8);
        }
    }
    EXPECT_NEAR(cf::coaxialCylinders(1, 2, 1000).outerToOuter, .49921800, 1e-8);
    EXPECT_NEAR(cf::cylinderWallWall(.25), .219223594, 1e-9);
    EXPECT_NEAR(cf::cylinderWallWall(.5), .381966011, 1e-9);
    EXPECT_NEAR(cf::cylinderWallWall(1), .585786438, 1e-9);
    EXPECT_NEAR(cf::cylinderWallWall(2), .763932023, 1e-9);
    EXPECT_NEAR(cf::cylinderBaseBase(.25), .609611797, 1e-9);
    EXPECT_NEAR(cf::cylinderBaseBase(.5), .381966011, 1e-9);
    EXPECT_NEAR(cf::cylinderBaseBase(1), .171572875, 1e-9);
    EXPECT_NEAR(cf::cylinderBaseBase(2), .055728090, 1e-9);
}

TEST(ClosedForms, sphereToDisc) {
    EXPECT_NEAR(cf::sphereDisc(.5, 1), .052786405, 1e-9);
    EXPECT_NEAR(cf::sphereDisc(1, 1), .146446609, 1e-9);
    EXPECT_NEAR(cf::sphereDisc(2, 1), .276393202, 1e-9);
    EXPECT_NEAR(cf::sphereDisc(10, 1), .450248140, 1e-9);
}

TEST(PolygonCoupling, parallelRectangles) {
    struct Row {
        double a, b, c, f;
    };
    for (const Row& row : {Row{1, 1, 1, .199824896}, Row{1, 1, 2, .068589589}, Row{1, 1, .5, .415253284},
                           Row{1, 1, .1, .826994522}, Row{1, 1, .01, .980416603}, Row{1, 1, 10, .003162057},
                           Row{2, 1, 1, .285875385}}) {
        const double f = formFactor(plate(row.a, row.b, 0, false), plate(row.a, row.b, row.c, true));
        EXPECT_NEAR(f, row.f, 1e-8);
        EXPECT_NEAR(f, cf::parallelRectangles(row.a, row.b, row.c), 1e-12);
    }
}

TEST(PolygonCoupling, perpendicularRectangles) {
    struct Row {
        double w, h, l, f;
    };
    for (const Row& row : {Row{1, 1, 1, .200043776}, Row{1, 2, 1, .232852603}, Row{2, 1, 1, .116426301},
                           Row{.5, 1, 1, .292373358}, Row{1, .5, 1, .146186679}, Row{1, 1, 2, .240636006},
                           Row{1, 10, 1, .249209486}}) {
        const Polygon lying{{0, 0, 0}, {row.l, 0, 0}, {row.l, row.w, 0}, {0, row.w, 0}};
        const Polygon standing{{0, 0, 0}, {0, 0, row.h}, {row.l, 0, row.h}, {row.l, 0, 0}};
        EXPECT_NEAR(formFactor(lying, standing), row.f, 1e-8);
        EXPECT_NEAR(formFactor(lying, standing), cf::perpendicularRectangles(row.w, row.h, row.l), 1e-12);
    }
}

TEST(PolygonCoupling, squaresThatShareAnEdge) {
    struct Row {
        double degrees, f;
    };
    for (const Row& row :
         {Row{15, .785176664}, Row{30, .619028323}, Row{45, .483347695}, Row{60, .370905321},
          Row{90, .200043776}, Row{120, .086615001}, Row{135, .048309448}, Row{150, .021345325}}) {
        const auto squares = wedgeSquares(row.degrees);
        EXPECT_NEAR(formFactor(squares[0], squares[1]), row.f, 1e-8) << row.degrees << " degrees";
        EXPECT_NEAR(polygonCoupling(squares[0], squares[1]), polygonCoupling(squares[1], squares[0]), 1e-14);
    }
}

// Check 2: general pairs, one of them concave.
TEST(PolygonCoupling, generalPairs) {
    const Polygon square = plate(1, 1, 0, false);
    const auto expectPair = [](const Polygon& a, const Polygon& b, double ab, double ba) {
        EXPECT_NEAR(formFactor(a, b), ab, 1e-8);
        EXPECT_NEAR(formFactor(b, a), ba, 1e-8);
    };
    expectPair(square, reversed({{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}}), .043327410, .043327410);
    const Polygon triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    expectPair(triangle, reversed({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}), .115049228, .115049228);
    expectPair(square, {{0, 0, 1}, {0, 1, 2}, {1, 0, 1.5}}, .066708258, .088944345);
    expectPair(square, reversed({{2, 0, .5}, {2, 1, .5}, {2.5, 1, 1.5}, {2.5, 0, 1.5}}), .023006147,
               .020577323);
    const Polygon hexagon{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    expectPair(hexagon, plate(1, 1, 1, true), .123975291, .371925874);
}

// Check 3: the rows of a closed cube sum to one.
TEST(PolygonCoupling, cubeRowSum) {
    const std::array<Vec3d, 8> c{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    const std::vector<Polygon> faces{{c[0], c[1], c[2], c[3]}, {c[7], c[6], c[5], c[4]},
                                     {c[0], c[4], c[5], c[1]}, {c[1], c[5], c[6], c[2]},
                                     {c[2], c[6], c[7], c[3]}, {c[3], c[7], c[4], c[0]}};
    for (const Polygon& face : faces) {
        double sum = 0.0;
        for (const Polygon& other : faces) {
            sum += &face == &other ? 0.0 : formFactor(face, other);
        }
        EXPECT_NEAR(sum, 1.0, 1e-12);
    }
}

// A skew tetrahedron: no two edges parallel, every pair shares an edge.
TEST(PolygonCoupling, tetrahedronRowSum) {
    const std::array<Vec3d, 4> c{{{0, 0, 0}, {1, .1, .05}, {.2, .9, -.1}, {.3, .25, .8}}};
    const std::vector<Polygon> faces{
        {c[0], c[1], c[2]}, {c[0], c[3], c[1]}, {c[1], c[3], c[2]}, {c[2], c[3], c[0]}};
    for (const Polygon& face : faces) {
        double sum = 0.0;
        for (const Polygon& other : faces) {
            sum += &face == &other ? 0.0 : formFactor(face, other);
        }
        EXPECT_NEAR(sum, 1.0, 1e-10);
    }
}

// A wall that stands through the floor's middle: half of it lies below, half of the floor behind it.
TEST(PolygonCoupling, clipsWhatLiesBehind) {
    const Polygon floor{{-1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}};
    const Polygon wall{{0, 0, -1}, {0, 1, -1}, {0, 1, 1}, {0, 0, 1}};
    const double expected = cf::perpendicularRectangles(1, 1, 1);
    EXPECT_NEAR(polygonCoupling(floor, wall), expected, 1e-9);
    EXPECT_EQ(polygonCoupling(floor, plate(1, 1, -1, false)), 0.0);
    EXPECT_EQ(polygonCoupling(floor, plate(1, 1, 1, false)), 0.0);
}

// The contour integral against the other route: Lambert's point factor integrated over the receiver.
TEST(PolygonCoupling, agreesWithPointFactors) {
    const Polygon a{{0, 0, 0}, {1.2, .1, 0}, {.9, 1.1, 0}, {.1, .7, 0}};
    const Polygon b{{.5, .2, .9}, {.2, .8, .6}, {1.4, 1.2, .4}};
    const Polygon source = transport::pointToPolygon({.5, .5, 0}, {0, 0, 1}, b) > 0.0 ? b : reversed(b);
    constexpr int kN = 400;
    double sum = 0.0;
    for (int i = 0; i < kN; ++i) {
        for (int j = 0; j < kN; ++j) {
            const double s = (i + .5) / kN;
            const double t = (j + .5) / kN;
            const Vec3d ds = (1 - t) * (a[1] - a[0]) + t * (a[2] - a[3]);
            const Vec3d dt = (1 - s) * (a[3] - a[0]) + s * (a[2] - a[1]);
            const Vec3d x = (1 - t) * ((1 - s) * a[0] + s * a[1]) + t * ((1 - s) * a[3] + s * a[2]);
            sum += glm::length(glm::cross(ds, dt)) * pointToPolygon(x, {0, 0, 1}, source) / (kN * kN);
        }
    }
    EXPECT_NEAR(polygonCoupling(a, source), sum, 2e-6);
}

TEST(PolygonCoupling, farPairsKeepTheirDigits) {
    for (const double distance : {10.0, 100.0, 1000.0}) {
        const double f = formFactor(plate(1, 1, 0, false), plate(1, 1, distance, true));
        // Far field with its first correction: F = A / (pi r2) (1 - A / (3 r2) ...) for unit squares.
        const double far = 1.0 / (cf::kPi * distance * distance) * (1.0 - 2.0 / (3.0 * distance * distance));
        EXPECT_NEAR(f / far, 1.0, 1.0 / std::pow(distance, 4) + 1e-6) << distance;
    }
}

TEST(PointToPolygon, rectangles) {
    struct Row {
        double side, c, f;
    };
    for (const Row& row :
         {Row{1, 1, .138531606}, Row{.5, 3, .008526699}, Row{2, 3, .089421187}, Row{2, 4, .059864118}}) {
        const double f = pointToPolygon({0, 0, 0}, {0, 0, 1}, plate(row.side, row.side, row.c, true));
        EXPECT_NEAR(f, row.f, 1e-9);
        EXPECT_NEAR(f, cf::pointParallelRectangle(row.side, row.side, row.c), 1e-14);
    }
    const Polygon standing = reversed({{0, 1.5, 0}, {.7, 1.5, 0}, {.7, 1.5, 2}, {0, 1.5, 2}});
    EXPECT_NEAR(pointToPolygon({0, 0, 0}, {0, 0, 1}, reversed(standing)),
                cf::pointPerpendicularRectangle(.7, 2, 1.5), 1e-14);
    // The part below the horizon does not count; from behind nothing does.
    const Polygon through = reversed({{0, 1.5, -3}, {.7, 1.5, -3}, {.7, 1.5, 2}, {0, 1.5, 2}});
    EXPECT_NEAR(pointToPolygon({0, 0, 0}, {0, 0, 1}, reversed(through)),
                cf::pointPerpendicularRectangle(.7, 2, 1.5), 1e-14);
    EXPECT_EQ(pointToPolygon({0, 0, 0}, {0, 0, 1}, through), 0.0);
}

TEST(PointToPolygon, infinitePlaneFillsTheSky) {
    const double far = 1e6;
    const Polygon sky = reversed({{-far, -far, 1}, {far, -far, 1}, {far, far, 1}, {-far, far, 1}});
    EXPECT_NEAR(pointToPolygon({0, 0, 0}, {0, 0, 1}, sky), 1.0, 1e-11);
    EXPECT_NEAR(pointToPolygon({0, 0, 0}, {1, 0, 0}, sky), 0.5, 1e-5);
}

TEST(PointToDisc, closedFormsOnEveryOffset) {
    for (const double h : {.01, .1, 1.0, 10.0}) {
        for (const double a : {0.0, 1e-9, .001, .01, .03, .1, .5, 1.0, 2.0, 40.0}) {
            EXPECT_NEAR(pointToDisc({0, 0, 0}, {0, 0, 1}, {a, 0, h}, {0, 0, -1}, 1.0),
                        cf::pointParallelDisc(1, h, a), 3e-13)
                << h << ' ' << a;
        }
    }
    EXPECT_EQ(pointToDisc({0, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, 1.0), 0.0);
}

TEST(PointToDisc, cutByTheHorizon) {
    const Vec3d axis = glm::normalize(Vec3d(-.3, .2, -1));
    for (const Vec3d& center : {Vec3d(.4, .1, .3), Vec3d(.01, 0, .5), Vec3d(-1.5, .3, .2)}) {
        const Vec3d normal = glm::normalize(Vec3d(1, .4, .25));
        const double counted = hemisphereSum(
            normal,
            [&](const Vec3d& d) {
                const double along = glm::dot(d, axis);
                const double t = glm::dot(center, axis) / along;
                return along < 0.0 && t > 0.0 && glm::distance(t * d, center) < .8;
            },
            3000);
        EXPECT_NEAR(pointToDisc({0, 0, 0}, normal, center, axis, .8), counted, 1e-4);
    }
}

TEST(PointToSphere, aboveAcrossAndBelowTheHorizon) {
    EXPECT_NEAR(pointToSphere({0, 0, 0}, {0, 0, 1}, {0, 0, 2}, .5), cf::pointSphere(.5, 2, 0), 1e-15);
    const double tilt = .9;
    EXPECT_NEAR(pointToSphere({0, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)}, {0, 0, 2}, .5),
                cf::pointSphere(.5, 2, tilt), 1e-15);
    for (const double cutTilt : {1.3, 1.5, 1.7, 2.0}) {
        const Vec3d normal(std::sin(cutTilt), 0, std::cos(cutTilt));
        const Vec3d center(0, 0, 1.2);
        const double counted = hemisphereSum(
            normal,
            [&](const Vec3d& d) {
                const double along = glm::dot(center, d);
                return along > 0.0 && glm::length(center - along * d) < 1.0;
            },
            3000);
        EXPECT_NEAR(pointToSphere({0, 0, 0}, normal, center, 1.0), counted, 1e-4);
    }
    EXPECT_EQ(pointToSphere({0, 0, 0}, {0, 0, -1}, {0, 0, 2}, .5), 0.0);
    EXPECT_EQ(pointToSphere({0, 0, 0}, {0, 0, 1}, {0, 0, .2}, .5), 0.0);
}

// Check 6, table 3.3: the disc approximation's known error, which says where it may be used.
TEST(DiscApproximation, errorTable) {
    constexpr std::array<double, 5> kOffsets{0, .5, 1, 2, 4};
    struct Row {
        double h;
        std::array<double, 5> percent;
    };
    for (const Row& row :
         {Row{.1, {0, -96.9, -99.0, -54.8, -17.3}}, Row{.25, {0, -83.2, -93.5, -53.5, -17.1}},
          Row{.5, {0, -53.9, -76.5, -49.3, -16.8}}, Row{1, {0, -18.8, -39.7, -36.9, -15.4}},
          Row{2, {0, -2.9, -9.0, -15.7, -11.2}}, Row{4, {0, -.3, -.9, -2.8, -4.5}}}) {
        for (std::size_t i = 0; i < kOffsets.size(); ++i) {
            const double a = kOffsets[i];
            const double r2 = row.h * row.h + a * a;
            const double cosine = row.h / std::sqrt(r2);
            const double approximate = cf::kPi * cosine * cosine / (cf::kPi * r2 + cf::kPi);
            const double exact = pointToDisc({0, 0, 0}, {0, 0, 1}, {a, 0, row.h}, {0, 0, -1}, 1.0);
            EXPECT_NEAR(100.0 * (approximate / exact - 1.0), row.percent[i], .1) << row.h << ' ' << a;
        }
    }
}

}  // namespace fluxwalk
