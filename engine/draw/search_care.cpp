// SPDX-License-Identifier: Apache-2.0
#include "draw/search_care.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace luxo {
namespace {

std::uint64_t sum(const std::vector<std::uint32_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

}  // namespace

std::uint64_t LostPixels::count() const { return sum(inFlat) + sum(inSteep); }

bool SearchCare::addFlat(const LostPixels& lost) {
  if (sum(lost.inFlat) == 0) return false;
  lostInFlat.resize(lost.inFlat.size());
  for (std::size_t slot = 0; slot < lostInFlat.size(); ++slot) lostInFlat[slot] += lost.inFlat[slot];
  return true;
}

bool SearchCare::raiseLevels(const LostPixels& lost) {
  levels.resize(std::max(levels.size(), lost.inSteep.size()));
  lostInSteep.resize(levels.size());
  bool raised = false;
  for (std::size_t node = 0; node < lost.inSteep.size(); ++node) {
    const std::uint32_t before = std::exchange(lostInSteep[node], lost.inSteep[node]);
    if (lost.inSteep[node] == 0 || (levels[node] > 0 && lost.inSteep[node] >= before)) continue;
    ++levels[node];
    raised = true;
  }
  return raised;
}

}  // namespace luxo
