// SPDX-License-Identifier: Apache-2.0
#include "image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "image/ramp.h"
#include "image/srgb.h"

namespace luxo {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void requireSameShape(const Image& a, const Image& b) {
  if (a.width() == b.width() && a.height() == b.height() && a.channels() == b.channels()) return;
  throw Error(ErrorKind::Requirement,
              fmt::format("cannot compare {} x {} pixels of {} channels with {} x {} of {}", a.width(),
                          a.height(), a.channels(), b.width(), b.height(), b.channels()),
              "both pictures need the same size and the same channels");
}

bool isAlpha(std::size_t channel) { return channel == 3; }

int code8(float sample, std::size_t channel) {
  return isAlpha(channel) ? encodeAlpha8(sample) : encodeSrgb8(sample);
}

/// NaN counts as 0, as in the 8-bit encode.
double coded(float sample, std::size_t channel) {
  const double clamped = sample > 0 ? std::min<double>(sample, 1) : 0;
  return isAlpha(channel) ? clamped : srgbFromLinear(clamped);
}

double linearDifference(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double difference = std::abs(double(a) - double(b));
  return std::isnan(difference) ? kInfinity : difference;
}

double sampleDifference(float a, float b, std::size_t channel, ComparisonSpace space) {
  if (space == ComparisonSpace::Linear || std::isnan(a) != std::isnan(b)) return linearDifference(a, b);
  if (space == ComparisonSpace::Srgb) return std::abs(coded(a, channel) - coded(b, channel));
  return std::abs(code8(a, channel) - code8(b, channel)) / 255.0;
}

double pixelDifference(std::span<const float> a, std::span<const float> b, ComparisonSpace space) {
  double largest = 0;
  for (std::size_t c = 0; c < a.size(); ++c)
    largest = std::max(largest, sampleDifference(a[c], b[c], c, space));
  return largest;
}

template <class Visit>
void forEachPixel(const Image& a, const Image& b, const Visit& visit) {
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) visit(x, y, a.pixel(x, y), b.pixel(x, y));
}

}  // namespace

Comparison compare(const Image& a, const Image& b, ComparisonSpace space) {
  requireSameShape(a, b);
  Comparison result;
  double sum = 0, sumOfSquares = 0;
  forEachPixel(a, b, [&](int x, int y, std::span<const float> p, std::span<const float> q) {
    bool sameCodes = true;
    for (std::size_t c = 0; c < p.size(); ++c) {
      const double difference = sampleDifference(p[c], q[c], c, space);
      sum += difference;
      sumOfSquares += difference * difference;
      sameCodes = sameCodes && code8(p[c], c) == code8(q[c], c);
      if (std::isnan(p[c]) != std::isnan(q[c])) ++result.nanSamples;
      if (difference > result.max) {
        result.max = difference;
        result.maxX = x;
        result.maxY = y;
      }
    }
    if (!sameCodes) ++result.differingPixels8;
  });
  const auto samples = double(a.samples().size());
  result.pixels = std::int64_t(a.width()) * a.height();
  result.mean = samples > 0 ? sum / samples : 0;
  result.rmse = samples > 0 ? std::sqrt(sumOfSquares / samples) : 0;
  result.psnr = result.rmse == 0 ? kInfinity : -20 * std::log10(result.rmse);
  return result;
}

Image heatMap(const Image& a, const Image& b, ComparisonSpace space, double brightest) {
  requireSameShape(a, b);
  if (brightest <= 0) {
    forEachPixel(a, b, [&](int, int, std::span<const float> p, std::span<const float> q) {
      const double difference = pixelDifference(p, q, space);
      if (std::isfinite(difference)) brightest = std::max(brightest, difference);
    });
  }
  Image map(a.width(), a.height(), 3);
  forEachPixel(a, b, [&](int x, int y, std::span<const float> p, std::span<const float> q) {
    const double difference = pixelDifference(p, q, space);
    if (difference == 0) return;
    const auto colour = rampColor(difference < brightest ? difference / brightest : 1.0);
    std::copy(colour.begin(), colour.end(), map.pixel(x, y).begin());
  });
  return map;
}

}  // namespace luxo
