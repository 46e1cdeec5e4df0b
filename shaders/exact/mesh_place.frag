// SPDX-License-Identifier: Apache-2.0
// Fragments that find which point of its surface a mesh shows. The file "surface" is made from its formula.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/mesh_place_fragment.glsl"

void main() { findPlace(); }
