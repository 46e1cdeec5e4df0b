// SPDX-License-Identifier: Apache-2.0
// What colours a surface, as far as it decides a shader: a pattern, by its formulas, or the maps that there
// are: whichever textures these are of, the shader is the same.
#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <utility>

#include "scene/material.h"
#include "scene/pattern.h"

namespace luxo {

class Paint {
 public:
  Paint() = default;                                        ///< the same colour all over
  Paint(Pattern pattern) : pattern_(std::move(pattern)) {}  // NOLINT: a pattern is one
  /// Of a material: its maps, where it draws them, or its pattern.
  [[nodiscard]] static Paint of(const Material& material) {
    Paint paint(material.diffusePattern);
    if (!material.drawsMaps()) return paint;
    paint.maps_ = {.any = true,
                   .color = material.map.valid(),
                   .normal = material.normalMap.valid(),
                   .tangent = material.normalMap.valid() && material.normalSpace == NormalSpace::Tangent,
                   .specular = material.specularMap.valid(),
                   .glow = material.glowMap.valid(),
                   .lesson = material.lesson};
    return paint;
  }

  [[nodiscard]] bool valid() const { return maps_.any || pattern_.valid(); }
  [[nodiscard]] bool isTexture() const { return maps_.any; }
  /// Whether a point's tangent decides its light.
  [[nodiscard]] bool readsFrame() const { return maps_.tangent; }
  /// Included by shaders as "pattern", with preamble() before all; requires valid().
  [[nodiscard]] std::string_view glsl() const {
    return maps_.any ? "#include \"lib/texture.glsl\"\n" : std::string_view(pattern_.glsl());
  }
  /// Which maps there are, and where their numbers start, as appendMaps() (draw/texture_list.h) has them.
  [[nodiscard]] std::string preamble() const;

  friend bool operator==(const Paint&, const Paint&) = default;
  friend std::strong_ordering operator<=>(const Paint&, const Paint&) = default;

 private:
  struct Maps {
    bool any = false, color = false, normal = false, tangent = false, specular = false, glow = false,
         lesson = false;

    friend auto operator<=>(const Maps&, const Maps&) = default;
  };
  Pattern pattern_;
  Maps maps_;
};

}  // namespace luxo
