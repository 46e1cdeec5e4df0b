// SPDX-License-Identifier: Apache-2.0
// The light on a point of a material that is the same all over.
#extension GL_GOOGLE_include_directive : require
#include "lib/found.glsl"

vec3 lit(Found found) { return illuminated(foundMaterial(), found.position, found.normal, found.viewer); }
