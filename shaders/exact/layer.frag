// SPDX-License-Identifier: Apache-2.0
// Fragments that find all points of a surface that is seen through. The file "surface" is made from its formula.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layer_fragment.glsl"

void main() { findLayers(); }
