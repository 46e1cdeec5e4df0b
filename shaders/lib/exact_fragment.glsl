// SPDX-License-Identifier: Apache-2.0
// Fragments of a hull: find the surface's point, then show it: lit, or as numbers or colours of its geometry.
//
// Alpha tells how good the point is: of what is lit and opaque its residual in pixels, negative where the root is not
// certified; of what is transparent its opacity; of numbers and colours 1.
#extension GL_GOOGLE_include_directive : require
#include "lib/exact_root.glsl"
#include "lib/illumination.glsl"
#include "lib/inspection.glsl"

layout(constant_id = 3) const uint kQuantity = kLight;
layout(constant_id = 4) const bool kAsColor = false;

layout(scalar, set = 2, binding = kBindingTally) buffer Tally { uint lost[]; } tally;

layout(location = 0) out vec4 outColor;

LightData lightAt(uint i) {
  if (i >= kLinkedLights) return lightSet.lights[i];
  uint first = kLightNumbers * i;
  return LightData(vec4(packed3(first), has(kPointLight << 2 * i)), packed3(first + 3),
                   has(kInverseSquare << 2 * i) ? 1 : 0);
}

ShadeData shadeAt(uint i) {
  if (i >= kLinkedShades) return lightSet.shades[i];
  uint first = kFirstShade + kShadeNumbers * i;
  return ShadeData(packed3(first), packed(first + 3), packed(first + 4));
}

// Whether the root is certainly the one that the search was for (Newton-Kantorovich): with J the Jacobian per cell, K a
// proven bound of how much it changes over a cell, |1/J|^2 |f| K <= 1/2 proves that a single root is near, and where the
// search began is not far.
bool certified(Ray ray, real2 p, Probe at) {
  real2 ju = at.fu * linkCellHalf.x, jv = at.fv * linkCellHalf.y;
  real det = ju.x * jv.y - ju.y * jv.x;
  real k = linkViewerSecond.w * sqrt(dot(ray.across1, ray.across1) + dot(ray.across2, ray.across2));
  bool proven = (dot(ju, ju) + dot(jv, jv)) * length(at.f) * k <= 0.5 * det * det;
  real2 way = abs(p - linkStart) / linkCellHalf.xy;
  return proven && max(way.x, way.y) <= kFarCells;
}

// The parameters as the surface names them.
vec2 inPeriod(real2 p) {
  real2 period = patchDomain.zw - patchDomain.xy;
  real2 turns = floor((p - patchDomain.xy) / period);
  return vec2(has(kWrapsU) ? p.x - turns.x * period.x : p.x,
              has(kWrapsV) ? p.y - turns.y * period.y : p.y);
}

vec3 relative(vec3 object) {
  return linkRelative[0].xyz * object.x + linkRelative[1].xyz * object.y + linkRelative[2].xyz * object.z;
}

// What the picture shows of a point: `diffuse` and `ambient` as the material has them there.
struct Seen {
  vec2 parameters;
  vec3 position;  // relative to the eye
  vec3 normal;
  vec3 viewer;    // unit, toward the viewer
  float depth, residual;
};

// Ends the fragment where there is nothing to see.
Seen seenPoint() {
  readSurface();
  Ray ray = rayOfPixel();
  real2 p;
  Probe at;
  int result = findRoot(ray, p, at);
  if (result == kLost) atomicAdd(tally.lost[kSteep ? kTallySlots + linkFlags.w : uint(linkClip.w)], 1);
  if (result != kFound) discard;
  // Orthographic: linear; perspective: near / depth.
  float depth = float(at.depth), residual = float(offset(at) / widthAt(at));
  float z = has(kPerspective) ? linkClip.x / depth : linkClip.x + linkClip.y * depth;
  if (!(z >= 0.0 && z <= 1.0)) discard;  // before the near plane
  gl_FragDepth = z;

  Seen seen;
  seen.parameters = inPeriod(p);
  seen.position = relativePosition(at.S);
  vec3 toViewer = linkViewerSecond.xyz - (has(kPerspective) ? seen.position : vec3(0));
  seen.viewer = toViewer * inversesqrt(max(dot(toViewer, toViewer), kSmallest));
  vec3 n = unitOrZero(cross(relative(vec3(at.Su)), relative(vec3(at.Sv))));
  // The sign of the area tells the side exactly; at outlines n.V is what rounding makes of 0.
  bool flipped = has(kNegative) != has(kBackSide), front = (area(at) < 0.0) == flipped;
  vec3 outward = flipped ? n : -n;
  seen.normal = front || !has(kTwoSided) ? outward : -outward;
  seen.depth = depth;
  seen.residual = certified(ray, p, at) ? residual : -max(residual, 1e-9);
  return seen;
}

void show(Seen seen, vec3 ambient, vec3 diffuse) {
  if (kQuantity == kLight) {
    Material material = Material(ambient, diffuse, linkSpecularTolerance.xyz, linkAmbientShininess.w, linkFlags.x);
    bool opaque = linkDiffuseOpacity.w == 0.0;
    outColor = vec4(illuminated(material, seen.position, seen.normal, seen.viewer),
                    opaque ? seen.residual : linkDiffuseOpacity.w);
  } else {
    Inspected inspected = Inspected(seen.position, seen.normal, seen.parameters, seen.depth, instances[linkFlags.w].id,
                                    seen.residual);
    outColor = vec4(inspectedValue(inspected, kQuantity, kAsColor, linkDomain), 1);
  }
}
