// SPDX-License-Identifier: Apache-2.0
// A material's own light: GLSL that says what colour a point has (shaders/MATERIALS.md is its page), and the
// values of its uniforms. Text only: nothing here compiles it.
#pragma once

#include <compare>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "scene/texture_map.h"

namespace luxo {

/// Before names that a wrapped shader has in common with luxo (MaterialShader::wrapped); messages leave it
/// out.
inline constexpr std::string_view kWrappedName = "luxoWrapped_";

/// Immutable.
struct MaterialShader {
  struct File {
    std::string name;  ///< as messages call it: its path
    std::string text;

    friend auto operator<=>(const File&, const File&) = default;
  };
  std::vector<File> files;  ///< the material's own first, then those that it includes, each once
  /// Which of them is the vertex program of one in the course's style (shaders/MATERIALS.md); what that
  /// includes is behind it. 0: none.
  std::size_t vertex = 0;
  /// Whether the first file is luxo's own, around those of the shader (apps/luxo/main_image.h).
  bool wrapped = false;

  /// Whether some point may send rays into the scene: its text has the word. This and the others: comments do
  /// not count, what #if leaves out does. Cost: reads the text.
  [[nodiscard]] bool traces() const;
  /// Whether its vertex program may lead a vertex elsewhere: it has one, and says more of gl_Position than
  /// ftransform() or the product that this stands for.
  [[nodiscard]] bool movesVertices() const;
  /// Whether it reads how its surface bends: there is a .K, .H, .k1 or .k2, be it of a struct of its own; a
  /// vertex program cannot.
  [[nodiscard]] bool readsCurvature() const;
  /// Whether it declares a uniform sampler2D of that name.
  [[nodiscard]] bool hasSampler(std::string_view name) const;
  /// Whether it declares a uniform bool of that name, or of a vector of them.
  [[nodiscard]] bool hasBool(std::string_view name) const;
  /// Whether its points may be seen through: it says how opaque they are, or has the word `discard`.
  [[nodiscard]] bool hasOpacity() const;
  /// Whether it says how opaque its points are: a line of it is `#pragma luxo opacity`.
  [[nodiscard]] bool saysOpacity() const;

  friend auto operator<=>(const MaterialShader&, const MaterialShader&) = default;
};
using MaterialShaderPtr = std::shared_ptr<const MaterialShader>;

/// A part of a text, for messages about it; without a text it is from C++.
struct TextPlace {
  std::string name = {};
  std::shared_ptr<const std::string> text = {};
  SourceRange where = {};

  /// As base/diagnostic.h has it.
  [[nodiscard]] std::string describe(const std::string& message, const std::string& hint) const;
  friend bool operator==(const TextPlace&, const TextPlace&) { return true; }
};

/// Of a matrix row after row; truth is 0 or 1. Of a sampler a texture, and no values.
struct UniformValue {
  std::string name;
  std::vector<double> values;
  TextPlace place = {};
  TextureMap map = {};
  bool truth = false;  ///< values are of true and false, for a bool only

  friend bool operator==(const UniformValue&, const UniformValue&) = default;
};

}  // namespace luxo
