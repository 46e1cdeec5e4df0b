// SPDX-License-Identifier: Apache-2.0
#include "mesh/model_source.h"

#include <algorithm>

namespace luxo {

void refuseModel(std::string_view name, const std::string& why, std::size_t line, const std::string& hint) {
  const std::string place = line == 0 ? std::string(name) : fmt::format("{}:{}", name, line);
  throw Error(ErrorKind::Scene, fmt::format("{}: {}", place, why), hint);
}

std::filesystem::path ModelSource::besides(std::string_view name, std::string_view inFile,
                                           std::size_t line) const {
  std::string slashed(name);
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const std::filesystem::path inside = std::filesystem::path(slashed).lexically_normal();
  const bool drive = slashed.size() > 1 && slashed[1] == ':';
  if (!options_.allowOutside && (inside.is_absolute() || drive || *inside.begin() == ".."))
    refuseModel(inFile, fmt::format("'{}' is outside of the model's folder", printable(name.substr(0, 200))),
                line, "copy the file beside the model, or allow files outside");
  const std::filesystem::path file = path_.parent_path() / inside;
  if (std::find(files_.begin(), files_.end(), file) == files_.end()) files_.push_back(file);
  return file;
}

std::uint32_t ModelSource::image(Model& model, std::string_view name, std::string_view inFile,
                                 std::size_t line) const {
  const std::filesystem::path file = besides(name, inFile, line);
  for (std::uint32_t i = 0; i < model.images.size(); ++i)
    if (model.images[i].file == file) return i;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    const std::string place = line == 0 ? std::string(inFile) : fmt::format("{}:{}", inFile, line);
    std::string warning =
        fmt::format("{}: there is no image '{}'; it is drawn without", place, printable(file.string()));
    const std::string_view what = std::string_view(warning).substr(warning.find(": "));
    if (std::none_of(model.warnings.begin(), model.warnings.end(),
                     [&](const std::string& other) { return other.ends_with(what); }))
      model.warnings.push_back(std::move(warning));
    return kNone;
  }
  model.images.push_back({.name = printable(name), .file = file});
  return std::uint32_t(model.images.size() - 1);
}

void ModelSource::addMesh(Model& model, MeshArrays arrays, std::string_view name, NormalRule given) const {
  MeshOptions options = options_.mesh;
  if (options.normals == NormalRule::Given) options.normals = given;
  const bool mapped = std::any_of(model.materials.begin(), model.materials.end(),
                                  [](const ModelMaterial& material) { return material.normalMap.given(); });
  options.tangents = (options.tangents || mapped) && !arrays.uvs.empty();
  model.meshes.push_back(triangleMesh(std::move(arrays), name, options));
  const TriangleMesh& mesh = model.meshes.back();
  if (mapped && mesh.uvs().empty())
    model.warnings.push_back(fmt::format("{}: '{}' has no uvs: its maps are not drawn", name_, name));
  if (mesh.dropped() > 0)
    model.warnings.push_back(
        fmt::format("{}: {} triangles of '{}' have no area and are left out", name_, mesh.dropped(), name));
  if (mesh.edges().nonManifold > 0)
    model.warnings.push_back(fmt::format("{}: {} edges of '{}' are of three triangles or more", name_,
                                         mesh.edges().nonManifold, name));
}

}  // namespace luxo
