// SPDX-License-Identifier: Apache-2.0
#include "image/flip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"

namespace luxo {
namespace {

using Triple = std::array<double, 3>;

// Section and equation numbers are those of the paper.
constexpr double kColorExponent = 0.7;          // q_c, 4.1.4
constexpr double kFeatureExponent = 0.5;        // q_f, 4.2
constexpr double kCompressionStart = 0.4;       // p_c, 4.1.4
constexpr double kCompressionValue = 0.95;      // p_t
constexpr double kFeatureWidthDegrees = 0.082;  // w, 4.2

/// A contrast sensitivity filter is a sum of two Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kAchromatic{1, 0.0047, 0, 1e-5};
constexpr Sensitivity kRedGreen{1, 0.0053, 0, 1e-5};
constexpr Sensitivity kBlueYellow{34.1, 0.04, 13.5, 0.025};

Triple xyzFromLinear(const Triple& c) {
  return {(10135552.0 / 24577794) * c[0] + (8788810.0 / 24577794) * c[1] + (4435075.0 / 24577794) * c[2],
          (2613072.0 / 12288897) * c[0] + (8788810.0 / 12288897) * c[1] + (887015.0 / 12288897) * c[2],
          (1425312.0 / 73733382) * c[0] + (8788810.0 / 73733382) * c[1] + (70074185.0 / 73733382) * c[2]};
}

Triple linearFromXyz(const Triple& x) {
  return {3.241003275 * x[0] - 1.537398934 * x[1] - 0.498615861 * x[2],
          -0.969224334 * x[0] + 1.875930071 * x[1] + 0.041554224 * x[2],
          0.055639423 * x[0] - 0.204011202 * x[1] + 1.057148933 * x[2]};
}

/// XYZ of (1, 1, 1), to which colours are relative.
const Triple& white() {
  static const Triple kWhite = xyzFromLinear({1, 1, 1});
  return kWhite;
}

/// The linear opponent space in which the filters work.
Triple opponentFromXyz(const Triple& x) {
  const double r = x[0] / white()[0], g = x[1] / white()[1], b = x[2] / white()[2];
  return {116 * g - 16, 500 * (r - g), 200 * (g - b)};
}

Triple xyzFromOpponent(const Triple& o) {
  const double g = (o[0] + 16) / 116;
  return {(o[1] / 500 + g) * white()[0], g * white()[1], (g - o[2] / 200) * white()[2]};
}

/// CIE L*a*b* with the chroma scaled by lightness: dark colours differ less (Hunt effect).
Triple huntFromXyz(const Triple& x) {
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const double r = f(x[0] / white()[0]), g = f(x[1] / white()[1]), b = f(x[2] / white()[2]);
  const double lightness = 116 * g - 16;
  return {lightness, 0.01 * lightness * 500 * (r - g), 0.01 * lightness * 200 * (g - b)};
}

double hyab(const Triple& p, const Triple& q) {
  return std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]);
}

/// The colour difference as 0..1: of green and blue, the farthest apart, 1.
double rescaled(double distance) {
  static const double kLargest = std::pow(
      hyab(huntFromXyz(xyzFromLinear({0, 1, 0})), huntFromXyz(xyzFromLinear({0, 0, 1}))), kColorExponent);
  const double d = std::pow(distance, kColorExponent), knee = kCompressionStart * kLargest;
  return d < knee ? kCompressionValue / knee * d
                  : kCompressionValue + (d - knee) / (kLargest - knee) * (1 - kCompressionValue);
}

/// One number per pixel.
struct Plane {
  int width, height;
  std::vector<double> values;

  Plane(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  [[nodiscard]] double& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  [[nodiscard]] double at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// Weights from -radius to radius.
using Kernel = std::vector<double>;

/// Beyond the border the picture goes on as its last pixel.
Plane filtered(const Plane& in, const Kernel& alongX, const Kernel& alongY) {
  Plane half(in.width, in.height), out(in.width, in.height);
  const int rx = static_cast<int>(alongX.size() / 2), ry = static_cast<int>(alongY.size() / 2);
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      double sum = 0;
      for (int k = -rx; k <= rx; ++k)
        sum += alongX[static_cast<std::size_t>(k + rx)] * in.at(std::clamp(x + k, 0, in.width - 1), y);
      half.at(x, y) = sum;
    }
  for (int y = 0; y < in.height; ++y)
    for (int k = -ry; k <= ry; ++k) {
      const double weight = alongY[static_cast<std::size_t>(k + ry)];
      const int row = std::clamp(y + k, 0, in.height - 1);
      for (int x = 0; x < in.width; ++x) out.at(x, y) += weight * half.at(x, row);
    }
  return out;
}

Kernel gaussian(double b, double pixelsPerDegree, int radius) {
  Kernel kernel;
  for (int k = -radius; k <= radius; ++k) {
    const double x = k / pixelsPerDegree;
    kernel.push_back(std::exp(-std::numbers::pi * std::numbers::pi * x * x / b));
  }
  return kernel;
}

double sumOf(const Kernel& kernel) {
  double sum = 0;
  for (const double w : kernel) sum += w;
  return sum;
}

Plane seenBy(const Sensitivity& s, const Plane& in, double pixelsPerDegree) {
  // Three standard deviations of the widest filter.
  const int radius = static_cast<int>(
      std::ceil(3 * std::sqrt(kBlueYellow.b1 / (2 * std::numbers::pi * std::numbers::pi)) * pixelsPerDegree));
  Plane sum(in.width, in.height);
  double total = 0;
  for (const auto& [a, b] : {std::pair{s.a1, s.b1}, std::pair{s.a2, s.b2}}) {
    if (a == 0) continue;
    const Kernel kernel = gaussian(b, pixelsPerDegree, radius);
    const double weight = a * std::sqrt(std::numbers::pi / b);
    total += weight * sumOf(kernel) * sumOf(kernel);
    const Plane part = filtered(in, kernel, kernel);
    for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += weight * part.values[i];
  }
  for (double& value : sum.values) value /= total;
  return sum;
}

/// Length of the response to a derivative of a Gaussian along x and along y: 1 for edges, 2 for points.
Plane features(const Plane& lightness, int derivative, double pixelsPerDegree) {
  const double deviation = 0.5 * kFeatureWidthDegrees * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  Kernel smooth, slope;
  for (int k = -radius; k <= radius; ++k) {
    const double x = k / deviation, g = std::exp(-0.5 * x * x);
    smooth.push_back(g);
    slope.push_back(derivative == 1 ? -x * g : (x * x - 1) * g);
  }
  // Positive weights add up to 1 and negative ones to -1.
  double positive = 0, negative = 0;
  for (const double w : slope) (w > 0 ? positive : negative) += w;
  for (double& w : slope) w /= w > 0 ? positive : -negative;
  const double total = sumOf(smooth);
  for (double& w : smooth) w /= total;

  const Plane along = filtered(lightness, slope, smooth), down = filtered(lightness, smooth, slope);
  Plane length(lightness.width, lightness.height);
  for (std::size_t i = 0; i < length.values.size(); ++i)
    length.values[i] = std::hypot(along.values[i], down.values[i]);
  return length;
}

/// A picture as FLIP looks at it.
struct Percept {
  std::array<Plane, 3> color;  // Hunt-adjusted L*a*b*, after the eye's filters
  Plane edges, points;
};

Percept perceive(const Image& image, double pixelsPerDegree) {
  const int width = image.width(), height = image.height();
  std::array<Plane, 3> opponent{Plane(width, height), Plane(width, height), Plane(width, height)};
  Plane lightness(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto pixel = image.pixel(x, y);
      Triple rgb;
      for (std::size_t c = 0; c < 3; ++c) {
        const double sample = pixel[image.channels() == 1 ? 0 : c];
        rgb[c] = sample > 0 ? std::min(sample, 1.0) : 0;
      }
      const Triple o = opponentFromXyz(xyzFromLinear(rgb));
      for (std::size_t c = 0; c < 3; ++c) opponent[c].at(x, y) = o[c];
      lightness.at(x, y) = (o[0] + 16) / 116;
    }
  const Sensitivity* const filters[3] = {&kAchromatic, &kRedGreen, &kBlueYellow};
  for (std::size_t c = 0; c < 3; ++c) opponent[c] = seenBy(*filters[c], opponent[c], pixelsPerDegree);
  for (std::size_t i = 0; i < lightness.values.size(); ++i) {
    Triple rgb =
        linearFromXyz(xyzFromOpponent({opponent[0].values[i], opponent[1].values[i], opponent[2].values[i]}));
    for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
    const Triple hunt = huntFromXyz(xyzFromLinear(rgb));
    for (std::size_t c = 0; c < 3; ++c) opponent[c].values[i] = hunt[c];
  }
  return {std::move(opponent), features(lightness, 1, pixelsPerDegree),
          features(lightness, 2, pixelsPerDegree)};
}

}  // namespace

Flip flip(const Image& reference, const Image& test, const FlipOptions& options) {
  if (reference.width() != test.width() || reference.height() != test.height() ||
      reference.channels() != test.channels())
    throw Error(
        ErrorKind::Requirement,
        fmt::format("cannot compare {} x {} pixels of {} channels with {} x {} of {}", reference.width(),
                    reference.height(), reference.channels(), test.width(), test.height(), test.channels()),
        "both pictures need the same size and the same channels");
  Flip result{.map = Image(reference.width(), reference.height(), 1)};
  const Percept a = perceive(reference, options.pixelsPerDegree), b = perceive(test, options.pixelsPerDegree);
  const std::span<float> map = result.map.samples();
  double sum = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double color = rescaled(hyab({a.color[0].values[i], a.color[1].values[i], a.color[2].values[i]},
                                       {b.color[0].values[i], b.color[1].values[i], b.color[2].values[i]}));
    const double feature = std::max(std::abs(a.edges.values[i] - b.edges.values[i]),
                                    std::abs(a.points.values[i] - b.points.values[i]));
    const double difference = std::pow(color, 1 - std::pow(feature / std::numbers::sqrt2, kFeatureExponent));
    map[i] = static_cast<float>(difference);
    sum += difference;
    result.max = std::max(result.max, difference);
  }
  result.mean = sum / static_cast<double>(map.size());
  std::vector<float> sorted(map.begin(), map.end());
  const auto rank =
      sorted.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), rank, sorted.end());
  result.p999 = *rank;
  return result;
}

}  // namespace luxo
