// SPDX-License-Identifier: Apache-2.0
#include "shader_options.h"

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include "base/error.h"
#include "shader_presets.h"

namespace luxo {

void addShaderOptions(CLI::App& command, ShaderOptions& options) {
  command.add_flag("--shadertoy", options.mainImage,
                   "of a shader file: run its mainImage over the picture, though it has a material, too");
  command.add_option("--preset", options.preset, "of a shader file: values saved beside it by luxo lab")
      ->type_name("NAME");
}

ShaderUse shaderUse(const std::string& file, const ShaderOptions& options) {
  if ((options.mainImage || options.preset) && !namesMaterialShader(file))
    throw Error(ErrorKind::Usage,
                fmt::format("{} is of shader files, and '{}' is none",
                            options.mainImage ? "--shadertoy" : "--preset", file),
                "name a file that ends in .frag or .glsl");
  ShaderUse use{.mainImage = options.mainImage};
  if (options.preset) use.preset = presetOf(file, *options.preset);
  return use;
}

}  // namespace luxo
