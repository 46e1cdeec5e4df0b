// SPDX-License-Identifier: Apache-2.0
// The gallery: what shaders can do, a scene each (apps/scenes/gallery). The program carries them with their
// shaders.
#pragma once

#include <memory>

#include "scene/scene_file.h"
#include "scene/shader_files.h"
#include "scenes/embedded_scenes.h"

namespace luxo {

/// One of galleryScenes(), as its file says it.
[[nodiscard]] SceneFile galleryDescription(const EmbeddedScene& scene);

/// The shaders, with what they include, by their files' names: steel.frag.
[[nodiscard]] std::shared_ptr<ShaderFiles> galleryShaderFiles();

}  // namespace luxo
