// SPDX-License-Identifier: Apache-2.0
// What whoever finds a point knows of the surface around it, for patterns, maps and shaders: a part of lib/found.glsl. They
// ask the same where nothing is found, of casters and of light between vertices.
#ifndef LUXO_LIB_FOUND_AROUND_GLSL
#define LUXO_LIB_FOUND_AROUND_GLSL

// How u and v move from a pixel to the next: u, v to the right, u, v below.
vec4 pixelFootprint();

// The tangent, and the sign of the bitangent w * cross(normal, tangent), of the side that is shown.
vec4 normalFrame();

// Lowest and highest u and v inside the surface: rounding must not lead across the end of the domain, where a pattern may
// jump.
vec4 patternBounds();

#endif
