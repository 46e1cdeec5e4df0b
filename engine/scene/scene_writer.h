// SPDX-License-Identifier: Apache-2.0
// Writes scene files: the same description always as the same text.
#pragma once

#include <string>

#include "scene/scene_file.h"

namespace luxo {

/// The text of a description; parseScene() of it gives an equal description. What has its default value is
/// left out; numbers are the shortest that read back the same, formulas are letter by letter; lines of at
/// most 110 characters where values allow. Comments and `x-` keys of a file that was read are gone. Required:
/// numbers are finite, names unique, nodes depth first, every surface has a shape.
[[nodiscard]] std::string writeScene(const SceneFile& file);

}  // namespace luxo
