// SPDX-License-Identifier: Apache-2.0
// Whether casters that are known as equations keep their light from the point that a pixel sees.
#extension GL_GOOGLE_include_directive : require
#include "lib/closed_test.glsl"
#include "lib/found_place.glsl"

layout(location = 0) out uint outShadows;

void findShadows() {
  FoundPlace found = foundPlace();
  bool isOpen;
  uint shadows = closedShadowsAt(found.position, found.normal, litAt(found.drawn, found.drawnNormal), found.depth,
                                 found.material, isOpen);
  if (isOpen) doubtPixel();
  if (shadows == 0) discard;
  outShadows = shadows;
}
