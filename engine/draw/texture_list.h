// SPDX-License-Identifier: Apache-2.0
// The textures of a picture, and where on a surface they are.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "image/texture.h"
#include "scene/material.h"
#include "surface/surface.h"

namespace luxo {

using TextureList = std::vector<std::shared_ptr<const Texture>>;

/// Texels of all levels.
[[nodiscard]] std::size_t texelsOf(const Texture& texture);

/// Appends the numbers by which shaders draw the material's map on a surface (shared::kTextureLinear and on),
/// and its texture to the list where it is not there: texels are in its order.
void appendTexture(const Material& material, const Surface& surface, TextureList& textures,
                   std::vector<float>& numbers);

}  // namespace luxo
