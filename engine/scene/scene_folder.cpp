// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_folder.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/inside_folder.h"

namespace luxo {
namespace {

namespace fs = std::filesystem;

}  // namespace

fs::path fileInFolder(const fs::path& folder, const std::string& name, std::string_view kind,
                      const FileOptions& options) {
  const auto refuse = [&](const char* why, const char* hint) {
    throw Error(ErrorKind::Scene, fmt::format("the {} '{}' {}", kind, name, why), hint);
  };
  if (name.empty()) refuse("has no name", "name a file beside the scene");
  if (options.allowOutside || !options.from.isDisk()) return folder / name;
  if (fs::path(name).is_absolute())
    refuse("is named from the root", "name it relative to the folder of the scene, or --allow-outside");
  std::error_code failure;
  const fs::path inside = fs::weakly_canonical(folder.empty() ? "." : folder, failure);
  const fs::path file = fs::weakly_canonical(inside / name, failure);
  if (failure || !isInside(file, inside))
    refuse("is outside of the scene's folder",
           "put it into the folder of the scene or into one below, or --allow-outside");
  return folder / name;
}

FilesInMemory inMemory(std::span<const fs::path> files, const fs::path& folder, const FileSource& from) {
  FilesInMemory carried;
  for (const fs::path& file : files) {
    const fs::path name = isInside(file, folder) ? file.lexically_relative(folder) : file;
    if (from.has(file)) carried.try_emplace(name.lexically_normal().string(), from.read(file));
  }
  return carried;
}

}  // namespace luxo
