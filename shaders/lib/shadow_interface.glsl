// SPDX-License-Identifier: Apache-2.0
// What a draw of shadows tells its fragments: the pixel's place, and the caster; the same all over the target.
#ifndef LUXO_LIB_SHADOW_INTERFACE_GLSL
#define LUXO_LIB_SHADOW_INTERFACE_GLSL
#include "lib/place_interface.glsl"

layout(location = 7) flat LUXO_VARYING vec4 varyingGrid[3];   // rows: of gridFromRelative, and the origin
layout(location = 10) flat LUXO_VARYING vec4 varyingObject[3];
layout(location = 13) flat LUXO_VARYING vec4 varyingLightObject;
layout(location = 14) flat LUXO_VARYING vec4 varyingLightRelative;
layout(location = 15) flat LUXO_VARYING vec4 varyingRounding;  // once; for each metre; margin; a pixel's width
layout(location = 16) flat LUXO_VARYING uvec4 varyingFirst;    // entry, cell, parameter; parameters of each patch
layout(location = 17) flat LUXO_VARYING uvec4 varyingCaster;   // its index; the light's bit; flags; grid size
layout(location = 18) flat LUXO_VARYING vec4 varyingPlane;
layout(location = 19) flat LUXO_VARYING vec2 varyingOff;  // pixels; the least opacity that is opaque, or 0
layout(location = 20) flat LUXO_VARYING uvec2 varyingMaterial;  // of found texels; the first parameter of its pattern
layout(location = 21) flat LUXO_VARYING vec4 varyingFaces[6];  // a device reads a buffer more slowly
layout(location = 27) flat LUXO_VARYING uvec3 varyingFirstTexels[2];  // of the faces along +, of those along -
layout(location = 29) flat LUXO_VARYING vec4 varyingPaint;  // diffuse colour, opacity

#ifdef LUXO_VERTEX
layout(scalar, set = kSetShadow, binding = kBindingCasters) readonly buffer Casters { ShadowCaster casters[]; };
#endif
#endif
