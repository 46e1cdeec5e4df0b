// SPDX-License-Identifier: Apache-2.0
// Reads the isolines of a material from a scene file.
#pragma once

#include <vector>

#include "scene/json.h"
#include "scene/scene_file.h"
#include "scene/scene_problems.h"

namespace luxo {

/// One object, or an array of them. What is wrong is among the problems.
void readIsolines(const JsonValue& value, SceneProblems& problems, std::vector<IsolinesDesc>& isolines);

}  // namespace luxo
