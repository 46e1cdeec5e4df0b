// SPDX-License-Identifier: Apache-2.0
// The images that a scene file names as textures: each is read once, however often the scene is built.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "image/codes.h"
#include "image/texture.h"

namespace luxo {

/// Safe from any thread.
class TextureFiles {
 public:
  /// `folder`: of the scene; empty: the current one.
  explicit TextureFiles(std::filesystem::path folder = {}, bool allowOutside = false)
      : folder_(std::move(folder)), allowOutside_(allowOutside) {}

  /// The image in a file that is named relative to the folder, and is in it, unless it may be
  /// outside; null where there is no such file. Error(Scene): it leads out of the folder, or what
  /// loadTexture() says.
  [[nodiscard]] std::shared_ptr<const Texture> get(const std::string& name, Codes codes);
  /// Of all textures so far.
  [[nodiscard]] std::vector<std::filesystem::path> files();

 private:
  std::filesystem::path folder_;
  bool allowOutside_;
  std::mutex mutex_;
  std::map<std::pair<std::string, Codes>, std::shared_ptr<const Texture>> textures_;
};

}  // namespace luxo
