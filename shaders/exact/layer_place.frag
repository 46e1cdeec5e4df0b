// SPDX-License-Identifier: Apache-2.0
// Fragments that find which points of its surface a mesh shows that is seen through. The file "surface" is made from its
// formula.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layer_place_fragment.glsl"

void main() { findPlaces(); }
