// SPDX-License-Identifier: Apache-2.0
#include "stability/pixels.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "image/srgb.h"

namespace luxo {

std::int64_t differingPixels(const Image& a, const Image& b) {
  const std::int64_t all = std::int64_t{a.width()} * a.height();
  if (a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels()) return all;
  std::int64_t count = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      count += std::memcmp(a.pixel(x, y).data(), b.pixel(x, y).data(), a.pixel(x, y).size_bytes()) != 0;
  return count;
}

int codeDifference(const Vec3& a, const Vec3& b) {
  int largest = 0;
  for (int c = 0; c < 3; ++c)
    largest = std::max(
        largest, std::abs(encodeSrgb8(static_cast<float>(a[c])) - encodeSrgb8(static_cast<float>(b[c]))));
  return largest;
}

int codeDifference(const Image& a, const Image& b, int x, int y) {
  return codeDifference(colorAt(a, x, y), colorAt(b, x, y));
}

std::int64_t samplesNotFinite(const Image& image) {
  return std::count_if(image.samples().begin(), image.samples().end(),
                       [](float sample) { return !std::isfinite(sample); });
}

Vec3 colorAt(const Image& image, int x, int y) {
  const auto p = image.pixel(x, y);
  return {p[0], p[1], p[2]};
}

Image flippedLeftRight(const Image& image) {
  Image flipped(image.width(), image.height(), image.channels());
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      std::ranges::copy(image.pixel(x, y), flipped.pixel(image.width() - 1 - x, y).begin());
  return flipped;
}

bool nearEdge(const reference::Caster& caster, int x, int y, double radius) {
  constexpr int kAround = 32;
  const auto colorOf = [&](double px, double py) {
    const reference::Ray ray = caster.rayThrough(px, py);
    bool certified = true;
    return caster.color(ray, caster.look(ray), certified);
  };
  const Vec3 center = colorOf(x + 0.5, y + 0.5);
  for (int k = 0; k < kAround; ++k) {
    const double angle = kTau * k / kAround;
    const Vec3 color = colorOf(x + 0.5 + radius * std::cos(angle), y + 0.5 + radius * std::sin(angle));
    if (codeDifference(color, center) > 1) return true;
  }
  return false;
}

}  // namespace luxo
