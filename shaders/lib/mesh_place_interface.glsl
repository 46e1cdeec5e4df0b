// SPDX-License-Identifier: Apache-2.0
// What a draw of places on a mesh's surface tells its fragments: the pixel's place, and the surface; the same all over the
// target.
#ifndef LUXO_LIB_MESH_PLACE_INTERFACE_GLSL
#define LUXO_LIB_MESH_PLACE_INTERFACE_GLSL
#include "lib/place_interface.glsl"

layout(location = 7) flat LUXO_VARYING vec3 varyingRelative[4];  // columns of relativeFromObject, and the translation
layout(location = 11) flat LUXO_VARYING uvec4 varyingFirst;      // -, patch, parameter; parameters of each patch
layout(location = 12) flat LUXO_VARYING uvec2 varyingNode;       // patches; material

#ifdef LUXO_VERTEX
layout(scalar, set = kSetShadow, binding = kBindingMeshPlaces) readonly buffer MeshPlaces { MeshPlace meshPlaces[]; };
#endif
#endif
