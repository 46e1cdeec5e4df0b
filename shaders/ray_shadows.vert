// SPDX-License-Identifier: Apache-2.0
// What rays have found of the shadows in a pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/around_place.glsl"

layout(location = kAttributeShadowPlace) in vec2 inPlace;
layout(location = kAttributeShadows) in uint inShadows;

layout(location = kLocationShadows) flat out uint outShadows;

void main() {
  outShadows = inShadows;
  gl_Position = aroundPlace(inPlace, 0.0);
}
