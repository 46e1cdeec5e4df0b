// SPDX-License-Identifier: Apache-2.0
// Of a caster that lets no light through any meeting is a shadow.
#include "lib/shadow_test.glsl"

bool endsAt(CellRay ray, CasterCell cell, vec2 parameters, bool atBorder) { return true; }
