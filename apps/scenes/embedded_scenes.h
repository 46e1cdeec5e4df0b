// SPDX-License-Identifier: Apache-2.0
// The scene files of this folder and of its gallery, carried by the program.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

namespace luxo {

struct EmbeddedScene {
  std::string_view name;  ///< of the file, without .luxo.json
  std::string_view text;
};

/// By name.
[[nodiscard]] std::span<const EmbeddedScene> embeddedScenes();

/// Those of gallery/, by name: `gallery/steel`.
[[nodiscard]] std::span<const EmbeddedScene> galleryScenes();

struct EmbeddedShader {
  std::string_view name;  ///< of the file: `gallery/steel.frag`
  std::string_view text;
};

/// The shaders of the gallery, and what they include.
[[nodiscard]] std::span<const EmbeddedShader> galleryShaders();
[[nodiscard]] inline bool isGalleryShader(std::string_view name) {
  return std::ranges::find(galleryShaders(), name, &EmbeddedShader::name) != galleryShaders().end();
}

}  // namespace luxo
