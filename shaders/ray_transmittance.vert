// SPDX-License-Identifier: Apache-2.0
// How much of a light rays have found to get through its casters in a pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/around_place.glsl"

layout(location = kAttributeShadowPlace) in vec2 inPlace;
layout(location = kAttributeTransmittance) in vec3 inTransmittance;

layout(location = kLocationTransmittance) flat out vec3 outTransmittance;

void main() {
  outTransmittance = inTransmittance;
  gl_Position = aroundPlace(inPlace, 0.0);
}
