// SPDX-License-Identifier: Apache-2.0
#include "scenes/gallery.h"

#include <string>
#include <utility>
#include <vector>

#include "scene/scene_reader.h"

namespace luxo {

SceneFile galleryDescription(const EmbeddedScene& scene) {
  SceneFile file = parseScene(std::string(scene.text), std::string(scene.name));
  file.source.shaders = galleryShaderFiles();
  return file;
}

std::shared_ptr<ShaderFiles> galleryShaderFiles() {
  std::vector<MaterialShader::File> files;
  for (const EmbeddedShader& shader : galleryShaders())
    files.push_back({std::string(shader.name), std::string(shader.text)});
  return std::make_shared<ShaderFiles>("gallery", std::move(files));
}

}  // namespace luxo
