// SPDX-License-Identifier: Apache-2.0
// Fragments that light what an earlier pass has found; with LUXO_SHADOWS by the lights whose shadows it is not in.
#extension GL_GOOGLE_include_directive : require
#include "lib/carried_lights.glsl"
#include "lib/found_texel.glsl"
#include "lib/scene.glsl"

layout(constant_id = kConstantPattern) const uint kPattern = 0;
layout(constant_id = kConstantManyMaterials) const bool kManyMaterials = false;
layout(constant_id = kConstantAddsLight) const bool kAddsLight = false;

layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;
layout(set = kSetFound, binding = kBindingFoundParameters) uniform sampler2D foundParameters;
layout(scalar, set = kSetFound, binding = kBindingUniformMaterials) uniform UniformMaterials {
  MaterialData uniformMaterials[kUniformMaterials];
};

#ifdef LUXO_TEXTURED
layout(set = kSetPattern, binding = kBindingFoundFootprint) uniform sampler2D foundFootprints;
vec4 pixelFootprint() { return texelFetch(foundFootprints, ivec2(gl_FragCoord.xy), 0); }
#endif
#ifdef LUXO_FRAMED
layout(set = kSetPattern, binding = kBindingFoundFrame) uniform sampler2D foundFrames;
vec4 normalFrame() { return texelFetch(foundFrames, ivec2(gl_FragCoord.xy), 0); }
#endif
#define LUXO_ADDS_LIGHT kAddsLight
#define LUXO_SHADES_FOUND

layout(constant_id = kConstantOcclusion) const bool kOcclusion = false;
layout(set = kSetFound, binding = kBindingOpenness) uniform sampler2D opennesses;
#define LUXO_OPENNESS
float openness() { return kOcclusion ? texelFetch(opennesses, ivec2(gl_FragCoord.xy), 0).x : 1.0; }

layout(location = kLocationTargetViewer) flat in vec4 inViewer;
layout(location = kLocationTargetPlace) flat in vec3 inPlace[3];
layout(location = kLocationTargetRay) flat in vec3 inRay[3];
layout(location = kLocationTargetMiddle) flat in vec2 inMiddle;

layout(location = 0) out vec4 outColor;

MaterialData material;

Found foundPoint() {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  uint number = materialOfTexel(texel);
  if (kManyMaterials)
    material = materials[number];
  else
    material = uniformMaterials[number];
  if (material.pattern != kPattern) discard;  // another draw's
  if (kAddsLight) material.ambient = vec3(0);
  material.ambient *= openness();
  vec2 pixel = gl_FragCoord.xy - inMiddle;
  vec3 place = inPlace[0] + pixel.x * inPlace[1] + pixel.y * inPlace[2],
       ray = inRay[0] + pixel.x * inRay[1] + pixel.y * inRay[2];
  Found found;
  found.depth = 0.0;  // no light asks for it
  found.position = place + texel.x * ray;
  found.normal = fromOctahedral(texel.yz);
  found.viewer = towardViewer(inViewer, found.position);
  found.parameters = kPattern != 0 ? texelFetch(foundParameters, ivec2(gl_FragCoord.xy), 0).xy : vec2(0);
  found.residual = residualOfTexel(texel);
  return found;
}

#ifdef LUXO_SHADOWS
layout(set = kSetFound, binding = kBindingShadows) uniform usampler2D shadowsOfLights;
layout(set = kSetFound, binding = kBindingTransmittance) uniform sampler2D transmittances;
uint shadows() { return texelFetch(shadowsOfLights, ivec2(gl_FragCoord.xy), 0).x; }
vec3 lightTransmittance() { return texelFetch(transmittances, ivec2(gl_FragCoord.xy), 0).rgb; }
#endif

Material foundMaterial() { return materialOf(material); }
uint foundMaterialNumber() { return 0; }

void shade() {
  Found found = foundPoint();
  outColor = vec4(lit(found), found.residual);
}
