// SPDX-License-Identifier: Apache-2.0
#include "scenes/gallery.h"

#include <memory>
#include <span>
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
  FilesInMemory files;
  for (const EmbeddedShader& shader : galleryShaders()) {
    const auto bytes = std::as_bytes(std::span(shader.text));
    files[std::string(shader.name)] =
        std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
  }
  return std::make_shared<ShaderFiles>("gallery", FileSource(std::move(files)));
}

}  // namespace luxo
