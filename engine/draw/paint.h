// SPDX-License-Identifier: Apache-2.0
// What colours a surface, as far as it decides a shader: a pattern, by its formulas, or a texture: these are
// all one shader.
#pragma once

#include <compare>
#include <string_view>
#include <utility>

#include "scene/material.h"
#include "scene/pattern.h"

namespace luxo {

class Paint {
 public:
  Paint() = default;                                        ///< the same colour all over
  Paint(Pattern pattern) : pattern_(std::move(pattern)) {}  // NOLINT: a pattern is one
  /// Of a material: its map, where it draws it, or its pattern.
  [[nodiscard]] static Paint of(const Material& material) {
    Paint paint(material.diffusePattern);
    paint.isTexture_ = material.drawsMap();
    return paint;
  }

  [[nodiscard]] bool valid() const { return isTexture_ || pattern_.valid(); }
  [[nodiscard]] bool isTexture() const { return isTexture_; }
  /// Included by shaders as "pattern", with preamble() before all; requires valid().
  [[nodiscard]] std::string_view glsl() const {
    return isTexture_ ? "#include \"lib/texture.glsl\"\n" : std::string_view(pattern_.glsl());
  }
  [[nodiscard]] std::string_view preamble() const { return isTexture_ ? "#define LUXO_TEXTURED\n" : ""; }

  friend bool operator==(const Paint&, const Paint&) = default;
  friend std::strong_ordering operator<=>(const Paint&, const Paint&) = default;

 private:
  Pattern pattern_;
  bool isTexture_ = false;
};

}  // namespace luxo
