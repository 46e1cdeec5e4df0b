// SPDX-License-Identifier: Apache-2.0
#include "scene/texture_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "base/error.h"
#include "image/image.h"
#include "scene/texture_files.h"

namespace luxo {
namespace {

constexpr int kCheckerSide = 512;      // texels, of few squares
constexpr double kMaxHalf = 65504;  // what textures hold

}  // namespace

TextureMap TextureBuilder::build(const TextureDesc& desc) {
  TextureMap map{.wrapU = desc.wrap, .wrapV = desc.wrap, .filter = desc.filter};
  if (const auto anisotropy = formulas_.once(desc.anisotropy)) {
    if (*anisotropy >= 1 && *anisotropy <= kMaxAnisotropy && *anisotropy == std::floor(*anisotropy))
      map.anisotropy = static_cast<std::uint32_t>(*anisotropy);
    else
      problems_.add(desc.anisotropy.place(), fmt::format("this is {}; it must be a whole number from 1 to {}",
                                                         *anisotropy, kMaxAnisotropy));
  }
  try {
    map.texture = imageOf(desc);
  } catch (const Error& error) {
    problems_.add(desc.file.place, error.what(), error.hint());
  }
  return map;
}

std::shared_ptr<const Texture> TextureBuilder::imageOf(const TextureDesc& desc) {
  if (desc.checker) return checker(desc);
  if (desc.color) {
    const Vec3 color = colorOf(*desc.color);
    Image image(1, 1, 3);
    for (std::size_t c = 0; c < 3; ++c) image.samples()[c] = static_cast<float>(color[static_cast<int>(c)]);
    return std::make_shared<const Texture>(makeTexture(image, desc.name.text));
  }
  if (desc.file.empty()) return nullptr;
  const std::shared_ptr<TextureFiles>& ofScene = problems_.source().textures;
  const auto files = ofScene ? ofScene : std::make_shared<TextureFiles>();
  auto texture = files->get(desc.file.text, desc.data ? Codes::Data : Codes::Srgb);
  if (!texture && warnings_)
    warnings_->push_back(
        {rangeOf(desc.file.place),
         fmt::format("there is no texture '{}': what it is on is drawn without", desc.file.text),
         "put it into the folder of the scene, or into one below"});
  return texture;
}

std::shared_ptr<const Texture> TextureBuilder::checker(const TextureDesc& desc) {
  const std::optional<double> squares = formulas_.once(desc.squares);
  const Vec3 colors[] = {colorOf((*desc.checker)[0]), colorOf((*desc.checker)[1])};
  if (!squares) return nullptr;
  if (!(*squares >= 2 && *squares <= kMaxCheckerSquares && std::fmod(*squares, 2) == 0)) {
    problems_.add(desc.squares.place(), fmt::format("this is {}; it must be an even number from 2 to {}",
                                                    *squares, kMaxCheckerSquares));
    return nullptr;
  }
  const int count = static_cast<int>(*squares), texels = std::max(2, kCheckerSide / count);
  Image image(count * texels, count * texels, 3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Vec3& color = colors[(x / texels + y / texels) % 2];
      const auto pixel = image.pixel(x, y);
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<float>(color[static_cast<int>(c)]);
    }
  return std::make_shared<const Texture>(makeTexture(image, desc.name.text));
}

Vec3 TextureBuilder::colorOf(const Quantity3& color) {
  Vec3 value(0);
  for (int i = 0; i < 3; ++i)
    value[i] =
        formulas_.once(color[static_cast<std::size_t>(i)], {{0, kMaxHalf}, "from 0 to 65504"}).value_or(0);
  return value;
}

}  // namespace luxo
