#include "viewer/ui/body_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/photometry.h"

namespace fluxwalk::ui {
namespace {

using base::Vec3d;

/// Kept from walls, metres for each metre of radius.
constexpr double kSkin = 0.04;
/// Heights at which level rays leave the torso, from its lower end to the eyes.
constexpr int kHeights = 6;
/// Directions in which rays leave the axis' front half, on its rim; the last leaves 3 % of the width.
constexpr std::array<double, 7> kRimDegrees{-76.0, -51.0, -25.5, 0.0, 25.5, 51.0, 76.0};
/// Where uprights find what lies between two level rays: table tops, handrails.
constexpr std::array<double, 3> kUprightDegrees{-51.0, 0.0, 51.0};
/// Above the underside of such a thing, metres.
constexpr double kAboveUnderside = 0.01;
/// Level part of a normal from which it says where a thing ends.
constexpr double kSteep = 0.1;
/// Cosine below which a wall is passed along, not run into.
constexpr double kParallel = 1e-6;
/// Walls that a step is led along one after the other.
constexpr int kMostWalls = 3;

struct Contact {
    double distance = 0.0;
    Vec3d normal{0.0};  ///< unit, towards where the ray came from
};

std::optional<Contact> contactAlong(const Walls& walls, const Vec3d& from, const Vec3d& direction,
                                    double far) {
    const auto hit =
        walls.rays->closest({base::Vec3(from), 0.0f, base::Vec3(direction), static_cast<float>(far)});
    if (!hit) {
        return std::nullopt;
    }
    const auto t = static_cast<double>(hit->t);
    const surface::Surface& surface = *walls.scene->objects[base::index(hit->object)].surface;
    const Vec3d point = from + t * direction;
    const Vec3d normal = surface.evaluate(hit->patch, surface.locate(hit->patch, point)).normal;
    return Contact{t, glm::dot(normal, direction) > 0.0 ? -normal : normal};
}

/// The nearest thing in the way of a step.
struct Obstacle {
    double free = 0.0;  ///< part of the step's length that is left before it, metres
    Vec3d normal{0.0};  ///< level, unit
};

class Sweep {
  public:
    Sweep(const Walls& walls, const Torso& torso, const Vec3d& step)
        : walls_(walls), torso_(torso), length_(glm::length(step)), ahead_(step / length_) {
        right_ = Vec3d(-ahead_.z, 0.0, ahead_.x);
        nearest_.free = length_;
    }

    /// Nothing where the whole step is free.
    std::optional<Obstacle> find() {
        for (int i = 0; i < kHeights; ++i) {
            scanLevel(torso_.low + (torso_.eye.y - torso_.low) * i / (kHeights - 1));
        }
        for (const double degrees : kUprightDegrees) {
            scanUpright(degrees * base::kPi / 180.0);
        }
        return isHit_ ? std::optional(nearest_) : std::nullopt;
    }

  private:
    Vec3d axisAt(double height) const { return {torso_.eye.x, height, torso_.eye.z}; }

    /// `normal` need not be level. What faces away is not in the way.
    void take(double free, const Vec3d& normal) {
        const Vec3d level(normal.x, 0.0, normal.z);
        const double length = glm::length(level);
        const Vec3d facing = length > kSteep ? level / length : -ahead_;
        if (free < nearest_.free && glm::dot(facing, ahead_) < -kParallel) {
            isHit_ = true;
            nearest_ = {std::max(0.0, free), facing};
        }
    }

    void scanLevel(double height) {
        const Vec3d axis = axisAt(height);
        const double skin = kSkin * torso_.radius;
        const double far = torso_.radius + length_ + skin;
        // Rays must not leave from behind a wall at the side.
        const double toRight = distanceAlong(walls_, axis, right_, torso_.radius).value_or(torso_.radius);
        const double toLeft = distanceAlong(walls_, axis, -right_, torso_.radius).value_or(torso_.radius);
        for (const double degrees : kRimDegrees) {
            const double angle = degrees * base::kPi / 180.0;
            const double aside = torso_.radius * std::sin(angle);
            if (aside > toRight - skin || -aside > toLeft - skin) {
                continue;
            }
            if (const auto contact = contactAlong(walls_, axis + aside * right_, ahead_, far)) {
                take(contact->distance - torso_.radius * std::cos(angle) - skin, contact->normal);
            }
        }
    }

    void scanUpright(double angle) {
        const Vec3d rim = torso_.radius * (std::cos(angle) * ahead_ + std::sin(angle) * right_);
        const Vec3d toFoot = rim + nearest_.free * ahead_;
        const double reach = glm::length(toFoot);
        const Vec3d axis = axisAt(torso_.low);
        if (reach <= 0.0 || distanceAlong(walls_, axis, toFoot / reach, reach)) {
            return;
        }
        const double top = torso_.eye.y + 0.5 * torso_.clearance;
        const auto above = contactAlong(walls_, axis + toFoot, {0.0, 1.0, 0.0}, top - torso_.low);
        if (!above) {
            return;
        }
        const double height = torso_.low + above->distance + kAboveUnderside;
        const double before = nearest_.free;
        if (height < torso_.eye.y) {
            scanLevel(height);
        }
        if (nearest_.free < before) {
            return;
        }
        // It stands beside the body already, or has no edge: a flight of stairs from below.
        const Vec3d outwards = toFoot / reach;
        const auto edge = contactAlong(walls_, axisAt(std::min(height, torso_.eye.y)), outwards, reach);
        const Vec3d& normal = edge ? edge->normal : above->normal;
        const Vec3d level(normal.x, 0.0, normal.z);
        take(0.0, glm::length(level) > kSteep ? level : -outwards);
    }

    const Walls& walls_;
    const Torso& torso_;
    double length_;
    Vec3d ahead_;
    Vec3d right_{0.0};
    Obstacle nearest_;
    bool isHit_ = false;
};

}  // namespace

std::optional<double> distanceAlong(const Walls& walls, const Vec3d& from, const Vec3d& direction,
                                    double far) {
    const auto hit =
        walls.rays->closest({base::Vec3(from), 0.0f, base::Vec3(direction), static_cast<float>(far)});
    return hit ? std::optional(static_cast<double>(hit->t)) : std::nullopt;
}

Vec3d slide(const Walls& walls, const Torso& torso, const Vec3d& step) {
    Torso moving = torso;
    Vec3d rest = step;
    for (int i = 0; i < kMostWalls; ++i) {
        const double length = glm::length(rest);
        if (length < 1e-6 || glm::dot(rest, step) <= 0.0) {
            break;
        }
        const auto obstacle = Sweep(walls, moving, rest).find();
        if (!obstacle) {
            moving.eye += rest;
            break;
        }
        const Vec3d taken = rest * (obstacle->free / length);
        moving.eye += taken;
        rest -= taken;
        rest -= obstacle->normal * std::min(0.0, glm::dot(rest, obstacle->normal));
    }
    return moving.eye - torso.eye;
}

}  // namespace fluxwalk::ui
