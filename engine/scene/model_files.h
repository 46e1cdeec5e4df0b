// SPDX-License-Identifier: Apache-2.0
// The models that a scene file names: each is read once, however often the scene is built.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <vector>

#include "mesh/model.h"
#include "scene/scene_folder.h"

namespace luxo {

/// Safe from any thread.
class ModelFiles {
 public:
  /// `folder`: of the scene; empty: the current one.
  explicit ModelFiles(std::filesystem::path folder = {}, FileOptions options = {})
      : folder_(std::move(folder)), options_(std::move(options)) {}

  /// The model in a file that is named relative to the folder, and is in it, unless
  /// it may be outside. Error(Scene): it leads out of the folder, or what readModel() says.
  [[nodiscard]] std::shared_ptr<const Model> get(const std::string& name, const MeshOptions& options);
  /// On disk, of all models so far (mesh/model.h).
  [[nodiscard]] std::vector<std::filesystem::path> files();
  /// What the models so far were read from, images included (scene/scene_folder.h).
  [[nodiscard]] FilesInMemory inMemory();

 private:
  [[nodiscard]] std::vector<std::filesystem::path> read();

  std::filesystem::path folder_;
  FileOptions options_;
  std::mutex mutex_;
  std::map<std::tuple<std::string, NormalRule, double, bool>, std::shared_ptr<const Model>> models_;
};

}  // namespace luxo
