// SPDX-License-Identifier: Apache-2.0
// Vertices of a hull around a surface (engine/tessellate/hull.h): where the search for the surface begins.
#define LUXO_VERTEX
#include "lib/exact_interface.glsl"
#include "lib/scene.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec2 inParameters;
layout(location = 2) in vec3 inCell;  // extent in u and v; how much derivatives change over it, metres of the object
layout(location = 3) in uint inPatch;

layout(scalar, set = 2, binding = kBindingExactInstances) readonly buffer ExactInstances { ExactInstance exactInstances[]; };
layout(scalar, set = 2, binding = kBindingExactPatches) readonly buffer ExactPatches { ExactPatch exactPatches[]; };
layout(scalar, set = 2, binding = kBindingExactParameters) readonly buffer ExactParameters { float exactParameters[]; };

// Which side of the surface these triangles lead to: +1 front, -1 back.
layout(push_constant) uniform Draw { float side, guard; } draw;

invariant gl_Position;

#ifdef LUXO_DOUBLE

double row(vec4 high, vec4 low) {
  return dot(dvec4(high) + dvec4(low), dvec4(inPosition, 1));
}

// Where a view magnifies what float rounds away of a vertex, an edge of a hull would leave out pixels of the surface.
vec4 clipOfVertex(InstanceData instance, ExactInstance exact) {
  dvec2 middle = dvec2(row(exact.hullX, exact.hullXLow), row(exact.hullY, exact.hullYLow));
  double depth = row(exact.hullDepth, exact.hullDepthLow);
  bool perspective = view.viewer.w != 0.0;
  double z = perspective ? double(exact.clipDepth.x) : exact.clipDepth.x + exact.clipDepth.y * depth;
  return vec4(vec2(middle / dvec2(exact.half_.x, -exact.half_.y)) / draw.guard, z, perspective ? depth : 1.0);
}

#else

vec4 clipOfVertex(InstanceData instance, ExactInstance exact) {
  return view.clipFromRelative * vec4(relativeFromObject(instance, inPosition), 1);
}

#endif

void pack(uint k, float number) { linkPacked[k / 4][k % 4] = number; }

void main() {
  InstanceData instance = instances[gl_InstanceIndex];
  ExactInstance exact = exactInstances[gl_InstanceIndex];
  ExactPatch surfacePatch = exactPatches[exact.firstPatch + inPatch];
  linkStart = vec4(kEquation ? inPosition + exact.origin : vec3(inParameters, 0), 1);
  linkAmbientShininess = vec4(instance.ambient, instance.shininess);
  linkDiffuseOpacity = vec4(instance.diffuse, instance.opacity);
  linkSpecularTolerance = vec4(instance.specular, exact.tolerance);
  bool negative = ((surfacePatch.flags & kInward) != 0) != (exact.facing * draw.side < 0.0);
  linkFlags = uvec4(instance.flags | surfacePatch.flags | (draw.side < 0.0 ? kBackSide : 0) | (negative ? kNegative : 0) |
                        (view.viewer.w != 0.0 ? kPerspective : 0),
                    surfacePatch.firstParameter, instance.firstPatternParameter, gl_InstanceIndex);
  linkViewerSecond = vec4(view.viewer.xyz, inCell.z);
  for (uint i = 0; i < kLinkedLights; ++i) {
    LightData light = lightSet.lights[i];
    linkFlags.x |= (light.position.w != 0.0 ? kPointLight << 2 * i : 0) |
                   (light.inverseSquare != 0 ? kInverseSquare << 2 * i : 0);
    for (uint k = 0; k < 3; ++k) {
      pack(kLightNumbers * i + k, light.position[k]);
      pack(kLightNumbers * i + 3 + k, light.radiance[k]);
    }
  }
  for (uint i = 0; i < kLinkedShades; ++i) {
    ShadeData shade = lightSet.shades[i];
    uint first = kFirstShade + kShadeNumbers * i;
    for (uint k = 0; k < 3; ++k) pack(first + k, shade.axis[k]);
    pack(first + 3, shade.cosRim);
    pack(first + 4, shade.reach);
  }
  linkX = exact.x;
  linkY = exact.y;
  linkDepth = exact.depth;
  for (int i = 0; i < 3; ++i) linkRelative[i] = vec4(instance.relativeFromObject[i], exact.translation[i]);
  linkDomain = surfacePatch.domain;
  linkCellHalf = vec4(inCell.xy, exact.half_);
  linkClip = vec4(exact.clipDepth, exact.thickness, float((exact.firstSlot + gl_VertexIndex) % kTallySlots));
  if (kDouble) {
    for (uint k = 0; k < 4; ++k) {
      pack(kFirstRowLow + k, exact.xLow[k]);
      pack(kFirstRowLow + 4 + k, exact.yLow[k]);
      pack(kFirstRowLow + 8 + k, exact.depthLow[k]);
      if (!kEquation) pack(kFirstDomainLow + k, surfacePatch.domainLow[k]);
    }
    for (uint k = 0; k < 3; ++k) {
      pack(kMiddle + 2 * k, exact.middle[k]);
      pack(kMiddle + 2 * k + 1, exact.middleLow[k]);
    }
  }
  for (uint k = 0; k < min(kParameterCount, kCarriedParameters); ++k)
    for (uint i = 0; i < kFloats; ++i)
      pack(kFirstParameter + kFloats * k + i, exactParameters[2 * (surfacePatch.firstParameter + k) + i]);
  gl_Position = clipOfVertex(instance, exact);
}
