// SPDX-License-Identifier: Apache-2.0
// How often loops go round. Mesa's llvmpipe ends every loop by itself once those of the eight fragments that it runs at once
// have gone round 65,535 times, all loops together, and tells nobody (LP_MAX_TGSI_LOOP_ITERATIONS). So whoever goes through
// lists in lists counts, and what is left then is open.
#ifndef LUXO_LIB_ROUNDS_GLSL
#define LUXO_LIB_ROUNDS_GLSL

const int kMaxRounds = 8000;  // an eighth of these
int roundsLeft = kMaxRounds;

bool isOutOfRounds(int rounds) {
  roundsLeft -= rounds;
  return roundsLeft < 0;
}
#endif
