// SPDX-License-Identifier: Apache-2.0
#include "base/suggestion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace luxo {
namespace {

char lower(char c) { return char(std::tolower(static_cast<unsigned char>(c))); }

// Optimal string alignment: three rows of the table are enough.
std::size_t slipsBetween(std::string_view a, std::string_view b) {
  std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        current[j] = std::min(current[j], beforeLast[j - 2] + 1);
    }
    beforeLast.swap(last);
    last.swap(current);
  }
  return last[b.size()];
}

}  // namespace

std::string closestName(std::string_view typed, std::span<const std::string> candidates) {
  std::string best;
  std::size_t fewest = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t most = std::max<std::size_t>(1, candidate.size() / 3);
    if (std::max(typed.size(), candidate.size()) - std::min(typed.size(), candidate.size()) > most) continue;
    const std::size_t slips = slipsBetween(typed, candidate);
    if (slips > most) continue;
    if (slips >= std::min(typed.size(), candidate.size())) continue;
    if (!best.empty() && slips >= fewest) continue;
    best = candidate;
    fewest = slips;
  }
  return best;
}

std::string didYouMean(std::string_view typed, std::span<const std::string> candidates,
                       std::string otherwise) {
  const std::string closest = closestName(typed, candidates);
  return closest.empty() ? std::move(otherwise) : fmt::format("did you mean '{}'?", closest);
}

std::string listed(std::span<const std::string> names) { return fmt::format("{}", fmt::join(names, ", ")); }

}  // namespace luxo
