// SPDX-License-Identifier: Apache-2.0
// What colours a surface, as far as it decides a shader: a pattern, by its formulas, or the maps that there
// are: whichever textures these are of, the shader is the same; or a material's own shader.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "scene/isoline_set.h"
#include "scene/material.h"
#include "scene/pattern.h"

namespace luxo {

/// Which uniforms of a material's shader are given, and of how many numbers each: 0 of a texture.
using GivenUniforms = std::vector<std::pair<std::string, std::uint32_t>>;

class Paint {
 public:
  Paint() = default;                                        ///< the same colour all over
  Paint(Pattern pattern) : pattern_(std::move(pattern)) {}  // NOLINT: a pattern is one
  /// Of a material: its maps, where it draws them, or its pattern.
  [[nodiscard]] static Paint of(const Material& material) {
    Paint paint(material.diffusePattern);
    paint.isolines_ = material.isolines;
    if (!material.drawsMaps()) return paint;
    paint.maps_ = {.any = true,
                   .color = material.map.valid(),
                   .opacity = material.mapOpacity,
                   .normal = material.normalMap.valid(),
                   .tangent = material.normalMap.valid() && material.normalSpace == NormalSpace::Tangent,
                   .specular = material.specularMap.valid(),
                   .glow = material.glowMap.valid(),
                   .lesson = material.drawsLesson()};
    paint.shader_.text = material.shader;
    if (material.shader) paint.shader_.curvature = material.curvature;
    for (const UniformValue& uniform : material.uniforms)
      paint.shader_.given.emplace_back(
          uniform.name, uniform.map.valid() ? 0 : static_cast<std::uint32_t>(uniform.values.size()));
    return paint;
  }

  /// Of what lets light through, as far as that decides how much: its opacity and, where it tints the light,
  /// its colour.
  [[nodiscard]] static Paint ofCaster(const Material& material) {
    Paint paint(material.diffusePattern);
    if (material.mapSaysLightThrough())
      paint.maps_ = {.any = true, .color = true, .opacity = material.mapOpacity};
    return paint;
  }

  [[nodiscard]] bool valid() const { return maps_.any || pattern_.valid(); }
  [[nodiscard]] bool isTexture() const { return maps_.any; }
  /// Whether what of the surface a pixel covers decides its colour: a texture's, or that of isolines.
  [[nodiscard]] bool readsFootprint() const { return maps_.any || isolines_.valid(); }
  /// Whether a point's tangent decides its light.
  [[nodiscard]] bool readsFrame() const { return maps_.tangent || shader_.text; }
  /// Null: luxo's own light.
  [[nodiscard]] const MaterialShaderPtr& shader() const { return shader_.text; }
  [[nodiscard]] const GivenUniforms& given() const { return shader_.given; }
  /// Of the surface, for the shader; none where that does not read it.
  [[nodiscard]] const Pattern& curvature() const { return shader_.curvature; }
  /// Included by shaders as "pattern", with preamble() before all; requires valid().
  [[nodiscard]] std::string glsl() const;
  /// Which maps there are, and where their numbers start, as appendMaps() (draw/texture_list.h) has them.
  [[nodiscard]] std::string preamble() const;
  /// Where those of the textures that its shader's uniforms are given start: behind them are the shader's
  /// own.
  [[nodiscard]] std::uint32_t firstOfUniforms() const;
  [[nodiscard]] const IsolineSet& isolines() const { return isolines_; }

  friend bool operator==(const Paint&, const Paint&) = default;
  friend std::strong_ordering operator<=>(const Paint&, const Paint&) = default;

 private:
  struct Maps {
    bool any = false, color = false, opacity = false, normal = false, tangent = false, specular = false,
         glow = false, lesson = false;

    friend auto operator<=>(const Maps&, const Maps&) = default;
  };
  /// By content: whoever has read it, it is the same shader.
  struct Shader {
    MaterialShaderPtr text;
    GivenUniforms given;
    Pattern curvature;

    friend bool operator==(const Shader& a, const Shader& b) { return (a <=> b) == 0; }
    friend std::strong_ordering operator<=>(const Shader& a, const Shader& b) {
      if (a.text != b.text) {
        if (!a.text || !b.text) return bool(a.text) <=> bool(b.text);
        if (const auto order = *a.text <=> *b.text; order != 0) return order;
      }
      if (const auto order = a.given <=> b.given; order != 0) return order;
      return a.curvature <=> b.curvature;
    }
  };
  /// Where the numbers of the material's shader begin, or would.
  [[nodiscard]] std::uint32_t firstOfShader() const;
  /// Where those of the surface's curvature do.
  [[nodiscard]] std::uint32_t firstOfCurvature() const;
  /// Behind all others.
  [[nodiscard]] std::uint32_t firstOfIsolines() const;

  Pattern pattern_;
  IsolineSet isolines_;
  Maps maps_;
  Shader shader_;
};

}  // namespace luxo
