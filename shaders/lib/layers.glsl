// SPDX-License-Identifier: Apache-2.0
// What is seen through: for each pixel a list of the points that its ray meets before anything opaque, in any order until
// they are blended (blend_layers.frag).
//
// "Linked list" transparency: J. Yang, J. Hensley, H. Gruen, N. Thibieroz, "Real-time concurrent linked list construction on
// the GPU", 2010.
#ifndef LUXO_LIB_LAYERS_GLSL
#define LUXO_LIB_LAYERS_GLSL
#include "lib/pixel_ray.glsl"
#include "lib/scene.glsl"

layout(scalar, set = kSetLayers, binding = kBindingLayerHeads) buffer LayerHeads { uint layerHeads[]; };
layout(scalar, set = kSetLayers, binding = kBindingLayerPoints) buffer LayerPoints { LayerPoint layerPoints[]; };
layout(scalar, set = kSetLayers, binding = kBindingLayerCount) buffer LayerCounts { LayerCount layerCount; };
layout(scalar, set = kSetLayers, binding = kBindingLayerDoubts) buffer LayerDoubts { uint layerDoubts[]; };
// Of one group of lights, at the points' indices. Behind the first group's are those of others, for each as many.
layout(scalar, set = kSetLayers, binding = kBindingLayerReaches) buffer LayerReaches { ReachingLight layerReaches[]; };
layout(scalar, set = kSetLayers, binding = kBindingLayerDetails) buffer LayerDetails { LayerDetail layerDetails[]; };
layout(set = kSetLayers, binding = kBindingLayerDepth) uniform sampler2D opaqueDepth;

layout(constant_id = kConstantLayerDetails) const bool kLayerDetails = false;

uint layerPixel() { return uint(gl_FragCoord.y) * uint(textureSize(opaqueDepth, 0).x) + uint(gl_FragCoord.x); }

uint doubtShift() { return kDoubtBits * (layerPixel() % kDoubtsPerWord); }

void doubtLayers() { atomicOr(layerDoubts[layerPixel() / kDoubtsPerWord], kLayersOpenHere << doubtShift()); }

const float kNothingOpaque = 1e30;  // a depth behind all others

// The depth of a value of the depth buffer, metres beyond that of what positions are relative to: along the ray the value is a
// quotient of linear functions of the depth (perspective: of a constant; orthographic: by one). No branch here is by what is
// in `view`: lavapipe compiles a shader with one anew for every draw (measured: 8 ms each).
float layerDepth(float buffered, vec3 place, vec3 ray) {
  mat4 rows = transpose(view.clipFromRelative);
  vec2 atPlace = vec2(dot(rows[2], vec4(place, 1)), dot(rows[3], vec4(place, 1)));
  vec2 alongRay = vec2(dot(rows[2].xyz, ray), dot(rows[3].xyz, ray));
  return buffered > 0.0 ? (buffered * atPlace.y - atPlace.x) / (alongRay.x - buffered * alongRay.y) : kNothingOpaque;
}

// Whether the device has ended a loop so far, what it should have found being open (lib/rounds.glsl): once it has, each goes
// round once, and one of two rounds tells. What its rounds hang on is in a buffer, so that no compiler takes it apart: by
// gl_FragCoord one is.
bool loopsWereEnded() {
  uint rounds = 0;
  while (rounds < 2 && layerCount.points < 0xffffffffu) ++rounds;
  return rounds < 2;
}

// Whoever goes through the whole list of a pixel asks at its end.
void countEndedLoops() {
  if (loopsWereEnded()) atomicAdd(layerCount.ended, 1);
}

const ReachingLight kAllReaches = ReachingLight(0, vec3(1));

// Whoever asks for the list is told how many points there are; where it has no room for them it is asked again. Gives the
// point's index, 0 without room. The first group's reaches are bound.
uint addLayer(LayerPoint point) {
  if (layerCount.points > 0x80000000u) return 0;  // before it wraps
  uint index = atomicAdd(layerCount.points, 1) + 1;  // 0 ends a list
  if (index >= layerPoints.length()) return 0;
  // All but what others tell before anyone asks: a CPU device writes word by word.
  layerPoints[index].next = atomicExchange(layerHeads[layerPixel()], index);
  layerPoints[index].depth = point.depth;
  layerPoints[index].off = point.off;
  layerPoints[index].material = point.material;
  layerPoints[index].normal = point.normal;
  layerPoints[index].parameters = point.parameters;
  // No loop: of those that searches are in devices end what goes round too often (lib/rounds.glsl).
  uint next = layerPoints.length(), end = layerReaches.length();
  layerReaches[index] = kAllReaches;
  if (index + next < end) layerReaches[index + next] = kAllReaches;
  if (index + 2 * next < end) layerReaches[index + 2 * next] = kAllReaches;
  if (index + 3 * next < end) layerReaches[index + 3 * next] = kAllReaches;
  return index;
}

// With kLayerDetails: there is room for as many.
uint addLayer(LayerPoint point, LayerDetail detail) {
  uint index = addLayer(point);
  if (index != 0) layerDetails[index] = detail;
  return index;
}

// A point that is to be lit.
LayerPoint unlitPoint(float depth, float off, uint material, vec2 normal, vec2 parameters) {
  return LayerPoint(0, depth, off, material, normal, parameters, vec3(0), vec3(0), vec3(0), 0, 0);
}

#ifdef LUXO_FINDS_LAYER
// By that whoever draws the triangle again finds its point, which is none without room.
void setTriangle(uint index) {
  if (index != 0) layerPoints[index].triangle = uint(gl_PrimitiveID);
}
#endif

// Of points that triangles put down, by the flags of their instance.
uint layerOfTriangles(uint flags) { return kLayerOfMesh | ((flags & kIsSurface) != 0 ? kLayerOfSurface : 0); }

// Whether rays cannot find a point again, whose number of the material that is, with its flags.
bool isBesideRays(uint material) { return (material & (kLayerOfMesh | kLayerOfSurface)) == kLayerOfMesh; }

// How much comes through from behind.
vec3 throughLayer(uint blend, float opacity, vec3 diffuse) {
  uint mode = blend & kBlendMode;
  return mode == kBlendAdd ? vec3(1) : mode == kBlendOver ? vec3(1.0 - opacity) : (1.0 - opacity) * diffuse;
}
#endif
