// SPDX-License-Identifier: Apache-2.0
// Mesa's llvmpipe ends every loop by itself once those of the eight fragments that it runs at once have gone round 65,535
// times, all loops together, and tells nobody (LP_MAX_TGSI_LOOP_ITERATIONS): from then on each goes round once. So whoever
// goes through lists asks at its end whether a loop of two rounds still does.
#ifndef LUXO_LIB_ROUNDS_GLSL
#define LUXO_LIB_ROUNDS_GLSL

// Whether some loop so far was ended: what it should have found is open. Of no loop that a compiler may unroll.
bool loopsWereEnded() {
  int two = gl_FragCoord.x < 0.0 ? 1 : 2, rounds = 0;
  while (rounds < two) ++rounds;
  return rounds < two;
}
#endif
