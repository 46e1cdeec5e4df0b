// SPDX-License-Identifier: Apache-2.0
// Fragments of a shell: find the surface's point, then show it: lit, to be lit, or as numbers or colours of its geometry.
//
// Alpha tells how good the point is: of colours its residual in pixels, negative where the root is not certified; of
// numbers 1, or -1 where it is not.
#extension GL_GOOGLE_include_directive : require
#include "lib/exact_ray.glsl"
#if defined(LUXO_PLANE)
#include "lib/exact_plane.glsl"
#elif defined(LUXO_QUADRIC) || defined(LUXO_TORUS)
#include "lib/exact_equation.glsl"
#else
#include "lib/exact_root.glsl"
#endif
#include "lib/inspection.glsl"
#include "lib/packed_lights.glsl"
#include "lib/show.glsl"

layout(scalar, set = kSetExact, binding = kBindingDoubts) buffer Doubts { uint ofPixels[]; } doubts;

void doubtPixel() {
  uint width = uint(2.0 * varyingCellHalf.z), pixel = uint(gl_FragCoord.y) * width + uint(gl_FragCoord.x);
  atomicOr(doubts.ofPixels[pixel / kDoubtsPerWord], kPointOpenHere << kDoubtBits * (pixel % kDoubtsPerWord));
}

Found foundPoint() {
  Root root;
  int result = rootOfPixel(root);
  root.certified = root.certified && toleranceAt(root.depth) <= kMaxTolerancePx * widthAt(root.depth);
  if (result == kLost || result == kFound && !root.certified) doubtPixel();
  if (result != kFound || !inDepthRange(root.depth)) discard;
  float depth = float(root.depth);
  gl_FragDepth = float(inDepthBuffer(root.depth));

  Found found;
  found.parameters = root.parameters;
  found.position = relativePosition(root.S);
  vec3 toViewer = varyingViewerSecond.xyz - (has(kPerspective) ? found.position : vec3(0));
  found.viewer = toViewer * inversesqrt(max(dot(toViewer, toViewer), kSmallest));
  vec3 outward = unitOrZero(root.outward);
  found.normal = root.front || !has(kTwoSided) ? outward : -outward;
#if defined(LUXO_FRAMED) || defined(LUXO_FINDS_FRAME)
  if (!root.front && has(kTwoSided)) rootFrame = -rootFrame;
#endif
  found.depth = depth;
  found.residual = root.certified ? root.residual : -max(root.residual, 1e-9);
  return found;
}

Material foundMaterial() {
  return Material(varyingAmbientShininess.rgb, varyingDiffuse, varyingSpecularTolerance.xyz, varyingAmbientShininess.w,
                  varyingFlags.x);
}

uint foundMaterialNumber() { return varyingFlags.z; }

vec4 patternBounds() {
  vec4 domain = domainOfNames();
  vec2 margin = 1e-6 * (domain.zw - domain.xy);
  return vec4(domain.xy + margin, domain.zw - margin);
}

void showPoint() {
  Found found = foundPoint();
  if (kQuantity == kLight || kQuantity == kFoundTexel) {
    show(found, found.residual);
  } else {
    Inspected inspected = Inspected(found.position, found.normal, found.parameters, found.depth, instances[varyingFlags.w].id,
                                    found.residual, found.residual < 0.0 ? kUncertified : kBySearch);
    float alpha = kAsColor ? found.residual : found.residual < 0.0 ? -1 : 1;
    outColor = vec4(inspectedValue(inspected, kQuantity, kAsColor, domainOfNames()), alpha);
  }
}
