// SPDX-License-Identifier: Apache-2.0
// What is allowed in a scene file but probably not meant.
#pragma once

#include <functional>
#include <vector>

#include "base/diagnostic.h"
#include "scene/scene_file.h"

namespace luxo {

/// Adds the warnings that need no scene: materials and surfaces that nobody uses, and quotients like 1/2u.
void addFileWarnings(const SceneFile& file, std::vector<Diagnostic>& warnings);

/// And of what lights say about another shadow than their own, which no picture shows.
void addShadowWarnings(const SceneFile& file, std::vector<Diagnostic>& warnings);

/// Visits every quantity of a description.
void forEachQuantity(const SceneFile& file, const std::function<void(const Quantity&)>& visit);

}  // namespace luxo
