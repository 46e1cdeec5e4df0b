// SPDX-License-Identifier: Apache-2.0
#include "scene/model_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace luxo {
namespace {

namespace fs = std::filesystem;

bool isInside(const fs::path& file, const fs::path& folder) {
  const auto [inFolder, inFile] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return inFolder == folder.end();
}

/// With all links followed: a link may lead out of a folder, too.
fs::path fileIn(const fs::path& folder, const std::string& name) {
  const auto refuse = [&](const char* why, const char* hint) {
    throw Error(ErrorKind::Scene, fmt::format("the model '{}' {}", name, why), hint);
  };
  if (name.empty()) refuse("has no name", "name a file beside the scene");
  if (fs::path(name).is_absolute())
    refuse("is named from the root", "name it relative to the folder of the scene");
  std::error_code failure;
  const fs::path inside = fs::weakly_canonical(folder.empty() ? "." : folder, failure);
  const fs::path file = fs::weakly_canonical(inside / name, failure);
  if (failure || !isInside(file, inside))
    refuse("is outside of the scene's folder", "put it into the folder of the scene, or into one below");
  return folder / name;
}

}  // namespace

std::shared_ptr<const Model> ModelFiles::get(const std::string& name, const MeshOptions& options) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Model>& model = models_[{name, options.normals, options.crease}];
  if (!model) model = std::make_shared<const Model>(readModel(fileIn(folder_, name), {.mesh = options}));
  return model;
}

std::vector<std::filesystem::path> ModelFiles::files() {
  const std::lock_guard lock(mutex_);
  std::vector<std::filesystem::path> files;
  for (const auto& [key, model] : models_)
    if (model) files.insert(files.end(), model->files.begin(), model->files.end());
  return files;
}

}  // namespace luxo
