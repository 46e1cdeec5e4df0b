// SPDX-License-Identifier: Apache-2.0
// A pixel's ray, and what a search for the surface on it finds.
//
// With the ray's pixel (qx, qy) the offset f = (X - qx w, Y - qy w) of a point vanishes where the point is on the ray;
// |f| / w is how far it is from the pixel's centre on the screen.
//
// Numbers are `real`: float, or double where LUXO_DOUBLE is defined.
#include "lib/exact_interface.glsl"
#include "lib/scene.glsl"
#include "lib/exact_surface.glsl"

const float kFine = 0.2;        // of the tolerance
const float kSmallest = 1e-37;
const float kPi = 3.14159265;

#ifdef LUXO_TRANSVERSAL
const bool kGrazing = false;
#else
const bool kGrazing = true;  // whether rays may graze the surface
#endif

// Whether only the front of the surface is shown, though nothing hides the back: rays go on through that.
layout(constant_id = kConstantFrontOnly) const bool kFrontOnly = false;

// f = (dot(across1, S) + offset1, dot(across2, S) + offset2).
struct Ray {
  real3 across1, across2;
  real offset1, offset2;
};

Ray rayOfPixel() {
  real2 q = gl_FragCoord.xy - varyingCellHalf.zw;
  real4 w = has(kPerspective) ? rowDepth : real4(0, 0, 0, 1);
  real4 a = rowX - q.x * w, b = rowY - q.y * w;
  return Ray(a.xyz, b.xyz, a.w, b.w);
}

real2 offsetOf(Ray ray, real3 S) {
  return real2(dot(ray.across1, S) + ray.offset1, dot(ray.across2, S) + ray.offset2);
}

real depthOf(real3 S) { return dot(rowDepth.xyz, S) + rowDepth.w; }

// What a pixel is wide at a depth, in units of f. Behind the eye there is no screen, and it is negative.
real widthAt(real depth) { return has(kPerspective) ? depth : 1.0; }

// The largest offset of a point that is found there. What single precision leaves of an offset is part of it.
real toleranceAt(real depth) {
  return varyingSpecularTolerance.w * widthAt(depth) + (has(kPerspective) ? varyingClip.y : 0.0);
}

// Orthographic: linear; perspective: near / depth. Before the near plane above 1.
real inDepthBuffer(real depth) {
  return has(kPerspective) ? varyingClip.x / depth : 1.0 + varyingClip.y * (depth - varyingClip.x);
}
bool inDepthRange(real depth) {
  real z = inDepthBuffer(depth);
  return z >= 0.0 && z <= 1.0;
}

// Whether a search ends here: at a root that is good even among roots, or one step after any. That step costs little and
// halves what is left of the error: the tolerance has room for the worst that rounding does, and most places are better.
bool ends(bool good, bool fine, inout bool wasGood) {
  bool isEnd = good && (wasGood || fine);
  wasGood = good;
  return isEnd;
}

const int kFound = 0, kMissed = 1, kLost = 2;

// The point of the surface that the pixel sees.
struct Root {
  real3 S;          // object space
  vec2 parameters;  // as the surface names them
  vec3 outward;     // where its outer side faces; relative space, of any length
  bool front;       // whether that side is seen
  real depth;
  float residual;   // pixels
  bool certified;   // certainly the point that the search was for
};

#ifdef LUXO_TEXTURED
// How u and v move from a pixel to the next: to the right, below. Along the surface f moves by what a pixel is wide.
vec4 rootFootprint;
vec4 pixelFootprint() { return rootFootprint; }

// Of a formula, by its derivatives of f.
void setFootprint(real2 fu, real2 fv, real width) {
  real perDeterminant = width / (fu.x * fv.y - fv.x * fu.y);
  rootFootprint = vec4(real4(fv.y, -fu.y, -fv.x, fu.x) * perDeterminant);
}
#endif

#if defined(LUXO_FRAMED) || defined(LUXO_FINDS_FRAME)
// Of the outer side; turned over with the normal.
vec4 rootFrame;
vec4 normalFrame() { return rootFrame; }
#endif

vec3 relative(vec3 object) {
  return varyingRelative[0].xyz * object.x + varyingRelative[1].xyz * object.y + varyingRelative[2].xyz * object.z;
}
