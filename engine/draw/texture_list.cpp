// SPDX-License-Identifier: Apache-2.0
#include "draw/texture_list.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "image/image.h"
#include "math/transform.h"
#include "scene/normal_map.h"
#include "shared/scene_data.h"

namespace luxo {

static_assert(shared::kWrapClamp == static_cast<std::uint32_t>(TextureWrap::Clamp) &&
              shared::kWrapMirror == static_cast<std::uint32_t>(TextureWrap::Mirror));

namespace {

/// Its first texel's index.
std::size_t listed(const std::shared_ptr<const Texture>& texture, TextureList& textures) {
  std::size_t first = 0;
  auto at = textures.begin();
  for (; at != textures.end() && *at != texture; ++at) first += texelsOf(**at);
  if (at == textures.end()) textures.push_back(texture);
  return first;
}

/// Of no map the tint alone counts.
void append(const TextureMap& map, const Vec3& tint, const Surface& surface, TextureList& textures,
            std::vector<float>& numbers) {
  std::array<float, shared::kTextureNumbers> all{};
  const auto put = [&](std::size_t first, auto... values) {
    ((all[first++] = static_cast<float>(values)), ...);
  };
  put(shared::kTextureTint, tint.x, tint.y, tint.z);
  if (map.valid()) {
    const std::size_t first = listed(map.texture, textures);
    const TexturePlacement placement = map.on(surface);
    const Mat2& linear = placement.linear;
    const TextureLevel& level = map.texture->levels[0];
    put(shared::kTextureLinear, linear[0].x, linear[0].y, linear[1].x, linear[1].y);
    put(shared::kTextureConstant, placement.constant.x, placement.constant.y);
    put(shared::kTextureSize, level.width, level.height);
    put(shared::kTextureLevels, map.texture->levels.size());
    put(shared::kTextureFirst, first / 65536, first % 65536);
    put(shared::kTextureWraps, map.wrapU, map.wrapV);
    put(shared::kTextureNearest, map.filter == TextureFilter::Nearest);
    put(shared::kTextureAnisotropy, map.anisotropy);
  }
  numbers.insert(numbers.end(), all.begin(), all.end());
}

}  // namespace

std::size_t texelsOf(const Texture& texture) {
  std::size_t texels = 0;
  for (const TextureLevel& level : texture.levels) texels += level.halves.size() / 4;
  return texels;
}

void appendMaps(const Material& material, const SnapshotNode& node, TextureList& textures,
                std::vector<float>& numbers) {
  append(material.map, material.diffuse, node.surface, textures, numbers);
  if (material.normalMap.valid()) {
    append(material.normalMap, Vec3(1), node.surface, textures, numbers);
    const Mat3 turn = normalFromTexel(material, normalMatrix(node.worldFromObject.linear));
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row) numbers.push_back(static_cast<float>(turn[column][row]));
  }
  if (material.specularMap.valid())
    append(material.specularMap, material.specular, node.surface, textures, numbers);
  if (material.glowMap.valid()) append(material.glowMap, material.glow, node.surface, textures, numbers);
  for (const UniformValue& uniform : material.uniforms)
    if (uniform.map.valid()) append(uniform.map, Vec3(1), node.surface, textures, numbers);
  requireTexels(textures);  // the lesson's formula may have no map
}

void requireTexels(TextureList& textures) {
  static const auto kNone = std::make_shared<const Texture>(makeTexture(Image(1, 1, 1, {1}), "none"));
  if (textures.empty()) textures.push_back(kNone);
}

}  // namespace luxo
