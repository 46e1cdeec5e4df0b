// SPDX-License-Identifier: Apache-2.0
#include "mesh/model_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/file_suffix.h"
#include "mesh/model_target.h"

namespace luxo {
namespace {

constexpr std::array<std::string_view, 4> kWrittenSuffixes = {".obj", ".glb", ".ply", ".stl"};

}  // namespace

PlacedMesh::PlacedMesh(const Model& model, std::uint32_t node, const Transform& place, const LengthUnit& unit)
    : node_(&model.nodes[node]),
      mesh_(&model.meshes[node_->mesh]),
      place_(place),
      normals_(normalMatrix(place_.linear)),
      turned_(mirrors(place_)),
      metres_(unit.metres) {}

std::array<std::uint32_t, 3> PlacedMesh::corners(std::uint32_t triangle) const {
  const std::uint32_t* at = mesh_->indices().data() + std::size_t{3} * triangle;
  return {at[0], at[turned_ ? 2 : 1], at[turned_ ? 1 : 2]};
}

std::vector<PlacedMesh> placedMeshes(const Model& model, const LengthUnit& unit) {
  const std::vector<Transform> places = worldFromNodesAt(model);
  std::vector<PlacedMesh> placed;
  for (std::uint32_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].mesh != kNone) placed.emplace_back(model, i, places[i], unit);
  return placed;
}

std::string shownUpward(double metres, const LengthUnit& unit, int digits) {
  double length = metres / unit.metres;
  if (std::fma(length, unit.metres, -metres) < 0)
    length = std::nextafter(length, std::numeric_limits<double>::infinity());
  // Below a unit of the last digit, so that none is passed over.
  const double step = std::max(length * std::pow(10, -digits), std::numeric_limits<double>::denorm_min());
  std::string number;
  double read = -1;
  for (double up = length; !(read >= length); up += step) {
    number = fmt::format("{:.{}g}", up, digits);
    std::from_chars(number.data(), number.data() + number.size(), read);
  }
  return fmt::format("{} {}", number, unit.name);
}

std::vector<std::string> comments(const ModelClaim& claim, const LengthUnit& unit) {
  std::vector<std::string> lines;
  lines.push_back(std::isfinite(claim.deviation)
                      ? fmt::format("luxo: proven deviation {}, {}", shownUpward(claim.deviation, unit, 4),
                                    claim.closed ? "closed" : "open")
                      : fmt::format("luxo: deviation unknown, {}", claim.closed ? "closed" : "open"));
  if (claim.thickness > 0)
    lines.push_back(fmt::format("open surfaces are {:.6g} {} thick; the deviation is of their middles",
                                claim.thickness / unit.metres, unit.name));
  lines.push_back(fmt::format("coordinates in {}, y up", unit.name));
  return lines;
}

bool namesWrittenModel(const std::filesystem::path& path) {
  return std::find(kWrittenSuffixes.begin(), kWrittenSuffixes.end(), fileSuffix(path)) !=
         kWrittenSuffixes.end();
}

bool namesGlb(const std::filesystem::path& path) { return fileSuffix(path) == ".glb"; }

Kept keptBy(const std::filesystem::path& path) {
  const std::string suffix = fileSuffix(path);
  return suffix == ".stl"   ? Kept::Triangles
         : suffix == ".ply" ? Kept::Colours
         : suffix == ".obj" ? Kept::Materials
                            : Kept::All;
}

bool saidByMtl(const ModelMap& map) {
  return map.wrapU == map.wrapV && map.wrapU != ModelMap::Wrap::Mirror && map.angle == 0;
}

std::vector<std::filesystem::path> namesOf(const std::filesystem::path& path) {
  if (fileSuffix(path) != ".obj") return {path};
  std::filesystem::path materials = path;
  return {materials.replace_extension(".mtl"), path};
}

std::vector<ModelFile> filesOf(const Model& model, const std::filesystem::path& path, const ModelClaim& claim,
                               const LengthUnit& unit) {
  const std::string suffix = fileSuffix(path);
  if (!namesWrittenModel(path))
    throw Error(ErrorKind::Usage, fmt::format("'{}' names no model that can be written", path.string()),
                "models are written as .glb, .obj, .ply, .stl");
  if (namesGlb(path) && unit.metres != 1)
    throw Error(ErrorKind::Usage,
                fmt::format("'{}': a GLB is in metres, not in {}", path.string(), unit.name),
                "leave the unit out, or write another format");
  if (placedMeshes(model, unit).empty())
    throw Error(ErrorKind::Scene, fmt::format("'{}': there are no triangles to write", path.string()));
  if (suffix == ".obj") return writeObj(model, path, claim, unit);
  if (suffix == ".ply") return {{path, writePly(model, claim, unit)}};
  if (suffix == ".stl") return {{path, writeStl(model, claim, unit)}};
  return {{path, writeGlb(model, claim)}};
}

}  // namespace luxo
