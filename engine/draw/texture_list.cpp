// SPDX-License-Identifier: Apache-2.0
#include "draw/texture_list.h"

#include <algorithm>
#include <array>

#include "shared/scene_data.h"

namespace luxo {

std::size_t texelsOf(const Texture& texture) {
  std::size_t texels = 0;
  for (const TextureLevel& level : texture.levels) texels += level.halves.size() / 4;
  return texels;
}

void appendTexture(const Material& material, const Surface& surface, TextureList& textures,
                   std::vector<float>& numbers) {
  const TextureMap& map = material.map;
  std::size_t first = 0;
  auto listed = textures.begin();
  for (; listed != textures.end() && *listed != map.texture; ++listed) first += texelsOf(**listed);
  if (listed == textures.end()) textures.push_back(map.texture);
  const TexturePlacement placement = map.on(surface);
  const auto number = [](auto value) { return static_cast<float>(value); };
  const TextureLevel& level = map.texture->levels[0];
  const std::array<float, shared::kTextureNumbers> all{number(placement.linear[0].x),
                                                       number(placement.linear[0].y),
                                                       number(placement.linear[1].x),
                                                       number(placement.linear[1].y),
                                                       number(placement.constant.x),
                                                       number(placement.constant.y),
                                                       number(material.diffuse.x),
                                                       number(material.diffuse.y),
                                                       number(material.diffuse.z),
                                                       number(level.width),
                                                       number(level.height),
                                                       number(map.texture->levels.size()),
                                                       number(first / 65536),
                                                       number(first % 65536),
                                                       number(map.wrapU),
                                                       number(map.wrapV),
                                                       number(map.filter == TextureFilter::Nearest),
                                                       number(map.anisotropy)};
  numbers.insert(numbers.end(), all.begin(), all.end());
}

}  // namespace luxo
