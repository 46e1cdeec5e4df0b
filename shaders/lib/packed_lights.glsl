// SPDX-License-Identifier: Apache-2.0
// The lights of a shell's draw: as many as its vertices carry to its fragments are packed with other numbers
// (lib/exact_interface.glsl) and flags; the others are in the buffer (lib/lights.glsl).
#ifdef LUXO_VERTEX
void carryLights() {
  for (uint i = 0; i < kVaryingLights; ++i) {
    LightData light = lightSet.lights[i];
    varyingFlags.x |= (light.position.w != 0.0 ? kPointLight << kFlagsOfLight * i : 0) |
                      (light.inverseSquare != 0 ? kInverseSquare << kFlagsOfLight * i : 0);
    uint first = kLightNumbers * i;
    pack3(first, light.position.xyz);
    pack3(first + 3, light.radiance);
  }
  for (uint i = 0; i < kVaryingShades; ++i) {
    ShadeData shade = lightSet.shades[i];
    uint first = kFirstShade + kShadeNumbers * i;
    pack3(first, shade.axis);
    pack(first + 3, shade.cosRim);
    pack(first + 4, shade.reach);
  }
}
#else
LightData lightAt(uint i) {
  if (i >= kVaryingLights) return lightSet.lights[i];
  uint first = kLightNumbers * i;
  return LightData(vec4(packed3(first), has(kPointLight << kFlagsOfLight * i)), packed3(first + 3),
                   has(kInverseSquare << kFlagsOfLight * i) ? 1 : 0);
}

ShadeData shadeAt(uint i) {
  if (i >= kVaryingShades) return lightSet.shades[i];
  uint first = kFirstShade + kShadeNumbers * i;
  return ShadeData(packed3(first), packed(first + 3), packed(first + 4), 1);  // the first
}
#endif
