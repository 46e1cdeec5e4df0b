// SPDX-License-Identifier: Apache-2.0
// The formulas that travel with the triangles: what a GLB carries as LUXO_parametric_surface
// (mesh/gltf_writer.cpp), and who reads it back.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "image/file_source.h"
#include "scene/scene_builder.h"
#include "scene/scene_file.h"

namespace luxo {

struct CarriedScene {
  std::string text;
  /// Images, models, shaders, and what these name, as they are: those that there are.
  FilesInMemory files;
};

/// A scene with those values of its parameters and, where a moment is given, that as its own. It describes
/// the same scene to the bit (scene/scene_writer.h): its pictures have the same bytes, read from these files
/// alone (FileOptions::from). Required: a scene was built from the description, by a source of its own if it
/// names files; the overrides are of its parameters. Error(Scene): a file cannot be read any more.
[[nodiscard]] CarriedScene carriedScene(SceneFile file, std::span<const ParameterOverride> overrides = {},
                                        std::optional<double> timeSeconds = std::nullopt);

}  // namespace luxo
