// SPDX-License-Identifier: Apache-2.0
#include "draw/paint.h"

#include <fmt/format.h>

#include <cstdint>

#include "shared/scene_data.h"

namespace luxo {

std::string Paint::preamble() const {
  if (!maps_.any) return isolines_.valid() ? "#define LUXO_TEXTURED\n" : "";
  std::string lines = "#define LUXO_TEXTURED\n";
  std::uint32_t first = shared::kTextureNumbers;  // the colour's are always there
  const auto define = [&](bool has, std::string_view name, std::uint32_t numbers) {
    if (!has) return;
    lines += fmt::format("#define {} {}u\n", name, first);
    first += numbers;
  };
  if (maps_.color) lines += "#define LUXO_COLOR_MAP\n";
  if (maps_.opacity) lines += "#define LUXO_MAP_OPACITY\n";
  define(maps_.normal, "LUXO_NORMAL_MAP", shared::kTextureNumbers + shared::kNormalNumbers);
  define(maps_.specular, "LUXO_SPECULAR_MAP", shared::kTextureNumbers);
  define(maps_.glow, "LUXO_GLOW_MAP", shared::kTextureNumbers);
  if (readsFrame()) lines += "#define LUXO_FRAMED\n";
  if (shader_.text)
    lines += fmt::format("#define LUXO_SHADER\n#define LUXO_SHADER_NUMBERS {}u\n", firstOfShader());
  if (shader_.curvature.valid())
    lines += fmt::format("#define LUXO_CURVATURE_NUMBERS {}u\n", firstOfCurvature() - firstOfShader());
  if (shader_.text && shader_.text->traces()) lines += "#define LUXO_TRACES\n";
  if (shader_.text && shader_.text->hasOpacity()) lines += "#define LUXO_OPACITY\n";
  if (maps_.lesson) lines += "#define LUXO_LESSON\n";
  if (firstOfUniforms() > shared::kTextureNumbers || maps_.lesson) lines += "#define LUXO_MAPS\n";
  return lines;
}

std::uint32_t Paint::firstOfUniforms() const {
  std::uint32_t numbers = shared::kTextureNumbers;
  if (maps_.normal) numbers += shared::kTextureNumbers + shared::kNormalNumbers;
  for (const bool has : {maps_.specular, maps_.glow})
    if (has) numbers += shared::kTextureNumbers;
  return numbers;
}

std::uint32_t Paint::firstOfShader() const {
  std::uint32_t numbers = firstOfUniforms();
  for (const auto& [name, count] : shader_.given)
    if (count == 0) numbers += shared::kTextureNumbers;
  return numbers;
}

std::uint32_t Paint::firstOfCurvature() const {
  std::uint32_t numbers = firstOfShader() + shared::kShaderNumbers;
  for (const auto& [name, count] : shader_.given) numbers += count;
  return numbers;
}

std::uint32_t Paint::firstOfIsolines() const {
  if (!maps_.any) return static_cast<std::uint32_t>(pattern_.parameterCount());
  if (!shader_.text) return firstOfShader();
  return firstOfCurvature() + static_cast<std::uint32_t>(shader_.curvature.parameterCount());
}

std::string Paint::glsl() const {
  std::string text = maps_.any ? "#include \"lib/texture.glsl\"\n" : pattern_.glsl();
  if (!isolines_.valid()) return text;
  text +=
      fmt::format("#define LUXO_FIRST_OF_ISOLINES {}u\n#include \"lib/isolines.glsl\"\n", firstOfIsolines());
  return text + isolines_.glsl();
}

}  // namespace luxo
