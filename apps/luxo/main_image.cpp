// SPDX-License-Identifier: Apache-2.0
#include "main_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "base/diagnostic.h"
#include "base/error.h"
#include "scene/shader_text.h"

namespace luxo {
namespace {

bool isWordLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Where a word stands, from `from` on.
std::optional<std::size_t> findWord(std::string_view text, std::string_view word, std::size_t from = 0) {
  for (std::size_t at = text.find(word, from); at != text.npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !isWordLetter(text[at - 1])) && (end == text.size() || !isWordLetter(text[end])))
      return at;
  }
  return std::nullopt;
}

/// Whether `type name (` stands somewhere outside of comments.
bool hasFunction(const MaterialShader& shader, std::string_view type, std::string_view name) {
  constexpr std::string_view kBlank = " \t\r\n";
  return std::ranges::any_of(shader.files, [&](const MaterialShader::File& file) {
    const std::string code = withoutComments(file.text);
    for (auto at = findWord(code, name); at; at = findWord(code, name, *at + 1)) {
      const std::size_t open = code.find_first_not_of(kBlank, *at + name.size());
      const std::string_view before = std::string_view(code).substr(0, *at);
      const std::size_t end = before.find_last_not_of(kBlank);
      if (open != code.npos && code[open] == '(' && end != before.npos &&
          before.substr(0, end + 1).ends_with(type))
        return true;
    }
    return false;
  });
}

void refuseChannels(const MaterialShader& shader) {
  constexpr std::array<std::string_view, 6> kAbsent = {"iChannel0", "iChannel1",          "iChannel2",
                                                       "iChannel3", "iChannelResolution", "iChannelTime"};
  for (const MaterialShader::File& file : shader.files) {
    const std::string code = withoutComments(file.text);
    for (const std::string_view word : kAbsent)
      if (const auto at = findWord(code, word))
        throw Error(ErrorKind::Scene,
                    describe(file.name, file.text,
                             {{*at, *at + word.size()},
                              fmt::format("there is no '{}': mainImage is given no textures, sounds or other "
                                          "passes yet",
                                          word),
                              "compute the pattern instead, as in shaders that need no channel"}));
  }
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
constexpr const char* kMaterial = R"(
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
  std::vector<MaterialShader::File> files{
      {name, fmt::format("{}#include \"{}\"\n{}{}", kGiven, shader.files.front().name, kOwnAgain, material)}};
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
bool hasMaterial(const MaterialShader& shader) { return hasFunction(shader, "vec4", "material"); }

MaterialShaderPtr materialOfMainImage(const MaterialShaderPtr& shader) {
  const std::string& file = shader->files.front().name;
  if (!hasMainImage(*shader))
    throw Error(
        ErrorKind::Scene,
        fmt::format("{}: there is no function 'void mainImage(out vec4 fragColor, in vec2 fragCoord)'", file),
        "it gives the colour of each pixel; leave out --shadertoy for the shader of a material");
  return wrapped(*shader, fmt::format("mainImage of {}", file), kMaterial);
}

MaterialShaderPtr materialBesideMainImage(const MaterialShaderPtr& shader) {
  constexpr std::array<std::string_view, 7> kNumbers = {"iResolution", "iTime",  "iTimeDelta", "iFrameRate",
                                                        "iFrame",      "iMouse", "iDate"};
  const bool reads = std::ranges::any_of(shader->files, [&](const MaterialShader::File& file) {
    const std::string code = withoutComments(file.text);
    return std::ranges::any_of(kNumbers,
                               [&](std::string_view word) { return findWord(code, word).has_value(); });
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
