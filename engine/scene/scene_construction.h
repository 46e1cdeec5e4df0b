// SPDX-License-Identifier: Apache-2.0
// The building of scenes that goes on when something is wrong, so that everything wrong is found.
#pragma once

#include <span>
#include <vector>

#include "scene/scene_builder.h"
#include "scene/scene_problems.h"

namespace luxo {

/// As buildScene(), but what is wrong with the description goes to `problems`; the scene then lacks it.
/// Throws Error(Usage) for what is wrong with an override.
[[nodiscard]] Scene constructScene(const SceneFile& file, std::span<const ParameterOverride> overrides,
                                   SceneProblems& problems, std::vector<Diagnostic>* warnings,
                                   WarningsAbout about = WarningsAbout::All);

}  // namespace luxo
