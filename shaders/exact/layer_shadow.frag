// SPDX-License-Identifier: Apache-2.0
// Fragments that find whether a caster keeps its light from what is seen through. The file "surface" is made from its formula.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layer_shadow_fragment.glsl"

void main() { findLayerShadows(); }
