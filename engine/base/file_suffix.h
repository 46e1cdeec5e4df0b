// SPDX-License-Identifier: Apache-2.0
// What a file's name says about its format.
#pragma once

#include <filesystem>
#include <string>

namespace luxo {

/// The name's last suffix with its dot, letters A to Z made small; empty if there is none.
[[nodiscard]] inline std::string fileSuffix(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  for (char& c : suffix)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return suffix;
}

}  // namespace luxo
