// SPDX-License-Identifier: Apache-2.0
// What there is to know about a scene without drawing it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "viewer.h"

namespace luxo {

/// The tree of nodes, surfaces, materials, lights, cameras, parameters and counts at the settings' moment,
/// size and tolerance, with stable names. `warnings` are the reader's; those about what the surfaces are like
/// are added. Throws Error(Scene) where the scene has no picture of that moment.
[[nodiscard]] nlohmann::ordered_json inspectScene(const std::string& name, const ViewedScene& viewed,
                                                  std::vector<std::string> warnings);

/// The same as people read it.
[[nodiscard]] std::string inspectionText(const nlohmann::ordered_json& inspection);

}  // namespace luxo
