// SPDX-License-Identifier: Apache-2.0
#include "image/ramp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxo {

// A ramp in OKLCh (Ottosson 2020, "A perceptual color space for image processing"): lightness rises evenly
// while the hue turns from violet over blue and green to yellow. The constants keep every colour within sRGB.
std::array<float, 3> rampColor(double t) {
  t = t > 0 ? std::min(t, 1.0) : 0;
  const double lightness = 0.30 + 0.62 * t;
  const double chroma = 0.09 + 0.03 * t;
  const double hue = (310.0 - 202.0 * t) * std::numbers::pi / 180;
  const double a = chroma * std::cos(hue);
  const double b = chroma * std::sin(hue);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {float(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          float(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          float(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace luxo
