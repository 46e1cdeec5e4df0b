// SPDX-License-Identifier: Apache-2.0
// The light on all that is seen through, in the lists of the pixels.
#extension GL_GOOGLE_include_directive : require
#include "lib/carried_lights.glsl"
#include "lib/found.glsl"
#include "lib/layers.glsl"
#include "lib/number.glsl"
#include "lib/octahedral.glsl"
#include "lib/quantity.glsl"

layout(constant_id = kConstantPattern) const uint kPattern = 0;
layout(constant_id = kConstantManyMaterials) const bool kManyMaterials = false;

layout(constant_id = kConstantAddsLight) const bool kAddsLight = false;
layout(constant_id = kConstantManyGroups) const bool kManyGroups = false;

layout(scalar, set = kSetLayers, binding = kBindingLayerMaterials) uniform UniformMaterials {
  MaterialData uniformMaterials[kUniformMaterials];
};

// As of whoever lights what was found (lib/shade_fragment.glsl).
layout(location = kLocationTargetViewer) flat in vec4 inViewer;
layout(location = kLocationTargetPlace) flat in vec3 inPlace[3];
layout(location = kLocationTargetRay) flat in vec3 inRay[3];
layout(location = kLocationTargetMiddle) flat in vec2 inMiddle;

layout(constant_id = kConstantOcclusion) const bool kOcclusion = false;
layout(set = kSetLayers, binding = kBindingLayersFound) uniform sampler2D foundTexels;
#include "lib/openness.glsl"
float opennessHere = 1.0;
#define LUXO_OPENNESS
float openness() { return opennessHere; }

#define LUXO_IN_LOOP
#ifdef LUXO_TEXTURED
LayerDetail layerDetail;
vec4 pixelFootprint() { return layerDetail.footprint; }
vec4 normalFrame() { return layerDetail.frame; }
#endif
#define LUXO_ADDS_LIGHT kAddsLight

MaterialData material;
uint numberHere;  // of the material, with the flags of the point
ReachingLight reachesHere;

Material foundMaterial() { return materialOf(material); }
uint foundMaterialNumber() { return 0; }
uint shadows() { return reachesHere.shadows; }
vec3 lightTransmittance() { return reachesHere.transmittance; }

// Whoever includes this knows them: the diffuse colour, and the opacity; once the point is lit.
vec4 paintOf(Found found);

void shadeLayers() {
  vec2 pixel = gl_FragCoord.xy - inMiddle;
  vec3 place = inPlace[0] + pixel.x * inPlace[1] + pixel.y * inPlace[2],
       ray = inRay[0] + pixel.x * inRay[1] + pixel.y * inRay[2];
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    LayerPoint point = layerPoints[index];
    uint number = point.material & kLayerMaterial;
    if (kManyMaterials)
      material = materials[number];
    else
      material = uniformMaterials[number];
    if (material.pattern != kPattern) continue;  // another draw's
    if (kAddsLight) material.ambient = vec3(0);
    numberHere = point.material;
    Found found;
    found.position = place + point.depth * ray;
    found.normal = fromOctahedral(point.normal);
    found.viewer = towardViewer(inViewer, found.position);
    found.parameters = point.parameters;
    found.depth = found.residual = 0.0;  // no light asks for them
    if (kOcclusion) {
      opennessHere = opennessOf(ivec2(gl_FragCoord.xy), point.depth, found.position, found.normal, found.viewer);
      material.ambient *= opennessHere;
    }
    reachesHere = layerReaches[index];
#ifdef LUXO_TEXTURED
    layerDetail = layerDetails[index];
#endif
    vec3 reflected_ = lit(found);
    vec4 paint = paintOf(found);
    vec3 before = kAddsLight ? point.light : vec3(0);
    // What a shader tells instead of a colour stays as it is, however little is seen of it.
    layerPoints[index].light = kQuantity != kLight    ? vec3(paint.a)
                               : isColor(reflected_) ? before + paint.a * reflected_
                                                     : before + reflected_;
    if (kManyGroups) layerReaches[index] = kAllReaches;  // the next group's are in the same place
    layerPoints[index].through = throughLayer(material.blend, paint.a, paint.rgb);
  }
  countEndedLoops();
}
