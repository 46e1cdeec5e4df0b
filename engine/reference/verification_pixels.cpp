// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/sampling.h"
#include "reference/verification.h"

namespace luxo {

std::vector<std::uint32_t> spreadPixels(PixelSize size, std::uint64_t count) {
  const auto all = static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
  std::vector<std::uint32_t> pixels;
  if (count >= all) {
    pixels.resize(all);
    std::iota(pixels.begin(), pixels.end(), 0U);
    return pixels;
  }
  for (std::uint64_t k = 0; k < count; ++k) {
    const Vec2 place = quasirandomPoint(static_cast<double>(k) + 1);
    const auto x = static_cast<std::uint32_t>(place.x * size.width);
    const auto y = static_cast<std::uint32_t>(place.y * size.height);
    pixels.push_back(y * static_cast<std::uint32_t>(size.width) + x);
  }
  std::ranges::sort(pixels);
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
  return pixels;
}

std::vector<std::uint32_t> withNeighbours(PixelSize size, const std::vector<std::uint32_t>& pixels) {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t pixel : pixels) {
    const int x = static_cast<int>(pixel) % size.width, y = static_cast<int>(pixel) / size.width;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (x + dx >= 0 && y + dy >= 0 && x + dx < size.width && y + dy < size.height)
          all.push_back(static_cast<std::uint32_t>((y + dy) * size.width + x + dx));
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace luxo
