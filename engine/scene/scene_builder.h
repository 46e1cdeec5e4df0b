// SPDX-License-Identifier: Apache-2.0
// From a description to a scene: formulas are parsed and compiled, names are resolved, surfaces are built.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "scene/scene.h"
#include "scene/scene_file.h"

namespace luxo {

/// `-P name=value`: replaces a parameter's value; its range stays.
struct ParameterOverride {
  std::string name;
  Quantity value;
};

/// What warnings tell: all that is probably not meant; or only what the picture goes without (files, maps,
/// what a light says about another shadow than its own), which is known at no cost.
enum class WarningsAbout { All, WhatIsLacking };

/// The scene of a description. Its parameters are those of the file, each after those that it needs; all of
/// them stay free: setParameter() changes the next snapshot and recompiles nothing.
///
/// Throws Error(Scene) whose what() shows every error of the description, and Error(Usage) for an override of
/// an unknown parameter, with a bad formula or out of range. Cost: linear; a constant node costs no more than
/// Scene::add(), a value with a formula one tape.
///
/// `warnings`, where given, takes what is allowed but probably not meant: holes in a surface with their
/// (u, v) region, kinks, things that nobody uses. Finding holes costs a few thousand evaluations per surface.
[[nodiscard]] Scene buildScene(const SceneFile& file, std::span<const ParameterOverride> overrides = {},
                               std::vector<Diagnostic>* warnings = nullptr,
                               WarningsAbout about = WarningsAbout::All);

}  // namespace luxo
