// SPDX-License-Identifier: Apache-2.0
// Colours for numbers, as formulas of scene files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_file.h"

namespace luxo {

/// Names, as they are asked for: viridis, from dark to bright; vik, from blue through white to brown, whose
/// middle is 0.
[[nodiscard]] std::vector<std::string> colormapNames();

/// Whether its middle stands for 0. Error(Usage): there is none of that name.
[[nodiscard]] bool isDiverging(std::string_view colormap);

/// Linear RGB of the value of a name that runs from 0 to 1: straight lines between ten colours of the map.
[[nodiscard]] Quantity3 colorsOf(std::string_view colormap, const std::string& name);

}  // namespace luxo
