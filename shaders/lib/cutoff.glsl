// SPDX-License-Identifier: Apache-2.0
// What is cut out of a surface by its opacity: where that is less than the least that is opaque (scene/material.h, 0: nothing
// is cut out) there is a hole, and all else is opaque.
#ifndef LUXO_LIB_CUTOFF_GLSL
#define LUXO_LIB_CUTOFF_GLSL

float cutOut(float opacity, float least) { return least == 0.0 ? opacity : opacity >= least ? 1.0 : 0.0; }
#endif
