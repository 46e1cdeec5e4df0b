// SPDX-License-Identifier: Apache-2.0
// The shaders that a scene file names, with the files that they include: each is read once, however often the
// scene is built.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/material_shader.h"
#include "scene/scene_folder.h"

namespace luxo {

/// Of one file, and of files of one shader: a hundred times what a long one has.
inline constexpr std::size_t kMaxShaderBytes = std::size_t{1} << 18, kMaxShaderFiles = 64;

/// The fragment program of a vertex program that has none: what the fixed functionality does with one
/// texture. Its name is no file's.
extern const MaterialShader::File kFixedFragments;

/// All files on disk that the shader in one is made of, there or not: those that it includes, and those that
/// they do, as far as they can be read. It comes first.
[[nodiscard]] std::vector<std::filesystem::path> filesNamedBy(const std::filesystem::path& shader);

/// Safe from any thread.
class ShaderFiles {
 public:
  /// `folder`: of the scene; empty: the current one.
  explicit ShaderFiles(std::filesystem::path folder = {}, FileSource from = {})
      : folder_(std::move(folder)), options_{.from = std::move(from)} {}

  /// The shader in a file that is named relative to the folder, and is in it. What it includes is named
  /// relative to the including file, and is in the shader's folder or below. Error(Scene): a file leads out
  /// of these, is not there or too long; of an include with its file, line and column.
  /// `vertex`: a vertex program's file in the same way; empty: none. With an empty `name` what the fixed
  /// functionality does is its fragment program (shaders/MATERIALS.md).
  [[nodiscard]] MaterialShaderPtr get(const std::string& name, const std::string& vertex = {});
  /// Gives a name to a shader that is in no file of that name: get() finds it first.
  void put(const std::string& name, MaterialShaderPtr shader);
  /// On disk, of all shaders so far, what they include among them; of one that cannot be read all that it
  /// names.
  [[nodiscard]] std::vector<std::filesystem::path> files();
  /// What the shaders so far were read from (scene/scene_folder.h).
  [[nodiscard]] FilesInMemory inMemory();

 private:
  [[nodiscard]] std::vector<std::filesystem::path> read();
  /// Adds to the files those that files[index] includes.
  void addIncluded(std::vector<MaterialShader::File>& files, std::size_t index,
                   const std::filesystem::path& folder) const;

  std::filesystem::path folder_;
  FileOptions options_;  ///< no shader is outside
  std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, MaterialShaderPtr> shaders_;  ///< vertex programs second
};

}  // namespace luxo
