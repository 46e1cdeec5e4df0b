// SPDX-License-Identifier: Apache-2.0
// The textures of a picture, and where on a surface they are.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "image/texture.h"
#include "scene/snapshot.h"

namespace luxo {

using TextureList = std::vector<std::shared_ptr<const Texture>>;

/// Texels of all levels.
[[nodiscard]] std::size_t texelsOf(const Texture& texture);

/// Appends the numbers by which shaders draw the material's maps on a node: for each that there is, the
/// colour's always, those of a texture (shared::kTextureLinear and on), of that of normals with what turns
/// its vectors; then for those that uniforms of its shader are; and its textures to the list where they are
/// not there: texels are in its order.
void appendMaps(const Material& material, const SnapshotNode& node, TextureList& textures,
                std::vector<float>& numbers);

/// Something to bind where shaders are laid out for textures and none is read.
void requireTexels(TextureList& textures);

}  // namespace luxo
