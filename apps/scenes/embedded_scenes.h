// SPDX-License-Identifier: Apache-2.0
// The scene files of this folder, carried by the program.
#pragma once

#include <span>
#include <string_view>

namespace luxo {

struct EmbeddedScene {
  std::string_view name;  ///< of the file, without .luxo.json
  std::string_view text;
};

/// By name.
[[nodiscard]] std::span<const EmbeddedScene> embeddedScenes();

}  // namespace luxo
