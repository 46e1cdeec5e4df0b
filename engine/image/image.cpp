// SPDX-License-Identifier: Apache-2.0
#include "image/image.h"

#include "base/assert.h"
#include "image/format.h"

namespace luxo {
namespace {

std::size_t sampleCount(int width, int height, int channels) {
  LUXO_REQUIRE_COMPARE(width, >=, 1);
  LUXO_REQUIRE_COMPARE(height, >=, 1);
  LUXO_REQUIRE_COMPARE(width, <=, kMaxImageSide);
  LUXO_REQUIRE_COMPARE(height, <=, kMaxImageSide);
  LUXO_REQUIRE(channels == 1 || channels == 3 || channels == 4);
  return std::size_t(width) * std::size_t(height) * std::size_t(channels);
}

}  // namespace

Image::Image(int width, int height, int channels)
    : Image(width, height, channels, std::vector<float>(sampleCount(width, height, channels))) {}

Image::Image(int width, int height, int channels, std::vector<float> samples)
    : width_(width), height_(height), channels_(channels), samples_(std::move(samples)) {
  LUXO_REQUIRE_COMPARE(samples_.size(), ==, sampleCount(width, height, channels));
}

std::size_t Image::offsetOf(int x, int y) const {
  LUXO_ASSERT_COMPARE(x, >=, 0);
  LUXO_ASSERT_COMPARE(x, <, width_);
  LUXO_ASSERT_COMPARE(y, >=, 0);
  LUXO_ASSERT_COMPARE(y, <, height_);
  return (std::size_t(y) * std::size_t(width_) + std::size_t(x)) * std::size_t(channels_);
}

std::span<const float> Image::row(int y) const {
  return samples().subspan(offsetOf(0, y), std::size_t(width_) * std::size_t(channels_));
}

std::span<float> Image::row(int y) {
  return samples().subspan(offsetOf(0, y), std::size_t(width_) * std::size_t(channels_));
}

std::span<const float> Image::pixel(int x, int y) const {
  return samples().subspan(offsetOf(x, y), std::size_t(channels_));
}

std::span<float> Image::pixel(int x, int y) {
  return samples().subspan(offsetOf(x, y), std::size_t(channels_));
}

void Image::save(const std::filesystem::path& path) const { saveImage(*this, path); }

}  // namespace luxo
