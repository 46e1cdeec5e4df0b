// SPDX-License-Identifier: Apache-2.0
// The place of a plane that a pixel sees: no search, but a ratio of linear functions (engine/draw/pixel_rows.h). In
// double, so that what is rounded is less than a pixel's tolerance however large the plane is.
#include "lib/equation_numbers.glsl"

// What is beyond an edge by no more than `margin`, metres, is the plane's. A disk is compared by squares.
bool isInside(real3 S, real margin) {
  real3 lowest = number3(kEquationLowest) - margin, highest = number3(kEquationHighest) + margin;
  real square = S.x * S.x + S.z * S.z;
  bool inDisk = square <= highest.x * highest.x && (lowest.x <= 0.0 || square >= lowest.x * lowest.x);
  bool inRectangle = S.x >= lowest.x && S.x <= highest.x && S.z >= lowest.z && S.z <= highest.z;
  return has(kRadial) ? inDisk : inRectangle;
}

int rootOfPixel(out Root root) {
  readSurface();
  real3 pixel = real3(gl_FragCoord.xy - varyingCellHalf.zw, 1);
  real perW = 1.0 / dot(rowDepth.xyz, pixel);
  root.S = real3(dot(rowX.xyz, pixel) * perW, 0, dot(rowY.xyz, pixel) * perW);
  root.depth = rowX.w * root.S.x + rowY.w * root.S.z + rowDepth.w;
  root.parameters = vec2(parameterOf(root.S, kEquationU), parameterOf(root.S, kEquationV));
  vec3 upward = cross(varyingRelative[2].xyz, varyingRelative[0].xyz);
  bool outerIsUp = has(kRisesOutward) != isMirrored();
  root.outward = outerIsUp ? upward : -upward;
  root.front = has(kFromAbove) == outerIsUp;
  // No more than this is rounded.
  root.residual = float(toleranceAt(root.depth)) / float(widthAt(root.depth));
  root.certified = true;
#ifdef LUXO_TEXTURED
  real3 x = real3(rowX.xyz - root.S.x * rowDepth.xyz) * perW, z = real3(rowY.xyz - root.S.z * rowDepth.xyz) * perW;
  setFootprint(root.S, vec3(x.x, 0, z.x), vec3(x.y, 0, z.y));
#endif
#if defined(LUXO_FRAMED) || defined(LUXO_FINDS_FRAME)
  setFrame(root.S, vec3(0, 1, 0), root.outward);
#endif
  real metres = toleranceAt(root.depth) * varyingClip.z;
  return isInside(root.S, metres) && (root.front || has(kShowsBack)) ? kFound : kMissed;
}
