#include "core/transport/contact_visibility.h"

#include <array>
#include <cmath>
#include <optional>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/hierarchy/local_frame.h"
#include "core/transport/element_sampler.h"

namespace fluxwalk::transport {

namespace {

using base::Vec2d;

/// Most directions tried from both ends, and bundles that their rays are traced in. Touching elements of one
/// size meet some 5 to 20 % of them.
constexpr unsigned kTries = 8192;
/// Rays after which the share is well known.
constexpr double kEnough = 1024.0;
constexpr unsigned kBundle = 64;

/// Steps of the four-dimensional sequence of M. Roberts (2018): powers of 1/x, x^5 = x + 1.
constexpr std::array<double, 4> kSteps{0.8566748838545029, 0.733891856627126, 0.6287067210378087,
                                       0.5385972572236101};

constexpr std::size_t kTurns = 2048;

const std::array<Vec2d, kTurns>& unitCircle() {
    static const std::array<Vec2d, kTurns> kPoints = [] {
        std::array<Vec2d, kTurns> points;
        for (std::size_t i = 0; i < kTurns; ++i) {
            const double angle = 2.0 * base::kPi * (static_cast<double>(i) + 0.5) / kTurns;
            points[i] = {std::cos(angle), std::sin(angle)};
        }
        return points;
    }();
    return kPoints;
}

/// A planar element as what a line may meet.
class Target {
  public:
    explicit Target(const hierarchy::Shape& shape)
        : normal_(shape.axis), cells_(shape.exposedCells), count_(shape.cornerCount) {
        for (unsigned i = 0; i < count_; ++i) {
            corners_[i] = Vec3d(shape.corners[i]);
        }
        const Vec3d side = glm::normalize(corners_[1] - corners_[0]);
        x_ = side;
        y_ = glm::cross(normal_, side);
        for (unsigned i = 0; i < count_; ++i) {
            flat_[i] = flatten(corners_[i]);
        }
    }

    const Vec3d& normal() const { return normal_; }

    /// Where the half-line meets the front of its exposed part.
    std::optional<Vec3d> meet(const Vec3d& origin, const Vec3d& direction, bool isBack) const {
        const double facing = glm::dot(direction, normal_);
        const double height = glm::dot(corners_[0] - origin, normal_);
        if (!(facing < 0.0) || !(height < 0.0)) {
            return std::nullopt;
        }
        const Vec3d point = origin + (height / facing) * direction;
        const Vec2d p = flatten(point);
        for (unsigned i = 0; i < count_; ++i) {
            const Vec2d& from = flat_[i];
            const Vec2d edge = flat_[(i + 1) % count_] - from;
            const Vec2d to = p - from;
            if (edge.x * to.y - edge.y * to.x < 0.0) {
                return std::nullopt;
            }
        }
        return cells_ == 0xffff || isExposed(p, isBack) ? std::optional(point) : std::nullopt;
    }

  private:
    Vec2d flatten(const Vec3d& p) const {
        const Vec3d d = p - corners_[0];
        return {glm::dot(d, x_), glm::dot(d, y_)};
    }

    // The cell of the region's unit square (ElementSampler::at, the other way round).
    bool isExposed(const Vec2d& p, bool isBack) const {
        double s = 0.0;
        double t = 0.0;
        const auto cross = [](const Vec2d& u, const Vec2d& v) { return u.x * v.y - u.y * v.x; };
        if (count_ == 3) {
            const double whole = cross(flat_[1], flat_[2]);
            const double first = cross(p, flat_[2]) / whole;
            const double second = cross(flat_[1], p) / whole;
            const double root = 1.0 - first;
            s = root * root;
            t = root > 0.0 ? second / root : 0.0;
        } else {
            // p = s e + t f + s t g: t solves a quadratic equation.
            const Vec2d& e = flat_[1];
            const Vec2d& f = flat_[3];
            const Vec2d g = flat_[2] - flat_[1] - flat_[3];
            const double square = -cross(f, g);
            const double linear = cross(p, g) - cross(f, e);
            const double constant = cross(p, e);
            const double root = std::sqrt(std::max(0.0, linear * linear - 4.0 * square * constant));
            const double half = -0.5 * (linear + std::copysign(root, linear));
            t = constant / half;
            if (std::abs(square) > 1e-12 * std::abs(linear) && !(t >= 0.0 && t <= 1.0)) {
                t = half / square;
            }
            const Vec2d along = e + t * g;
            s = glm::dot(p - t * f, along) / glm::dot(along, along);
        }
        t = isBack ? 1.0 - t : t;
        const auto cell = [](double x) {
            return static_cast<unsigned>(std::min(3.0, std::max(0.0, 4.0 * x)));
        };
        return (cells_ >> (4 * cell(t) + cell(s)) & 1u) != 0;
    }

    Vec3d normal_;
    std::uint16_t cells_;
    unsigned count_;
    std::array<Vec3d, 4> corners_{};
    Vec3d x_{};
    Vec3d y_{};
    std::array<Vec2d, 4> flat_{};
};

/// Directions from one end, and where on it they start.
struct EndSums {
    double sent = 0.0;
    double seen = 0.0;
    Vec2d sentMoment{0.0};
    Vec2d seenMoment{0.0};

    void add(double weight, bool isSeen, const Vec2d& local) {
        sent += weight;
        sentMoment += weight * local;
        if (isSeen) {
            seen += weight;
            seenMoment += weight * local;
        }
    }
    /// Gradient of the seen kernel less that of the kernel, relative to their means (Stage in
    /// visibility.cpp).
    Vec2d shadowGradient(const hierarchy::LocalFrame& frame) const {
        return seen > 0.0 ? hierarchy::gradientOfMoment(frame, seenMoment / seen - sentMoment / sent)
                          : Vec2d(0.0);
    }
};

}  // namespace

ContactSample sampleContact(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays, NodeId a,
                            NodeId b, double coupling, std::uint64_t key) {
    ContactSample sample;
    std::array<rays::Ray, kBundle> bundle;
    std::array<double, kBundle> weights{};
    std::array<Vec2d, kBundle> locals;
    std::array<std::uint8_t, kBundle> blocked{};
    unsigned used = 0;
    EndSums sums;
    const auto trace = [&] {
        rays.occluded(std::span(bundle.data(), used), std::span(blocked.data(), used));
        for (unsigned i = 0; i < used; ++i) {
            sums.add(weights[i], blocked[i] == 0, locals[i]);
        }
        sample.rays += used;
        used = 0;
    };
    const double areaA = static_cast<double>(hierarchy.shape(a).sampledArea());
    const double areaB = static_cast<double>(hierarchy.shape(b).sampledArea());
    // Of the tries from both ends, 2 g / (A_a + A_b) meet the other.
    const double all = std::min<double>(kTries, kEnough * 0.5 * (areaA + areaB) / coupling);
    for (const bool isSwapped : {false, true}) {
        const NodeId from = isSwapped ? b : a;
        const NodeId to = isSwapped ? a : b;
        const ElementSampler sampler(hierarchy, from);
        const Target target(hierarchy.shape(to));
        const bool isBack = hierarchy.name(to).back;
        const Vec3d normal = Vec3d(hierarchy.shape(from).axis);
        const Vec3d side =
            glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.7 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1)));
        const Vec3d other = glm::cross(normal, side);
        // As many tries for each m2, so that both ends' counts can be added.
        const auto tries =
            static_cast<unsigned>(std::lround(all * (isSwapped ? areaB : areaA) / (areaA + areaB)));
        base::RandomStream random(base::combine(key, isSwapped ? 1 : 0));
        std::array<double, 4> x{random.next(), random.next(), random.next(), random.next()};
        for (unsigned i = 0; i < tries; ++i) {
            for (unsigned k = 0; k < 4; ++k) {
                x[k] += kSteps[k];
                x[k] -= x[k] >= 1.0 ? 1.0 : 0.0;
            }
            const SurfaceSample p = sampler.inExposed({x[0], x[1]});
            const double sine = std::sqrt(x[2]);
            const Vec2d& around = unitCircle()[static_cast<std::size_t>(x[3] * kTurns)];
            const Vec3d direction =
                sine * (around.x * side + around.y * other) + std::sqrt(1.0 - x[2]) * normal;
            if (const auto q = target.meet(p.position, direction, isBack)) {
                weights[used] = p.measure;
                locals[used] = p.local;
                bundle[used++] = rays.segment(p.position, p.normal, *q, target.normal());
                if (used == kBundle) {
                    trace();
                }
            }
        }
        trace();
        sample.sent += sums.sent;
        sample.seen += sums.seen;
        (isSwapped ? sample.gradientB : sample.gradientA) =
            sums.shadowGradient(hierarchy::localFrame(hierarchy.shape(from).cornerCount));
        sums = {};
    }
    return sample;
}

}  // namespace fluxwalk::transport
