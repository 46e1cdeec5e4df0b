// SPDX-License-Identifier: Apache-2.0
// Fragments of a shell: find the surface's point, then show it: lit, or as numbers or colours of its geometry.
//
// Alpha tells how good the point is: of what is lit and opaque its residual in pixels, negative where the root is not
// certified; of what is transparent its opacity; of numbers and colours 1, or -1 where it is not.
#extension GL_GOOGLE_include_directive : require
#include "lib/exact_ray.glsl"
#if defined(LUXO_PLANE)
#include "lib/exact_plane.glsl"
#elif defined(LUXO_QUADRIC) || defined(LUXO_TORUS)
#include "lib/exact_equation.glsl"
#else
#include "lib/exact_root.glsl"
#endif
#include "lib/illumination.glsl"
#include "lib/inspection.glsl"

layout(constant_id = kConstantQuantity) const uint kQuantity = kLight;
layout(constant_id = kConstantAsColor) const bool kAsColor = false;

layout(scalar, set = kSetExact, binding = kBindingFeedback) buffer Feedback { uint lost[]; } feedback;
layout(scalar, set = kSetExact, binding = kBindingDoubts) buffer Doubts { uint ofPixels[]; } doubts;

layout(location = 0) out vec4 outColor;

LightData lightAt(uint i) {
  if (i >= kVaryingLights) return lightSet.lights[i];
  uint first = kLightNumbers * i;
  return LightData(vec4(packed3(first), has(kPointLight << kFlagsOfLight * i)), packed3(first + 3),
                   has(kInverseSquare << kFlagsOfLight * i) ? 1 : 0);
}

ShadeData shadeAt(uint i) {
  if (i >= kVaryingShades) return lightSet.shades[i];
  uint first = kFirstShade + kShadeNumbers * i;
  return ShadeData(packed3(first), packed(first + 3), packed(first + 4));
}

// What the picture shows of a point: `diffuse` and `ambient` as the material has them there.
struct Seen {
  vec2 parameters;
  vec3 position;  // relative to the eye
  vec3 normal;
  vec3 viewer;    // unit, toward the viewer
  float depth, residual;
};

void doubtPixel(uint why) {
  uint width = uint(2.0 * varyingCellHalf.z), pixel = uint(gl_FragCoord.y) * width + uint(gl_FragCoord.x);
  atomicOr(doubts.ofPixels[pixel / kDoubtsPerWord], why << kDoubtBits * (pixel % kDoubtsPerWord));
}

// Ends the fragment where there is nothing to see.
Seen seenPoint() {
  Found found;
  int result = findPoint(found);
  if (result == kLost) atomicAdd(feedback.lost[kGrazing ? kFeedbackSlots + varyingFlags.w : uint(varyingClip.w)], 1);
  if (result == kLost || result == kFound && !found.certified)
    doubtPixel(result == kLost ? kLostHere : kUncertifiedHere);
  if (result != kFound || !inDepthRange(found.depth)) discard;
  float depth = float(found.depth);
  gl_FragDepth = float(inDepthBuffer(found.depth));

  Seen seen;
  seen.parameters = found.parameters;
  seen.position = relativePosition(found.S);
  vec3 toViewer = varyingViewerSecond.xyz - (has(kPerspective) ? seen.position : vec3(0));
  seen.viewer = toViewer * inversesqrt(max(dot(toViewer, toViewer), kSmallest));
  vec3 outward = unitOrZero(found.outward);
  seen.normal = found.front || !has(kTwoSided) ? outward : -outward;
  seen.depth = depth;
  seen.residual = found.certified ? found.residual : -max(found.residual, 1e-9);
  return seen;
}

void show(Seen seen, vec3 ambient, vec3 diffuse) {
  if (kQuantity == kLight) {
    Material material = Material(ambient, diffuse, varyingSpecularTolerance.xyz, varyingAmbientShininess.w, varyingFlags.x);
    bool opaque = varyingDiffuseOpacity.w == 0.0;
    outColor = vec4(illuminated(material, seen.position, seen.normal, seen.viewer),
                    opaque ? seen.residual : varyingDiffuseOpacity.w);
  } else {
    Inspected inspected = Inspected(seen.position, seen.normal, seen.parameters, seen.depth, instances[varyingFlags.w].id,
                                    seen.residual, seen.residual < 0.0 ? kUncertified : kBySearch);
    outColor = vec4(inspectedValue(inspected, kQuantity, kAsColor, domainOfNames()), seen.residual < 0.0 ? -1 : 1);
  }
}
