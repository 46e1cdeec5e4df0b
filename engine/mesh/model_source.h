// SPDX-License-Identifier: Apache-2.0
// What the readers of model files share: their bytes, the files that they name, one shape of error.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/printable.h"
#include "mesh/model.h"

namespace luxo {

/// Error(Scene): "head.obj:12: why"; line 0: none.
[[noreturn]] void refuseModel(std::string_view name, const std::string& why, std::size_t line = 0,
                              const std::string& hint = {});

/// A model file that is being read.
class ModelSource {
 public:
  ModelSource(const std::filesystem::path& path, const ModelOptions& options);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const ModelOptions& options() const { return options_; }

  /// Where its files are.
  [[nodiscard]] const FileSource& from() const { return options_.from; }
  /// A file that the model names, whether there is one or not. Backslashes are slashes. Error(Scene) where
  /// the name, or a link, leads out of the model's folder, unless that is allowed or both are in memory.
  [[nodiscard]] std::filesystem::path besides(std::string_view name, std::string_view inFile,
                                              std::size_t line) const;
  /// The number of an image of the model, taken in where it is new; where there is no such file, kNone, and
  /// one warning.
  [[nodiscard]] std::uint32_t image(Model& model, std::string_view name, std::string_view inFile,
                                    std::size_t line) const;

  /// The model's, and all that besides() was asked for.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

  void tellProgress(double part) const {
    if (options_.progress) options_.progress(part);
  }

  /// A mesh of what was read, with its warnings; tangents where one of its materials has a normal map, and it
  /// uvs. False, and nothing is added: none of its triangles has an area.
  [[nodiscard]] bool addMesh(Model& model, MeshArrays arrays, std::string_view name,
                             NormalRule given = NormalRule::Given) const;
  /// That of a format that has one, at one node, both by the name of the model. Error(Scene): no area.
  void addOnlyMesh(Model& model, MeshArrays arrays, NormalRule given = NormalRule::Given) const;

 private:
  std::filesystem::path path_;
  std::string name_;
  const ModelOptions& options_;
  std::filesystem::path folder_;  ///< with all links followed
  mutable std::vector<std::filesystem::path> files_;
  mutable std::set<std::filesystem::path> named_;                        ///< files_, to be found
  mutable std::map<std::filesystem::path, std::uint32_t> imageNumbers_;  ///< kNone: there is no such file
};

/// Readers of one format each; the bytes are those of the source's file. One mesh at one node, but for glTF.
/// That of STL lets go of them before it makes the mesh.
[[nodiscard]] Model readObj(const ModelSource& source, std::string_view text);
[[nodiscard]] Model readPly(const ModelSource& source, std::string_view bytes);
[[nodiscard]] Model readStl(const ModelSource& source, FileBytes file);
[[nodiscard]] Model readGltf(const ModelSource& source, std::string_view bytes);

}  // namespace luxo
