// SPDX-License-Identifier: Apache-2.0
// Vertices of a shell around a surface (engine/shell/shell.h): where the search for the surface begins.
#define LUXO_VERTEX
#include "lib/exact_interface.glsl"
#include "lib/packed_lights.glsl"
#include "lib/scene.glsl"

layout(location = kAttributeShellPosition) in vec3 inPosition;
layout(location = kAttributeShellParameters) in vec2 inParameters;
layout(location = kAttributeShellCell) in vec3 inCell;  // extent in u and v; how much derivatives change over it, metres of the object
layout(location = kAttributeShellPatch) in uint inPatch;

layout(scalar, set = kSetExact, binding = kBindingExactInstances) readonly buffer ExactInstances { ExactInstance exactInstances[]; };
layout(scalar, set = kSetExact, binding = kBindingExactPatches) readonly buffer ExactPatches { ExactPatch exactPatches[]; };
layout(scalar, set = kSetExact, binding = kBindingExactParameters) readonly buffer ExactParameters { float exactParameters[]; };

layout(push_constant, scalar) uniform Draw { ShellDraw draw; };

invariant gl_Position;

#ifdef LUXO_DOUBLE

double row(vec4 high, vec4 low) {
  return dot(dvec4(high) + dvec4(low), dvec4(inPosition, 1));
}

// Where a view magnifies what float rounds away of a vertex, an edge of a shell would leave out pixels of the surface.
vec4 clipOfVertex(InstanceData instance, ExactInstance exact) {
  dvec2 middle = dvec2(row(exact.shellX, exact.shellXLow), row(exact.shellY, exact.shellYLow));
  double depth = row(exact.shellDepth, exact.shellDepthLow);
  bool perspective = view.viewer.w != 0.0;
  double z = perspective ? double(exact.clipDepth.x) : 1.0 + exact.clipDepth.y * (depth - exact.clipDepth.x);
  return vec4(vec2(middle / dvec2(exact.half_.x, -exact.half_.y)) / draw.guard, z, perspective ? depth : 1.0);
}

#else

vec4 clipOfVertex(InstanceData instance, ExactInstance exact) {
  return view.clipFromRelative * vec4(relativeFromObject(instance, inPosition), 1);
}

#endif


void main() {
  InstanceData instance = instances[gl_InstanceIndex];
  ExactInstance exact = exactInstances[gl_InstanceIndex];
  ExactPatch surfacePatch = exactPatches[exact.firstPatch + inPatch];
  varyingStart = vec4(kEquation ? inPosition + exact.origin : vec3(inParameters, 0), 1);
  MaterialData material = materials[instance.material];
  varyingAmbientShininess = vec4(material.ambient, material.shininess);
  varyingDiffuse = material.diffuse;
  varyingSpecularTolerance = vec4(material.specular, exact.tolerance);
  bool negative = ((surfacePatch.flags & kInward) != 0) != (exact.facing * draw.side < 0.0);
  varyingFlags = uvec4(instance.flags | material.flags | surfacePatch.flags | (draw.side < 0.0 ? kBackSide : 0) | (negative ? kNegative : 0) |
                        (view.viewer.w != 0.0 ? kPerspective : 0),
                    surfacePatch.firstParameter, kQuantity == kFoundTexel ? instance.material : material.firstPatternParameter,
                    gl_InstanceIndex);
  varyingViewerSecond = vec4(view.viewer.xyz, inCell.z);
  carryLights();
  varyingX = exact.x;
  varyingY = exact.y;
  varyingDepth = exact.depth;
  for (int i = 0; i < 3; ++i) varyingRelative[i] = vec4(instance.relativeFromObject[i].xyz, exact.translation[i]);
  varyingDomain = surfacePatch.domain;
  varyingCellHalf = vec4(inCell.xy, exact.half_);
  varyingClip = vec3(exact.clipDepth, exact.thickness);
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
