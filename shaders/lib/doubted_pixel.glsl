// SPDX-License-Identifier: Apache-2.0
// The bit of a pixel where what light reaches it is open.
#include "lib/place_interface.glsl"

// Nothing is found in shadow where nothing is found: without this, what writes to buffers runs there first.
layout(early_fragment_tests) in;

layout(scalar, set = kSetShadow, binding = kBindingShadowDoubts) buffer Doubts { uint ofPixels[]; } doubts;

uint pixelNumber() { return uint(gl_FragCoord.y) * uint(2.0 * varyingMiddle.x) + uint(gl_FragCoord.x); }

void doubtPixel() {
  uint pixel = pixelNumber();
  atomicOr(doubts.ofPixels[pixel / kDoubtsPerWord], kShadowOpenHere << kDoubtBits * (pixel % kDoubtsPerWord));
}
