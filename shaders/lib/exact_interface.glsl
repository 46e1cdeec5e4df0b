// SPDX-License-Identifier: Apache-2.0
// What the vertices of a hull tell its fragments: all but the start of the search is the same all over a triangle.
#include "lib/lights.glsl"
#include "shared/scene_data.h"

#ifdef LUXO_VERTEX
#define LUXO_LINK out
#else
#define LUXO_LINK in
#endif

// Parameters of the formula beyond these are read from their buffer, which takes a CPU device longer.
const uint kCarriedParameters = 28;

layout(location = 0) sample LUXO_LINK vec2 linkStart;             // u, v
layout(location = 1) flat LUXO_LINK vec4 linkAmbientShininess;
layout(location = 2) flat LUXO_LINK vec4 linkDiffuseOpacity;
layout(location = 3) flat LUXO_LINK vec4 linkSpecularTolerance;
layout(location = 4) flat LUXO_LINK uvec4 linkFlags;              // InstanceData: flags, id, firstPatternParameter; its index
layout(location = 5) flat LUXO_LINK vec4 linkViewer;             // w = 1: perspective
layout(location = 6) flat LUXO_LINK vec4 linkLights[2 * kCarriedLights];
layout(location = 10) flat LUXO_LINK vec4 linkShades[2 * kCarriedShades];
layout(location = 12) flat LUXO_LINK vec4 linkX;
layout(location = 13) flat LUXO_LINK vec4 linkY;
layout(location = 14) flat LUXO_LINK vec4 linkDepth;
layout(location = 15) flat LUXO_LINK vec4 linkRelative[3];        // columns of relativeFromObject and the translation
layout(location = 18) flat LUXO_LINK vec4 linkDomain;
layout(location = 19) flat LUXO_LINK vec4 linkCellHalf;           // extent of the cells in u and v; half the picture
layout(location = 20) flat LUXO_LINK vec4 linkPolesWraps;
layout(location = 21) flat LUXO_LINK vec4 linkSides;              // see wantedSide(); above 0: the front, twice that: poles are edges of u; second derivatives; firstParameter
layout(location = 22) flat LUXO_LINK vec4 linkClip;               // clipDepth; thickness; slot of the tally
layout(location = 23) flat LUXO_LINK vec4 linkParameters[kCarriedParameters / 4];
