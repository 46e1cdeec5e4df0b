// SPDX-License-Identifier: Apache-2.0
// What a surface does to light: L = ambient * La + sum over lights of (diffuse * N.L + specular *
// (N.H)^shininess) * Le.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "math/vec.h"
#include "scene/pattern.h"
#include "scene/shading.h"

namespace luxo {

/// Which faces are shown, and whether the normal turns toward the viewer.
enum class TwoSided {
  Auto,  ///< Yes for open surfaces; closed ones show both faces with their outward normal
  Yes,   ///< both faces are shown and the normal turns toward the viewer
  No,    ///< back faces are not shown
};

/// Colours are linear RGB factors.
struct Material {
  std::string name = "material";
  Vec3 diffuse{0.7};
  std::optional<Vec3> ambient = std::nullopt;  ///< the diffuse colour unless given
  Vec3 specular{0.2};
  double shininess = 30;  ///< exponent of Blinn's half vector
  double opacity = 1;     ///< 1 is opaque; less is blended over what lies behind
  TwoSided twoSided = TwoSided::Auto;
  std::optional<Shading> shading = std::nullopt;  ///< overrides the picture's shading, unless that shows data
  bool lectureSpecular = false;                   ///< highlights even where the light is below the horizon
  Pattern diffusePattern = {};  ///< stands for `diffuse`, and for the ambient colour unless that is given
  std::vector<double> patternParameters = {};  ///< as many as the pattern has

  [[nodiscard]] Vec3 ambientOrDiffuse() const { return ambient.value_or(diffuse); }
  [[nodiscard]] Shading shadingIn(Shading picture) const {
    return showsData(picture) ? picture : shading.value_or(picture);
  }
  [[nodiscard]] bool transparent() const { return opacity < 1; }
  friend bool operator==(const Material&, const Material&) = default;
};

/// Throws Error(Scene) naming the material and the value: colours and shininess must be from 0 to
/// kMaxSceneNumber (scene/ranges.h), opacity from 0 to 1.
void validate(const Material& material);

/// Cuts off colours and shininess at kMaxSceneNumber and gives how many numbers that were.
[[nodiscard]] std::uint32_t cutToRange(Material& material);

}  // namespace luxo
