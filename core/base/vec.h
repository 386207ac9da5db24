#pragma once

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

/// Vectors and colours. Storage is float, geometry that feeds form factors is double.
namespace fluxwalk::base {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Vec2d = glm::dvec2;
using Vec3d = glm::dvec3;
using Mat4d = glm::dmat4;

/// Linear Rec.709 colour; each channel carries its own lumens (see photometry.h).
using Rgb = glm::vec3;

}  // namespace fluxwalk::base
