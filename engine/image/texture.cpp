// SPDX-License-Identifier: Apache-2.0
#include "image/texture.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "image/bytes.h"
#include "image/file.h"
#include "image/half.h"
#include "image/jpeg.h"
#include "image/png.h"
#include "image/tga.h"

namespace luxo {
namespace {

// Four floats a texel; the colours are multiplied by alpha where that weighs.
struct Level {
  int width, height;
  std::vector<float> values;

  Level(int w, int h) : width(w), height(h), values(4 * std::size_t(w) * std::size_t(h)) {}
  [[nodiscard]] float* at(int x, int y) {
    return &values[4 * (std::size_t(y) * std::size_t(width) + std::size_t(x))];
  }
  [[nodiscard]] const float* at(int x, int y) const {
    return &values[4 * (std::size_t(y) * std::size_t(width) + std::size_t(x))];
  }
};

// The texels that texel i of `to` covers of `from`, and how much of each, of 1 together.
struct Cover {
  int first = 0, count = 0;
  std::array<double, 4> weights{};

  Cover(int i, int from, int to) {
    const double scale = double(from) / to, begin = i * scale, end = (i + 1) * scale;
    first = int(begin);
    for (int k = first; k < from && k < end && count < 4; ++k, ++count)
      weights[std::size_t(count)] = (std::min(end, k + 1.0) - std::max(begin, double(k))) / scale;
  }
};

Level halved(const Level& from) {
  Level to(std::max(1, from.width / 2), std::max(1, from.height / 2));
  for (int y = 0; y < to.height; ++y) {
    const Cover rows(y, from.height, to.height);
    for (int x = 0; x < to.width; ++x) {
      const Cover columns(x, from.width, to.width);
      std::array<double, 4> sum{};
      for (int j = 0; j < rows.count; ++j)
        for (int i = 0; i < columns.count; ++i) {
          const float* value = from.at(columns.first + i, rows.first + j);
          const double weight = rows.weights[std::size_t(j)] * columns.weights[std::size_t(i)];
          for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * double(value[c]);
        }
      for (std::size_t c = 0; c < 4; ++c) to.at(x, y)[c] = float(sum[c]);
    }
  }
  return to;
}

TextureLevel stored(const Level& level, bool weighed) {
  TextureLevel result{level.width, level.height, std::vector<std::uint16_t>(level.values.size())};
  for (std::size_t i = 0; i < level.values.size(); i += 4) {
    const float alpha = level.values[i + 3], scale = weighed && alpha > 0 ? 1 / alpha : 1;
    for (std::size_t c = 0; c < 3; ++c) result.halves[i + c] = halfFromFloat(level.values[i + c] * scale);
    result.halves[i + 3] = halfFromFloat(alpha);
  }
  return result;
}

}  // namespace

std::array<float, 4> TextureLevel::texel(int x, int y) const {
  LUXO_ASSERT(x >= 0 && x < width && y >= 0 && y < height);
  const std::uint16_t* half = &halves[4 * (std::size_t(y) * std::size_t(width) + std::size_t(x))];
  return {floatFromHalf(half[0]), floatFromHalf(half[1]), floatFromHalf(half[2]), floatFromHalf(half[3])};
}

Texture makeTexture(const Image& image, std::string_view name, Codes codes) {
  LUXO_REQUIRE(!image.empty());
  if (std::max(image.width(), image.height()) > kMaxTextureSide)
    throw Error(ErrorKind::Scene,
                fmt::format("'{}' has {} x {} pixels, and a side of a texture is at most {}", name,
                            image.width(), image.height(), kMaxTextureSide));
  Texture texture;
  Level level(image.width(), image.height());
  const auto channels = std::size_t(image.channels());
  const auto samples = image.samples();
  for (std::size_t i = 0; i < level.values.size() / 4; ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      level.values[4 * i + c] = samples[channels * i + (channels == 1 ? 0 : c)];
    level.values[4 * i + 3] = channels == 4 ? samples[4 * i + 3] : 1.0f;
    texture.transparent = texture.transparent || level.values[4 * i + 3] < 1;
  }
  // The first level is as it is, also where its alpha is 0.
  texture.levels.push_back(stored(level, false));
  const bool weighed = texture.transparent && codes == Codes::Srgb;
  if (weighed)
    for (std::size_t i = 0; i < level.values.size(); ++i)
      if (i % 4 != 3) level.values[i] *= level.values[i | 3];
  while (level.width > 1 || level.height > 1) {
    level = halved(level);
    texture.levels.push_back(stored(level, weighed));
  }
  return texture;
}

Texture decodeTexture(std::span<const std::byte> bytes, std::string_view name, Codes codes) {
  const auto begins = [&](std::initializer_list<int> magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](int code, std::byte byte) { return code == std::to_integer<int>(byte); });
  };
  if (begins({0x89, 'P', 'N', 'G'})) return makeTexture(decodePng(bytes, name, codes), name, codes);
  if (begins({0xff, 0xd8, 0xff})) return makeTexture(decodeJpeg(bytes, name, codes), name, codes);
  if (mayBeTga(bytes)) return makeTexture(decodeTga(bytes, name, codes), name, codes);
  throw Error(ErrorKind::Scene,
              fmt::format("cannot read '{}': it is neither PNG, JPEG nor TGA", printable(name)));
}

Texture loadTexture(const std::filesystem::path& path, Codes codes) {
  return decodeTexture(readFile(path), path.string(), codes);
}

}  // namespace luxo
