// SPDX-License-Identifier: Apache-2.0
#include "mesh/model_source.h"

#include <algorithm>

#include "base/inside_folder.h"

namespace luxo {
namespace {

/// With all links of the file followed: one may lead out of a folder, too. What cannot be followed (a loop,
/// too long a name) cannot be opened, either. The file's path is absolute: of one that is not, and does not
/// exist, weakly_canonical() makes no absolute one.
bool leadsOut(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code failure;
  const std::filesystem::path followed = std::filesystem::weakly_canonical(file, failure);
  return !failure && !isInside(followed, folder);
}

}  // namespace

void refuseModel(std::string_view name, const std::string& why, std::size_t line, const std::string& hint) {
  const std::string place = line == 0 ? std::string(name) : fmt::format("{}:{}", name, line);
  throw Error(ErrorKind::Scene, fmt::format("{}: {}", place, why), hint);
}

ModelSource::ModelSource(const std::filesystem::path& path, const ModelOptions& options)
    : path_(path), name_(printable(path.string())), options_(options), files_{path}, named_{path} {
  std::error_code ignored;
  const std::filesystem::path folder = path.parent_path();
  folder_ = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, ignored);
}

std::filesystem::path ModelSource::besides(std::string_view name, std::string_view inFile,
                                           std::size_t line) const {
  std::string slashed(name);
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const std::filesystem::path inside = std::filesystem::path(slashed).lexically_normal();
  const std::filesystem::path file = path_.parent_path() / inside;
  const bool drive = slashed.size() > 1 && slashed[1] == ':';
  if (!options_.allowOutside && from().isDisk() &&
      (inside.is_absolute() || drive || leadsOut(folder_ / inside, folder_)))
    refuseModel(inFile, fmt::format("'{}' is outside of the model's folder", printable(name.substr(0, 200))),
                line, "copy the file beside the model, or --allow-outside");
  if (named_.insert(file).second) files_.push_back(file);
  return file;
}

std::uint32_t ModelSource::image(Model& model, std::string_view name, std::string_view inFile,
                                 std::size_t line) const {
  const std::filesystem::path file = besides(name, inFile, line);
  const auto [known, fresh] = imageNumbers_.try_emplace(file, kNone);
  if (!fresh) return known->second;
  const std::string place = line == 0 ? std::string(inFile) : fmt::format("{}:{}", inFile, line);
  if (!from().has(file)) {
    model.warnings.push_back(
        fmt::format("{}: there is no image '{}'; it is drawn without", place, printable(name)));
    return kNone;
  }
  known->second = std::uint32_t(model.images.size());
  model.images.push_back({.name = printable(name),
                          .place = place,
                          .file = file,
                          .bytes = from().isDisk() ? nullptr : from().read(file)});
  return known->second;
}

bool ModelSource::addMesh(Model& model, MeshArrays arrays, std::string_view name, NormalRule given) const {
  if (!hasArea(arrays)) return false;
  MeshOptions options = options_.mesh;
  if (options.normals == NormalRule::Given) options.normals = given;
  const auto bent = [&](std::uint32_t material) { return model.materials[material].normalMap.given(); };
  options.tangents =
      options.tangents ||
      (arrays.materials.empty() ? bent(0)
                                : std::any_of(arrays.materials.begin(), arrays.materials.end(), bent));
  options.tangents = options.tangents && !arrays.uvs.empty();
  model.meshes.push_back(triangleMesh(std::move(arrays), name, options));
  const TriangleMesh& mesh = model.meshes.back();
  if (mesh.dropped() > 0)
    model.warnings.push_back(
        fmt::format("{}: {} triangles of '{}' have no area and are left out", name_, mesh.dropped(), name));
  if (mesh.edges().nonManifold > 0)
    model.warnings.push_back(fmt::format("{}: {} edges of '{}' are of three triangles or more", name_,
                                         mesh.edges().nonManifold, name));
  return true;
}

void ModelSource::addOnlyMesh(Model& model, MeshArrays arrays, NormalRule given) const {
  if (!addMesh(model, std::move(arrays), model.name, given))
    refuseModel(name_, "it has no triangle with an area");
  model.nodes.push_back({.name = model.name, .mesh = 0});
  tellProgress(1);
}

}  // namespace luxo
