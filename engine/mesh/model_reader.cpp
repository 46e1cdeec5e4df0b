// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/file_suffix.h"
#include "mesh/model_source.h"

namespace luxo {
namespace {

constexpr std::array<std::string_view, 5> kSuffixes = {".obj", ".gltf", ".glb", ".ply", ".stl"};

}  // namespace

bool namesModel(const std::filesystem::path& path) {
  return std::find(kSuffixes.begin(), kSuffixes.end(), fileSuffix(path)) != kSuffixes.end();
}

Model readModel(const std::filesystem::path& path, const ModelOptions& options) {
  if (!namesModel(path))
    throw Error(ErrorKind::Usage, fmt::format("'{}' does not name a model", path.string()),
                "models are .obj, .gltf, .glb, .ply, .stl");
  const std::string suffix = fileSuffix(path);
  FileBytes bytes = options.from.read(path);
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const ModelSource source(path, options);
  Model model = suffix == ".obj"   ? readObj(source, text)
                : suffix == ".ply" ? readPly(source, text)
                : suffix == ".stl" ? readStl(source, std::move(bytes))
                                   : readGltf(source, text);
  model.files = source.files();
  return model;
}

}  // namespace luxo
