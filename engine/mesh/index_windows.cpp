// SPDX-License-Identifier: Apache-2.0
#include "mesh/index_windows.h"

#include <algorithm>

#include "base/assert.h"

namespace luxo {
namespace {

/// The vertices between two numbers, both of which are in it.
struct Span {
  std::uint32_t low = 0, high = 0;

  explicit Span(std::span<const std::uint32_t, 3> corners)
      : low(*std::ranges::min_element(corners)), high(*std::ranges::max_element(corners)) {}

  [[nodiscard]] bool fits() const { return high - low < kWindowVertices; }
};

Span hull(Span a, const Span& b) {
  a.low = std::min(a.low, b.low);
  a.high = std::max(a.high, b.high);
  return a;
}

}  // namespace

// What is part of a window is a window: so none that begins as early can end later than one that takes
// triangles for as long as they fit, and no other choice has fewer.
std::vector<IndexWindow> indexWindows(std::span<const std::uint32_t> indices) {
  LUXO_REQUIRE_COMPARE(indices.size() % 3, ==, 0u);
  if (indices.empty()) return {};
  const auto spanAt = [&](std::size_t first) { return Span(indices.subspan(first).first<3>()); };
  std::vector<IndexWindow> windows;
  Span open = spanAt(0);
  std::uint32_t last = open.high;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const Span triangle = spanAt(i);
    if (!triangle.fits()) return {};
    last = std::max(last, triangle.high);
    const Span both = hull(open, triangle);
    if (!both.fits()) windows.push_back({static_cast<std::uint32_t>(i), open.low});
    open = both.fits() ? both : triangle;
  }
  windows.push_back({static_cast<std::uint32_t>(indices.size()), open.low});
  const std::size_t fewest = last / kWindowVertices + 1;
  return windows.size() <= 2 * fewest ? windows : std::vector<IndexWindow>();
}

}  // namespace luxo
