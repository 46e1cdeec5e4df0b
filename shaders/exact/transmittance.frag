// SPDX-License-Identifier: Apache-2.0
// Fragments that find how much of its light a caster lets through to what is seen. The file "surface" is made from its
// formula, and "pattern", where LUXO_PATTERN says that there is one, from its material's.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/transmittance_fragment.glsl"

void main() { findTransmittance(); }
