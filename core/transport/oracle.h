#pragma once

#include <cstdint>

#include "core/transport/kernel_bounds.h"

namespace fluxwalk::transport {

/// Decides which links are refined (ALGORITHMS 1.3).
enum class OracleKind : std::uint8_t {
    bounded,  ///< spread of kernel, visibility and radiosity, weighed by power (Schaefer section 1;
              ///< Lischinski et al. 1994)
    bfa,      ///< B F A: the transferred power itself (Hanrahan et al. 1991)
    bf,       ///< B F: the transferred irradiance itself
    strict    ///< certain bounds of kernel, visibility and radiosity, by power; samples narrow none of them
};

/// What is known of a pair's exchange; radiosities are channel means in lm/m2.
struct LinkBounds {
    float coupling = 0.0f;         ///< m2
    float visibility = 1.0f;       ///< estimate
    float visibilityUpper = 1.0f;  ///< what it can be at most, given the rays
    bool isMixed = false;          ///< partly visible
    float spreadA = 0.0f;          ///< of the kernel over a, relative
    float spreadB = 0.0f;
    float curvatureA = 0.0f;  ///< spread that the cone of normals of a implies, weighted
    float curvatureB = 0.0f;
    float radiosityA = 0.0f;
    float radiosityB = 0.0f;
    float residualA = 0.0f;  ///< largest deviation of the radiosity from a linear function over the node
    float residualB = 0.0f;
    float rangeA = 0.0f;  ///< half the range of the radiosity over the node
    float rangeB = 0.0f;
    float areaA = 1.0f;
    float areaB = 1.0f;
    float radiusA = 1.0f;
    float radiusB = 1.0f;
    float distance = 1.0f;  ///< between the centres
    /// Of strict: what F(x<-b) over a and F(x<-a) over b lie between, and whether all of it is certainly
    /// seen.
    FactorBounds factorA{};
    FactorBounds factorB{};
    bool isOpen = false;
    float sceneArea = 1.0f;
    bool isCluster = false;  ///< one end or both
};

/// How far the cosine over an element whose normals lie within `halfAngle` of an axis, which is turned by
/// `angle` from the direction of the light (both in radians, below pi), is from a linear function: relative
/// to its mean. 2 tan2(halfAngle / 2) while the light is above all horizons, more where the element turns
/// away from it; 0 on planar elements. (Schaefer, section 1; ALGORITHMS 1.3 f.)
float boundCurvature(float angle, float halfAngle);

struct LinkAssessment {
    /// In lux: bf of the receiver, else power spread over the scene's area; of the direction that is worse.
    float error = 0.0f;
    /// Which end promises more if it is split.
    bool splitA = true;
};

/// The one interface of all oracles, over the same bounds.
LinkAssessment assess(OracleKind oracle, const LinkBounds& link);

/// What is known of an element's exchange with itself.
struct SelfBounds {
    float area = 0.0f;       ///< m2
    float halfAngle = 0.0f;  ///< of the cone of normals, radians
    float radiosity = 0.0f;  ///< channel mean, lm/m2
    float sceneArea = 1.0f;
};

/// The same error, from the most that the cone of normals lets an element see of itself.
float assessSelf(OracleKind oracle, const SelfBounds& self);

}  // namespace fluxwalk::transport
