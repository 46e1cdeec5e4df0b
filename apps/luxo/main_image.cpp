// SPDX-License-Identifier: Apache-2.0
#include "main_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "base/error.h"
#include "base/glsl_tokens.h"
#include "scene/shader_text.h"

namespace luxo {
namespace {

/// Whether `type name (` stands somewhere, and `first` in it as the type of its first parameter, if there is
/// any.
bool hasFunction(const MaterialShader& shader, std::string_view type, std::string_view name,
                 std::string_view first = {}) {
  return std::ranges::any_of(shader.files, [&](const MaterialShader::File& file) {
    const std::vector<GlslToken> tokens = glslTokens(file.text);
    for (std::size_t i = 1; i + 2 < tokens.size(); ++i) {
      if (tokens[i - 1].text != type || tokens[i].text != name || tokens[i + 1].text != "(") continue;
      std::size_t parameter = i + 2;
      while (parameter + 1 < tokens.size() &&
             (tokens[parameter].text == "const" || tokens[parameter].text == "in"))
        ++parameter;
      if (first.empty() || tokens[parameter].text == first) return true;
    }
    return false;
  });
}

void refuseChannels(const MaterialShader& shader) {
  constexpr std::array<std::string_view, 6> kAbsent = {"iChannel0", "iChannel1",          "iChannel2",
                                                       "iChannel3", "iChannelResolution", "iChannelTime"};
  for (const MaterialShader::File& file : shader.files)
    for (const std::string_view word : kAbsent)
      if (const auto place = placeOf(word, file.text))
        throw Error(ErrorKind::Scene,
                    describe(file.name, file.text,
                             {*place,
                              fmt::format("there is no '{}': mainImage is given no textures, sounds or other "
                                          "passes yet",
                                          word),
                              "compute the pattern instead, as in shaders that need no channel"}));
}

/// What a material is given and a picture does not need: where a file has something else of that name, it
/// keeps it. Gives lines that rename those, and lines that take that back.
std::pair<std::string, std::string> renamingOfOwn(const MaterialShader& shader) {
  constexpr std::array<std::string_view, 14> kNames = {
      "Point",      "Light",    "Hit",         "trace",       "light",        "lightCount",  "ambientLight",
      "blinnPhong", "colorMap", "specularMap", "worldVector", "objectVector", "worldNormal", "glowMap"};
  // What stands before a name that is not declared there.
  constexpr std::array<std::string_view, 7> kQualifiers = {"const", "in",      "out", "inout",
                                                           "highp", "mediump", "lowp"};
  std::set<std::string_view> own;
  for (const MaterialShader::File& file : shader.files) {
    const TextByName uniforms = typesOfUniforms(file.text);
    const std::vector<GlslToken> tokens = outsideOfFunctions(file.text);
    for (std::size_t i = 1; i < tokens.size(); ++i) {
      const auto name = std::ranges::find(kNames, tokens[i].text);
      const GlslToken& before = tokens[i - 1];
      if (tokens[i].directive > 0 || before.directive > 0) continue;
      const bool isDeclared =
          before.text == "]" ||
          (before.isWord() && std::ranges::find(kQualifiers, before.text) == kQualifiers.end());
      if (name != kNames.end() && isDeclared && !uniforms.contains(*name)) own.insert(*name);
    }
  }
  std::pair<std::string, std::string> lines;
  for (const std::string_view name : own) {
    lines.first += fmt::format("#define {} {}{}\n", name, kWrappedName, name);
    lines.second += fmt::format("#undef {}\n", name);
  }
  return lines;
}

// The file's own material, where it has one, is another function than the one that calls mainImage. luxo's
// shaders may have given that name to it, too (lib/lit_shader.glsl).
constexpr const char* kGiven = R"(
uniform float iTime, iTimeDelta, iFrameRate;
uniform int iFrame;
uniform vec4 iMouse, iDate;
vec3 iResolution;
#ifdef material
#define LUXO_RENAMED
#undef material
#endif
#define material luxoBeside
)";

constexpr const char* kOwnAgain = R"(
#undef material
#ifdef LUXO_RENAMED
#define material luxoMaterial
#undef LUXO_RENAMED
#endif
)";

// The file's own material beside a mainImage, whose numbers it may read, too.
constexpr const char* kBeside = R"(
vec4 material(Point p) {
  iResolution = vec3(luxoPictureSize(), 1.0);
  return luxoBeside(p);
}
)";

// Coordinates are rounded to 1/256 px: that keeps centres of pixels, which hashes of them need, exact.
constexpr const char* kImageMaterial = R"(
float luxoLinear(float code) {
  if (code <= 0.0) return 0.0;
  if (code >= 1.0) return 1.0;
  return code > 0.04045 ? pow((code + 0.055) / 1.055, 2.4) : code / 12.92;
}
vec4 material(Point p) {
  iResolution = vec3(luxoPictureSize(), 1.0);
  vec2 pixel = 0.5 * (iResolution.y * p.position.xy + iResolution.xy);
  vec4 color = vec4(0.0, 0.0, 0.0, 1.0);
  mainImage(color, floor(256.0 * pixel + 0.5) / 256.0);
  return vec4(luxoLinear(color.r), luxoLinear(color.g), luxoLinear(color.b), 1.0);
}
)";

MaterialShaderPtr wrapped(const MaterialShader& shader, const std::string& name, const char* material) {
  refuseChannels(shader);
  // A material of its own beside it is given luxo's.
  const auto [renamed, restored] =
      hasMaterial(shader) ? std::pair<std::string, std::string>() : renamingOfOwn(shader);
  std::vector<MaterialShader::File> files{
      {name, fmt::format("{}{}#include \"{}\"\n{}{}{}", kGiven, renamed, shader.files.front().name, restored,
                         kOwnAgain, material)}};
  files.insert(files.end(), shader.files.begin(), shader.files.end());
  return std::make_shared<const MaterialShader>(MaterialShader{.files = std::move(files), .wrapped = true});
}

}  // namespace

// The plane is wider than any picture that is as high as 2 m.
const char* const kMainImageScene = R"({ "luxo": 1,
  "render": { "background": 0 },
  "materials": { "shader": { "two_sided": true } },
  "surfaces": { "picture": { "type": "rectangle", "size": [1000, 3] } },
  "nodes": [ { "name": "picture", "rotate": { "axis": [1, 0, 0], "angle": "90deg" }, "surface": "picture",
               "material": "shader" },
             { "name": "light", "translate": [0, 0, 1], "light": { "type": "point" } } ],
  "camera": { "eye": [0, 0, 1], "look_at": [0, 0, 0], "type": "orthographic", "height": 2 } })";

bool hasMainImage(const MaterialShader& shader) { return hasFunction(shader, "void", "mainImage"); }
bool hasMaterial(const MaterialShader& shader) { return hasFunction(shader, "vec4", "material", "Point"); }

MaterialShaderPtr materialOfMainImage(const MaterialShaderPtr& shader) {
  const std::string& file = shader->files.front().name;
  if (!hasMainImage(*shader))
    throw Error(
        ErrorKind::Scene,
        fmt::format("{}: there is no function 'void mainImage(out vec4 fragColor, in vec2 fragCoord)'", file),
        "it gives the colour of each pixel; leave out --shadertoy for the shader of a material");
  return wrapped(*shader, fmt::format("mainImage of {}", file), kImageMaterial);
}

MaterialShaderPtr materialBesideMainImage(const MaterialShaderPtr& shader) {
  constexpr std::array<std::string_view, 7> kNumbers = {"iResolution", "iTime",  "iTimeDelta", "iFrameRate",
                                                        "iFrame",      "iMouse", "iDate"};
  const bool reads = std::ranges::any_of(shader->files, [&](const MaterialShader::File& file) {
    return std::ranges::any_of(kNumbers,
                               [&](std::string_view word) { return placeOf(word, file.text).has_value(); });
  });
  if (!reads || !hasMainImage(*shader) || !hasMaterial(*shader)) return shader;
  return wrapped(*shader, fmt::format("material of {}", shader->files.front().name), kBeside);
}

std::string_view mainImageFormulas(std::string_view uniform) {
  constexpr std::pair<std::string_view, std::string_view> kFormulas[] = {{"iTime", "t"},
                                                                         {"iTimeDelta", "1/60"},
                                                                         {"iFrameRate", "60"},
                                                                         {"iFrame", "floor(60*t+0.5)"},
                                                                         {"iDate", "0;0;0;t"}};
  for (const auto& [name, formula] : kFormulas)
    if (name == uniform) return formula;
  return {};
}

}  // namespace luxo
