// SPDX-License-Identifier: Apache-2.0
// All that is seen through in a pixel, over what is not: nearest first, whatever the order in which it was found.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layer_order.glsl"
#include "lib/number.glsl"

layout(location = 0, index = 0) out vec4 outLight;
layout(location = 0, index = 1) out vec4 outThrough;

void main() {
  if (!isInPicture()) return;
  uint head = firstLayer();
  if (head == 0) discard;
  vec3 light = vec3(0), through = vec3(1);
  for (uint index = head; index != 0; index = layerPoints[index].next) {
    LayerPoint point = layerPoints[index];
    if (!isAnother(point)) continue;
    if (isColor(point.light)) {
      light += through * point.light;
      through *= point.through;
    } else if (through != vec3(0)) {  // what a shader tells instead of a colour stays as it is
      light = point.light;
      through = vec3(0);
    }
  }
  endLayers();
  outLight = vec4(light, 0);
  outThrough = vec4(through, 1);
}
