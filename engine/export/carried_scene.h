// SPDX-License-Identifier: Apache-2.0
// The formulas that travel with the triangles: what a GLB carries as LUXO_parametric_surface
// (mesh/gltf_writer.cpp), and who reads it back.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "scene/scene_builder.h"
#include "scene/scene_file.h"

namespace luxo {

/// The text of a scene with those values of its parameters and, where a moment is given, that as its own. It
/// describes the same scene to the bit (scene/scene_writer.h): its pictures have the same bytes. Nothing
/// where the scene is not all in its text: it names files. Required: the overrides are of its parameters.
[[nodiscard]] std::optional<std::string> carriedScene(SceneFile file,
                                                      std::span<const ParameterOverride> overrides = {},
                                                      std::optional<double> timeSeconds = std::nullopt);

/// Whether a description names files: models, images.
[[nodiscard]] bool namesFiles(const SceneFile& file);

}  // namespace luxo
