// SPDX-License-Identifier: Apache-2.0
// Reads the surfaces of a scene file.
#pragma once

#include <string>
#include <vector>

#include "scene/json.h"
#include "scene/scene_file.h"
#include "scene/scene_problems.h"

namespace luxo {

/// A surface without a shape when it cannot be read; why is among the problems.
[[nodiscard]] SurfaceDesc readSurface(const JsonValue& value, FileName name, SceneProblems& problems);

/// Every type a surface can have: the catalogue's and those with a structure of their own.
[[nodiscard]] std::vector<std::string> surfaceTypes();

}  // namespace luxo
