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

namespace luxo {

/// Safe from any thread.
class ModelFiles {
 public:
  /// `folder`: of the scene; empty: the current one.
  explicit ModelFiles(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

  /// The model in a file that is named relative to the folder, and is in it. Error(Scene): it leads out of
  /// the folder, or what readModel() says.
  [[nodiscard]] std::shared_ptr<const Model> get(const std::string& name, const MeshOptions& options);
  /// Of all models so far (mesh/model.h).
  [[nodiscard]] std::vector<std::filesystem::path> files();

 private:
  std::filesystem::path folder_;
  std::mutex mutex_;
  std::map<std::tuple<std::string, NormalRule, double, bool>, std::shared_ptr<const Model>> models_;
};

}  // namespace luxo
