// SPDX-License-Identifier: Apache-2.0
// A texture on a surface: where it lies on it, and its colour at a point as a pixel sees it. The filter is
// luxo's own, the same in double here and in float on a device (shaders/lib/texture.glsl), so that pictures
// with textures have a truth to be held against.
#pragma once

#include <cstdint>
#include <memory>

#include "image/texture.h"
#include "math/mat2.h"
#include "math/vec.h"
#include "surface/surface.h"

namespace luxo {

/// What is beyond the image: it again; its edge; it again, every other one mirrored.
enum class TextureWrap { Repeat, Clamp, Mirror };
/// Of both filters' levels the mean over what a pixel covers; or the texel that holds the point, as it is.
enum class TextureFilter { Trilinear, Nearest };

inline constexpr std::uint32_t kMaxAnisotropy = 16;
/// Of a footprint, images: whatever is more is all the same.
inline constexpr double kMaxTextureStep = 1e6;

/// How u and v move from a pixel to the next, in columns: one to the right, one below.
using Footprint = Mat2;

/// The place in a texture of a surface's (u, v).
struct TexturePlacement {
  Mat2 linear{1};
  Vec2 constant{0};
};

struct TextureMap {
  std::shared_ptr<const Texture> texture = nullptr;  ///< null: no map
  TextureWrap wrapU = TextureWrap::Repeat, wrapV = TextureWrap::Repeat;
  TextureFilter filter = TextureFilter::Trilinear;
  std::uint32_t anisotropy = 8;  ///< 1 to kMaxAnisotropy: how many times as long as wide what is filtered is
  /// Of the place in the image, whose upper left corner is (0, 0) and whose lower right one is (1, 1):
  /// place' = turned(angle) * (scale * place) + offset, where a turn takes right to down (glTF's
  /// KHR_texture_transform).
  Vec2 offset{0}, scale{1};
  double angle = 0;

  [[nodiscard]] bool valid() const { return texture != nullptr; }
  /// Triangles have their own (u, v), v down. On a formula the image is once over the whole domain, its lower
  /// left corner where u and v are lowest.
  [[nodiscard]] TexturePlacement on(const Surface& surface) const;
  /// Without this map's own offset, scale and angle.
  [[nodiscard]] static TexturePlacement onceOver(const Surface& surface);
  /// Linear RGB and alpha at a surface's (u, v). A footprint without a finite value is one over all.
  ///
  /// The footprint is an ellipse in the image. Along its longer axis lie samples, one its width apart, whose
  /// weights at both ends change with its length, so that nothing jumps; each blends the two levels next to
  /// the width. Colours are weighed by their alpha.
  [[nodiscard]] Vec4 at(const TexturePlacement& placement, const Vec2& uv, const Footprint& footprint) const;

  /// Textures by identity.
  friend bool operator==(const TextureMap&, const TextureMap&) = default;
};

}  // namespace luxo
