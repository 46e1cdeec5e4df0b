// SPDX-License-Identifier: Apache-2.0
// A picture in memory: what every renderer hands out and every file format takes in.
// Samples are float32, scene-linear, interleaved, rows from top to bottom; nothing is clamped.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace luxo {

/// The longest side an image may have, in pixels (the limit of TGA's header).
inline constexpr int kMaxImageSide = 65535;

class Image {
 public:
  /// An empty image: width, height and channels are 0.
  Image() = default;

  /// All samples 0. Sides are 1..kMaxImageSide; channels 1 (one quantity), 3 (RGB) or 4 (RGB and linear
  /// alpha).
  Image(int width, int height, int channels);

  /// Takes over width * height * channels samples.
  Image(int width, int height, int channels, std::vector<float> samples);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] bool empty() const { return samples_.empty(); }

  [[nodiscard]] std::span<const float> samples() const { return samples_; }
  [[nodiscard]] std::span<float> samples() { return samples_; }

  /// Row y, counted from the top: width * channels samples.
  [[nodiscard]] std::span<const float> row(int y) const;
  [[nodiscard]] std::span<float> row(int y);

  /// The channels of the pixel in column x and row y, counted from the top left.
  [[nodiscard]] std::span<const float> pixel(int x, int y) const;
  [[nodiscard]] std::span<float> pixel(int x, int y);

  /// Writes the file in the format its suffix names; the same as saveImage (image/format.h), with its errors.
  void save(const std::filesystem::path& path) const;

 private:
  [[nodiscard]] std::size_t offsetOf(int x, int y) const;

  int width_ = 0;
  int height_ = 0;
  int channels_ = 0;
  std::vector<float> samples_;
};

}  // namespace luxo
