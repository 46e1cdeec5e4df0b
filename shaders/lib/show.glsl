// SPDX-License-Identifier: Apache-2.0
// What a fragment shows of a found point: its light, with an alpha, or all that lights it later.
#include "lib/found_texel.glsl"
#include "lib/quantity.glsl"

layout(location = 0) out vec4 outColor;
#ifdef LUXO_FINDS_PARAMETERS
layout(location = 1) out vec2 outParameters;
#endif
#ifdef LUXO_FINDS_FOOTPRINT
layout(location = 2) out vec4 outFootprint;
#endif
#ifdef LUXO_FINDS_FRAME
layout(location = 3) out vec4 outFrame;
#endif

void show(Found found, float alpha) {
  if (kQuantity == kFoundTexel) {
    outColor = foundTexel(found, foundMaterialNumber());
#ifdef LUXO_FINDS_PARAMETERS
    vec4 bounds = patternBounds();
    outParameters = clamp(found.parameters, bounds.xy, bounds.zw);
#endif
#ifdef LUXO_FINDS_FOOTPRINT
    outFootprint = pixelFootprint();
#endif
#ifdef LUXO_FINDS_FRAME
    outFrame = normalFrame();
#endif
  } else {
    outColor = vec4(lit(found), alpha);
  }
}
