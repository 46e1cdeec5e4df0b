// SPDX-License-Identifier: Apache-2.0
// Two indices of one loop count on one number: a race, which the thread sanitizer has to report.
#include <cstdio>

#include "tessellate/parallel.h"

int main() {
  int count = 0;
  luxo::forEachIndex(2, true, [&](std::size_t) { ++count; });
  std::printf("counted %d\n", count);
}
