// SPDX-License-Identifier: Apache-2.0
#include "scene/model_files.h"

namespace luxo {

std::shared_ptr<const Model> ModelFiles::get(const std::string& name, const MeshOptions& options) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Model>& model = models_[{name, options.normals, options.crease, options.tangents}];
  if (!model)
    model = std::make_shared<const Model>(
        readModel(fileInFolder(folder_, name, "model", options_), {.mesh = options,
                                                                   .allowOutside = options_.allowOutside,
                                                                   .from = options_.from,
                                                                   .progress = options_.progress}));
  return model;
}

std::vector<std::filesystem::path> ModelFiles::files() {
  return options_.from.isDisk() ? read() : std::vector<std::filesystem::path>();
}

FilesInMemory ModelFiles::inMemory() { return luxo::inMemory(read(), folder_, options_.from); }

std::vector<std::filesystem::path> ModelFiles::read() {
  const std::lock_guard lock(mutex_);
  std::vector<std::filesystem::path> files;
  for (const auto& [key, model] : models_)
    if (model) files.insert(files.end(), model->files.begin(), model->files.end());
  return files;
}

}  // namespace luxo
