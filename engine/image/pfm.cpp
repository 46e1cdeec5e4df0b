// SPDX-License-Identifier: Apache-2.0
#include "image/pfm.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include "base/assert.h"
#include "image/bytes.h"

namespace luxo {
namespace {

static_assert(std::endian::native == std::endian::little, "the writer copies floats as they lie in memory");

bool isSpace(std::byte b) { return b == std::byte{' '} || (b >= std::byte{'\t'} && b <= std::byte{'\r'}); }

// The next word of the text header, with the one white-space character after it removed from `left`.
std::string takeWord(std::span<const std::byte>& left, std::string_view name) {
  constexpr std::size_t kLongestWord = 32;
  while (!left.empty() && isSpace(left[0])) left = left.subspan(1);
  std::string word;
  while (!left.empty() && !isSpace(left[0]) && word.size() < kLongestWord) {
    word += char(left[0]);
    left = left.subspan(1);
  }
  if (left.empty() || !isSpace(left[0])) throwBadImage(name, "PFM", "the header is not complete");
  left = left.subspan(1);
  return word;
}

template <class Number>
Number takeNumber(std::span<const std::byte>& left, std::string_view name, std::string_view what) {
  const std::string word = takeWord(left, name);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size())
    throwBadImage(name, "PFM", fmt::format("its {}, '{}', is not a number", what, word));
  return value;
}

void swapByteOrder(std::span<float> samples) {
  for (float& sample : samples) {
    auto bytes = std::bit_cast<std::array<std::byte, sizeof(float)>>(sample);
    std::reverse(bytes.begin(), bytes.end());
    sample = std::bit_cast<float>(bytes);
  }
}

}  // namespace

std::vector<std::byte> encodePfm(const Image& image) {
  LUXO_REQUIRE(!image.empty());
  if (image.channels() == 4)
    throw Error(ErrorKind::Usage, "PFM has no alpha, and the picture has four channels", "use .exr or .png");
  std::vector<std::byte> out;
  const std::string header =
      fmt::format("{}\n{} {}\n-1.0\n", image.channels() == 3 ? "PF" : "Pf", image.width(), image.height());
  out.reserve(header.size() + image.samples().size_bytes());
  append(out, asBytes(header));
  for (int y = image.height() - 1; y >= 0; --y) append(out, std::as_bytes(image.row(y)));
  return out;
}

Image decodePfm(std::span<const std::byte> bytes, std::string_view name) {
  auto left = bytes;
  const std::string magic = takeWord(left, name);
  if (magic != "PF" && magic != "Pf") throwBadImage(name, "PFM", "it does not begin with PF or Pf");
  const int channels = magic == "PF" ? 3 : 1;
  const auto width = takeNumber<std::int64_t>(left, name, "width");
  const auto height = takeNumber<std::int64_t>(left, name, "height");
  const auto scale = takeNumber<double>(left, name, "scale");
  if (!std::isfinite(scale) || scale == 0) throwBadImage(name, "PFM", fmt::format("its scale is {}", scale));
  requirePlausibleSize(name, "PFM", width, height, double(sizeof(float)) * channels, left.size());

  Image image(int(width), int(height), channels);
  for (int y = image.height() - 1; y >= 0; --y) {
    const auto row = image.row(y);
    std::memcpy(row.data(), left.data(), row.size_bytes());
    left = left.subspan(row.size_bytes());
  }
  if (scale > 0) swapByteOrder(image.samples());
  return image;
}

}  // namespace luxo
