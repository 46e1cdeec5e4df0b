// SPDX-License-Identifier: Apache-2.0
#include "draw/material_programs.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/log.h"

namespace luxo {
namespace {

void requireCurvature(const SnapshotNode& node, const Material& material) {
  if (!material.shader->readsCurvature() || material.curvature.valid() || node.surface.isPolygonal()) return;
  throw Error(
      ErrorKind::Scene,
      fmt::format("the shader '{}' reads the curvature of its surface, which material '{}' does not know",
                  material.shader->files.front().name, material.name),
      "give the material the surface's: Material::curvature = curvaturePattern(surface)");
}

}  // namespace

const MaterialProgram& MaterialPrograms::of(const MaterialShaderPtr& shader) {
  const auto known = programs_.find(shader);
  if (known != programs_.end()) return known->second;
  const MaterialProgram& program = programs_.emplace(shader, MaterialProgram(shader)).first->second;
  compiled_ += program.compiled();
  return program;
}

void MaterialPrograms::check(const Snapshot& snapshot, const VisibleList& visible) {
  tellShadows(snapshot);
  for (const auto* nodes : {&visible.opaque, &visible.transparent})
    for (const VisibleNode& one : *nodes) {
      const SnapshotNode& node = snapshot.nodes[one.node];
      const Material& material = snapshot.materials[node.material.index];
      if (!material.shader) continue;
      const MaterialProgram& program = of(material.shader);
      program.check(material);
      requireCurvature(node, material);
      for (const std::string& message : program.unused(material))
        if (told_.insert(message).second) log(LogLevel::Warning, message);
    }
  // Those of what comes into the picture again are there.
  std::erase_if(programs_, [&](const auto& entry) {
    return std::ranges::none_of(snapshot.materials,
                                [&](const Material& material) { return material.shader == entry.first; });
  });
}

/// Whether light gets through, who looks for shadows has to know without running a shader.
void MaterialPrograms::tellShadows(const Snapshot& snapshot) {
  for (const SnapshotNode& node : snapshot.nodes) {
    const Material& material = snapshot.materials[node.material.index];
    if (!material.shader || !material.shader->hasOpacity() || material.invisible()) continue;
    const bool casts = std::ranges::any_of(snapshot.lights, [&](const SnapshotLight& light) {
      return std::ranges::find(light.casters, node.id) != light.casters.end();
    });
    if (!casts) continue;
    const std::string message = fmt::format(
        "shadows do not know how opaque the shader '{}' says that the points of material '{}' are: they keep "
        "as much of a light from what is behind them as the material's \"opacity\" says",
        material.shader->files.front().name, material.name);
    if (told_.insert(message).second) log(LogLevel::Warning, message);
  }
}

}  // namespace luxo
