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
#include "scene/scene_folder.h"

namespace luxo {

/// Safe from any thread.
class TextureFiles {
 public:
  /// `folder`: of the scene; empty: the current one.
  explicit TextureFiles(std::filesystem::path folder = {}, FileOptions options = {})
      : folder_(std::move(folder)), options_(std::move(options)) {}

  /// The image in a file that is named relative to the folder, and is in it, unless it may be
  /// outside; null where there is no such file. Error(Scene): it leads out of the folder, or what
  /// decodeTexture() says.
  [[nodiscard]] std::shared_ptr<const Texture> get(const std::string& name, Codes codes);
  /// On disk, of all textures so far.
  [[nodiscard]] std::vector<std::filesystem::path> files();
  /// What the textures so far were read from (scene/scene_folder.h).
  [[nodiscard]] FilesInMemory inMemory();

 private:
  [[nodiscard]] std::vector<std::filesystem::path> read();

  std::filesystem::path folder_;
  FileOptions options_;
  std::mutex mutex_;
  std::map<std::pair<std::string, Codes>, std::shared_ptr<const Texture>> textures_;
};

}  // namespace luxo
