// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "image/ramp.h"
#include "reference/verification.h"

namespace luxo {
namespace {

using Color = std::array<float, 3>;

constexpr Color kNothing{0.02F, 0.02F, 0.02F}, kAlarm{1, 0, 0}, kWrong{1, 1, 1}, kInk{0.7F, 0.7F, 0.7F};
constexpr int kLowestDecade = -6;
constexpr int kStripHeight = 28, kBarHeight = 10, kGlyphScale = 2;

/// Three bits per row, from the top.
constexpr std::string_view kGlyphNames = "0123456789-epx";
constexpr std::array<std::array<unsigned char, 5>, 14> kGlyphs{{{7, 5, 5, 5, 7},
                                                                {2, 6, 2, 2, 7},
                                                                {7, 1, 7, 4, 7},
                                                                {7, 1, 7, 1, 7},
                                                                {5, 5, 7, 1, 1},
                                                                {7, 4, 7, 1, 7},
                                                                {7, 4, 7, 5, 7},
                                                                {7, 1, 2, 2, 2},
                                                                {7, 5, 7, 5, 7},
                                                                {7, 5, 7, 1, 7},
                                                                {0, 0, 7, 0, 0},
                                                                {0, 7, 7, 4, 7},
                                                                {0, 7, 5, 7, 4},
                                                                {0, 5, 2, 2, 5}}};
constexpr int kAdvance = 4 * kGlyphScale;

void paint(Image& image, int x, int y, const Color& color) {
  if (x >= 0 && y >= 0 && x < image.width() && y < image.height())
    std::ranges::copy(color, image.pixel(x, y).begin());
}

void write(Image& image, int x, int y, std::string_view text) {
  for (const char letter : text) {
    const std::size_t glyph = kGlyphNames.find(letter);
    for (int row = 0; glyph != std::string_view::npos && row < 5 * kGlyphScale; ++row)
      for (int column = 0; column < 3 * kGlyphScale; ++column)
        if ((kGlyphs[glyph][static_cast<std::size_t>(row / kGlyphScale)] >> (2 - column / kGlyphScale)) & 1)
          paint(image, x + column, y + row, kInk);
    x += kAdvance;
  }
}

/// From kLowestDecade at the left to 1 at the right, a mark at every decade and a label where it has room.
void drawLegend(Image& image, int top) {
  const int width = image.width();
  for (int y = top; y < image.height(); ++y)
    for (int x = 0; x < width; ++x)
      paint(image, x, y,
            y < top + kBarHeight ? rampColor(static_cast<double>(x) / std::max(width - 1, 1)) : kNothing);
  for (int decade = kLowestDecade; decade <= 0; ++decade) {
    const int x = (decade - kLowestDecade) * (width - 1) / -kLowestDecade;
    for (int y = top; y < top + kBarHeight + 3; ++y) paint(image, x, y, kInk);
    const std::string label = decade == 0 ? "1px" : "1e" + std::to_string(decade);
    const int length = static_cast<int>(label.size()) * kAdvance, pitch = width / -kLowestDecade;
    if (pitch < length || (pitch < 2 * length && decade % 2 != 0)) continue;
    write(image, std::clamp(x - length / 2, 0, std::max(width - length, 0)), top + kBarHeight + 5, label);
  }
}

}  // namespace

Image errorHeat(const Image& positionMap) {
  const int width = positionMap.width(), height = positionMap.height();
  Image heat(width, std::min(height + kStripHeight, kMaxImageSide), 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double error = positionMap.pixel(x, y)[0];
      if (error < 0)
        paint(heat, x, y, kNothing);
      else if (std::isfinite(error))
        paint(heat, x, y, rampColor(1 - std::log10(std::max(error, 1e-9)) / kLowestDecade));
    }
  const auto mark = [&](int reach, const Color& color) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int dy = -reach; dy <= reach && std::isinf(positionMap.pixel(x, y)[0]); ++dy)
          for (int dx = -reach; dx <= reach; ++dx)
            if (y + dy < height) paint(heat, x + dx, y + dy, color);
  };
  mark(1, kAlarm);
  mark(0, kWrong);
  if (heat.height() > height) drawLegend(heat, height);
  return heat;
}

}  // namespace luxo
