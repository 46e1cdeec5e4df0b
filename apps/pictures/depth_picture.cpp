// SPDX-License-Identifier: Apache-2.0
#include "depth_picture.h"

#include <algorithm>
#include <cmath>

#include "image/srgb.h"

namespace luxo {
namespace {

constexpr double kFarthestGrey = 1.0 / 8;

}  // namespace

std::optional<Interval> depthsIn(const Image& depths) {
  std::optional<Interval> range;
  for (const float depth : depths.samples()) {
    if (!std::isfinite(depth)) continue;
    if (!range) range = Interval{depth, depth};
    range->lo = std::min<double>(range->lo, depth);
    range->hi = std::max<double>(range->hi, depth);
  }
  return range;
}

Image greyDepths(Image depths, const Interval& range) {
  const double perMetre = range.width() > 0 ? (1 - kFarthestGrey) / range.width() : 0;
  const auto grey = [&](float depth) {
    return linearFromSrgb(std::clamp(1 - (depth - range.lo) * perMetre, kFarthestGrey, 1.0));
  };
  for (float& sample : depths.samples())
    sample = std::isfinite(sample) ? static_cast<float>(grey(sample)) : 0.0F;
  return depths;
}

}  // namespace luxo
