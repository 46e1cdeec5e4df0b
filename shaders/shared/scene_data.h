// SPDX-License-Identifier: Apache-2.0
// What the CPU hands to the scene shaders: one definition for C++ and GLSL, scalar block layout.
// Positions are in metres relative to the eye with the axes of the world; directions have the axes of the world.
#ifndef LUXO_SHARED_SCENE_DATA_H
#define LUXO_SHARED_SCENE_DATA_H

#ifdef __cplusplus
#include <cstdint>

#include "math/vec.h"
namespace luxo::shared {
using vec2 = Vec2f;
using vec3 = Vec3f;
using vec4 = Vec4f;
using mat3 = Mat3f;
using mat4 = Mat4f;
using uint = std::uint32_t;
#define LUXO_CONSTANT inline constexpr uint
#else
#extension GL_EXT_scalar_block_layout : require
#define LUXO_CONSTANT const uint
#endif

// Bindings of descriptor set 0.
LUXO_CONSTANT kBindingView = 0;
LUXO_CONSTANT kBindingInstances = 1;
LUXO_CONSTANT kBindingLights = 2;  // dynamic offset: the set of lights that reach the draw

LUXO_CONSTANT kMostLights = 32;  // that may reach one object

// Instance flags.
LUXO_CONSTANT kTwoSided = 1;         // the normal turns toward the viewer
LUXO_CONSTANT kLectureSpecular = 2;  // the highlight is not gated by N.L > 0
LUXO_CONSTANT kPatternAmbient = 4;   // the ambient colour is the pattern's, times InstanceData::ambient
LUXO_CONSTANT kPlane = 8;            // all in one plane
LUXO_CONSTANT kShadeShift = 8;  // bits from here: 1 + index, in the light set, of the shaded light this node is the shade of

struct ViewData {
  mat4 clipFromRelative;
  vec4 viewer;        // w = 1: the eye, at the origin; w = 0: the unit direction toward an orthographic viewer
  vec3 forward;       // unit view direction
  vec2 depthRange;    // nearest and farthest depth in the picture, for the depth view
};

struct InstanceData {
  mat3 relativeFromObject;
  vec3 translation;
  mat3 normalFromObject;  // cofactor matrix, largest entry 1; unit length is restored per vertex
  vec3 ambient;           // ka * La: already multiplied by the scene's ambient light
  vec3 diffuse;
  vec3 specular;
  float shininess;
  float opacity;
  uint flags;
  uint id;      // the node's number in file order, from 1
  vec4 domain;  // u and v at the lower corner, width in u and v
  uint firstPatternParameter;  // of the material's pattern, in the buffer of them all
};

struct LightData {
  vec4 position;  // w = 1: a point; w = 0: the unit direction toward a light at infinity
  vec3 radiance;  // color * intensity
  uint inverseSquare;
};

// The shade of a light in its focus: what is lit is known in closed form.
struct ShadeData {
  vec3 axis;  // unit, from the vertex through the focus out of the opening
  float cosRim;
  float reach;  // points nearer to the focus than `reach` more than they are along the axis are inside the shade
};

struct LightSet {
  LightData lights[kMostLights];  // the shaded ones last
  ShadeData shades[kMostLights];  // of the shaded ones, in their order
};

#ifdef __cplusplus
#undef LUXO_CONSTANT
static_assert(sizeof(ViewData) == 100 && sizeof(InstanceData) == 156 && sizeof(LightData) == 32 && sizeof(ShadeData) == 20);
}  // namespace luxo::shared
#endif
#endif
