// SPDX-License-Identifier: Apache-2.0
// The footprint, and where it is asked for the frame, of a fragment of triangles, or, with LUXO_BY_RAYS, of a point that a
// ray has found: from there.
#include "lib/surface_fragment.glsl"

layout(location = kLocationDetail) sample in vec3 inDetail;

vec2 foundParameters() { return inDetail.xy; }

#ifdef LUXO_BY_RAYS
layout(location = kLocationFootprint) flat in vec4 inFootprint;
vec4 pixelFootprint() { return inFootprint; }
#else
#include "lib/mesh_footprint.glsl"
vec4 pixelFootprint() { return footprintOnTriangle(inPosition, inDetail.xy); }
#endif
#if defined(LUXO_FRAMED) || defined(LUXO_FINDS_FRAME)
#include "lib/mesh_frame.glsl"
#endif
