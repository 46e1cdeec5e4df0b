// SPDX-License-Identifier: Apache-2.0
#include "scene/texture_files.h"

namespace luxo {

std::shared_ptr<const Texture> TextureFiles::get(const std::string& name, Codes codes) {
  const std::filesystem::path file = fileInFolder(folder_, name, "texture", options_);
  if (!options_.from.has(file)) return nullptr;
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Texture>& texture = textures_[{name, codes}];
  if (!texture)
    texture = std::make_shared<const Texture>(decodeTexture(*options_.from.read(file), file.string(), codes));
  return texture;
}

std::vector<std::filesystem::path> TextureFiles::files() {
  return options_.from.isDisk() ? read() : std::vector<std::filesystem::path>();
}

FilesInMemory TextureFiles::inMemory() { return luxo::inMemory(read(), folder_, options_.from); }

std::vector<std::filesystem::path> TextureFiles::read() {
  const std::lock_guard lock(mutex_);
  std::vector<std::filesystem::path> files;
  for (const auto& [key, texture] : textures_) files.push_back(folder_ / key.first);
  return files;
}

}  // namespace luxo
