// SPDX-License-Identifier: Apache-2.0
// Rendering to files: what `luxo render` and `luxo_grandpa -o` do with a scene.
#pragma once

#include <span>

#include "options.h"
#include "output_files.h"
#include "scene/scene.h"

namespace luxo {

/// Draws what is asked for and gives the exit code. One picture's failure is thrown; of several, the others
/// are still drawn, the failed ones are named, and the code says that some failed. Pictures appear whole or
/// not at all, and each is encoded while the next is drawn. `inputs` are not overwritten.
[[nodiscard]] int renderToFiles(Scene scene, const RenderRequest& request,
                                std::span<const NamedFile> inputs = {});

}  // namespace luxo
