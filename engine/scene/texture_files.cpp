// SPDX-License-Identifier: Apache-2.0
#include "scene/texture_files.h"

#include "scene/scene_folder.h"

namespace luxo {

std::shared_ptr<const Texture> TextureFiles::get(const std::string& name, Codes codes) {
  const std::filesystem::path file = fileInFolder(folder_, name, "texture", allowOutside_);
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) return nullptr;
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Texture>& texture = textures_[{name, codes}];
  if (!texture) texture = std::make_shared<const Texture>(loadTexture(file, codes));
  return texture;
}

std::vector<std::filesystem::path> TextureFiles::files() {
  const std::lock_guard lock(mutex_);
  std::vector<std::filesystem::path> files;
  for (const auto& [key, texture] : textures_) files.push_back(folder_ / key.first);
  return files;
}

}  // namespace luxo
