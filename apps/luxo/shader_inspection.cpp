// SPDX-License-Identifier: Apache-2.0
#include "shader_inspection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "draw/course_style.h"
#include "draw/material_errors.h"
#include "draw/material_program.h"
#include "gpu/deep_stack.h"
#include "gpu/shader_reflection.h"
#include "gpu/shader_validation.h"
#include "main_image.h"
#include "open_scene.h"
#include "scene/shader_files.h"
#include "scene/shader_macros.h"
#include "scene/shader_text.h"
#include "shader_controls.h"
#include "shader_scene.h"

namespace luxo {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 6> kStages = {
    "vertex", "fragment", "compute", "geometry", "tessellation control", "tessellation evaluation"};
constexpr std::array<std::string_view, 3> kBlockKinds = {"uniform", "storage", "push constants"};

constexpr std::pair<std::string_view, gpu::ShaderStage> kSuffixes[] = {
    {".vert", gpu::ShaderStage::Vertex},
    {".frag", gpu::ShaderStage::Fragment},
    {".glsl", gpu::ShaderStage::Fragment},
    {".comp", gpu::ShaderStage::Compute},
    {".geom", gpu::ShaderStage::Geometry},
    {".tesc", gpu::ShaderStage::TessellationControl},
    {".tese", gpu::ShaderStage::TessellationEvaluation}};

/// Nothing of others than these.
std::optional<gpu::ShaderStage> stageOf(std::string_view suffix) {
  const auto* const known = std::ranges::find(kSuffixes, suffix, [](const auto& one) { return one.first; });
  return known == std::end(kSuffixes) ? std::nullopt : std::optional(known->second);
}

std::vector<std::uint32_t> wordsOf(const fs::path& path) {
  std::error_code failure;
  if (const std::uintmax_t size = fs::file_size(path, failure); !failure && size > kMaxShaderBytes)
    throw Error(ErrorKind::Scene,
                fmt::format("cannot read the shader '{}': it has {} bytes; at most {} are read",
                            path.string(), size, kMaxShaderBytes));
  std::ifstream stream(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream && bytes.empty())
    throw Error(ErrorKind::Scene, fmt::format("cannot read the shader '{}'", path.string()));
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
  return words;
}

bool hasMain(const MaterialShader& shader) {
  return std::ranges::any_of(
      shader.files, [](const auto& file) { return placeOfFunction("void", "main", file.text).has_value(); });
}

gpu::ShaderInterface ofProgram(const MaterialShader& shader, gpu::ShaderStage stage) {
  requireBounded(shader);
  std::vector<gpu::ShaderSource> files;
  for (const MaterialShader::File& file : shader.files) files.push_back({file.name, file.text});
  const auto compiled = [&] {
    try {
      return gpu::ShaderCompiler().compile({.source = files.front(),
                                            .stage = stage,
                                            .includes = std::span(files).subspan(1),
                                            .preamble = "#extension GL_GOOGLE_include_directive : enable\n",
                                            .forReflection = true});
    } catch (const Error& error) {
      refuseUnclosed(shader, error.what());
      throw;
    }
  };
  return gpu::reflect(compiled().spirv);
}

/// A vertex program with the fragment program that shows what it gives.
MaterialShaderPtr withFragmentProgram(const MaterialShader& vertex) {
  MaterialShader shader{{{"gl_Color", "void main() { gl_FragColor = gl_Color; }\n"}}, 1};
  shader.files.insert(shader.files.end(), vertex.files.begin(), vertex.files.end());
  return std::make_shared<const MaterialShader>(std::move(shader));
}

Json namesOf(const std::vector<gpu::ShaderStage>& stages) {
  Json names = Json::array();
  for (const gpu::ShaderStage stage : stages) names.push_back(kStages[static_cast<std::size_t>(stage)]);
  return names;
}

Json jsonOf(const gpu::ShaderVariable& variable, bool laidOut) {
  Json json = {{"name", variable.name}, {"type", variable.type}};
  if (!variable.array.empty()) json["array"] = variable.array;
  if (variable.location) json["location"] = *variable.location;
  if (variable.set) json["set"] = *variable.set;
  if (variable.binding) json["binding"] = *variable.binding;
  if (laidOut) {
    json["offset"] = variable.offset;
    json["size"] = variable.size;
    if (variable.arrayStride > 0) json["array_stride"] = variable.arrayStride;
    if (variable.matrixStride > 0) json["matrix_stride"] = variable.matrixStride;
    if (variable.rowMajor) json["row_major"] = true;
  }
  if (variable.patch) json["patch"] = true;
  json["active"] = variable.active;
  for (const gpu::ShaderVariable& member : variable.members)
    json["members"].push_back(jsonOf(member, laidOut));
  return json;
}

/// Of a stage, or of two that say which of them have what.
Json jsonOf(const std::vector<gpu::ShaderVariable>& variables, gpu::ShaderStage stage, bool laidOut = false) {
  Json list = Json::array();
  for (const gpu::ShaderVariable& variable : variables) {
    list.push_back(jsonOf(variable, laidOut));
    list.back()["stages"] = namesOf(variable.stages.empty() ? std::vector{stage} : variable.stages);
  }
  return list;
}

Json jsonOf(const gpu::ShaderBlock& block, gpu::ShaderStage stage) {
  Json json = {{"name", block.name},
               {"kind", kBlockKinds[static_cast<std::size_t>(block.kind)]},
               {"stages", namesOf({stage})}};
  if (block.kind != gpu::ShaderBlock::Kind::Push)
    json.update({{"set", block.set}, {"binding", block.binding}});
  json.update(
      {{"size", block.size}, {"active", block.active}, {"members", jsonOf(block.members, stage, true)}});
  return json;
}

std::string arrayOf(const Json& variable) {
  std::string text;
  if (variable.contains("array"))
    for (const Json& size : variable["array"])
      text += size == 0 ? "[]" : fmt::format("[{}]", size.get<std::uint32_t>());
  return text;
}

bool isRuntimeSized(const Json& variable) {
  return variable.contains("offset") && variable.contains("array") && variable["array"].front() == 0;
}

/// `tellsStages`: there are two.
std::string lineOf(const Json& variable, int indent, bool tellsStages = false) {
  std::string line = fmt::format("{:{}}{:<10} {:<24}", "", indent, variable["type"].get<std::string>(),
                                 variable["name"].get<std::string>() + arrayOf(variable));
  for (const auto& [key, label] : {std::pair{"location", "location"},
                                   {"set", "set"},
                                   {"binding", "binding"},
                                   {"offset", "offset"},
                                   {"size", "bytes"},
                                   {"array_stride", "array stride"},
                                   {"matrix_stride", "matrix stride"}})
    if (variable.contains(key) && !(isRuntimeSized(variable) && std::string_view(key) == "size"))
      line += fmt::format(" {} {:<4}", label, variable[key].get<std::uint32_t>());
  if (variable.contains("row_major")) line += " row major";
  if (variable.contains("patch")) line += " of the patch";
  if (isRuntimeSized(variable)) line += " as long as the buffer is";
  if (tellsStages)
    line += fmt::format(" in {}", fmt::join(variable["stages"].get<std::vector<std::string>>(), ", "));
  if (!variable["active"].get<bool>()) line += " not used";
  if (variable.contains("value")) line += fmt::format(" is {}", variable["value"].get<std::string>());
  line.erase(line.find_last_not_of(' ') + 1);
  line += "\n";
  if (variable.contains("members"))
    for (const Json& member : variable["members"]) line += lineOf(member, indent + 2);
  return line;
}

void tellPreset(const std::string& shader, const std::vector<ParameterValue>& preset, Json& uniforms) {
  for (const ParameterValue& value : preset) {
    const auto uniform =
        std::ranges::find(uniforms, Json(value.name), [](const Json& u) { return u["name"]; });
    if (uniform != uniforms.end())
      (*uniform)["value"] = value.value;
    else
      log(LogLevel::Warning,
          fmt::format("the preset has a value for '{}', which the shader '{}' does not take", value.name,
                      shader));
  }
}

}  // namespace

bool isShader(const std::string& path) {
  const std::string suffix = fs::path(path).extension().string();
  return suffix == ".spv" || stageOf(suffix);
}

Json inspectShader(const std::string& name, const ShaderUse& use) {
  const fs::path path(name);
  const std::string suffix = path.extension().string();
  const gpu::ShaderStage stage = stageOf(suffix).value_or(gpu::ShaderStage::Fragment);
  gpu::ShaderInterface all;
  bool isMaterial = false, inStyle = false;
  if (suffix == ".spv") {
    const std::vector<std::uint32_t> words = wordsOf(path);
    gpu::requireValid(words);
    gpu::onDeepStack([&] { all = gpu::reflect(words); });
  } else {
    // A stage by itself, whatever is beside it.
    MaterialShaderPtr shader = suffix == ".vert"
                                   ? ShaderFiles(path.parent_path()).get(path.filename().string())
                                   : openMaterialShader(name);
    const bool ofPicture = use.mainImage || (hasMainImage(*shader) && !hasMaterial(*shader));
    inStyle = (stage == gpu::ShaderStage::Vertex || stage == gpu::ShaderStage::Fragment) &&
              inCourseStyle(*shader) && !hasMainImage(*shader) && !ofPicture;
    if (inStyle && suffix == ".vert") shader = withFragmentProgram(*shader);
    isMaterial = inStyle || use.mainImage || (!hasMain(*shader) && stage == gpu::ShaderStage::Fragment);
    if (isMaterial) {
      shader = ofPicture ? materialOfMainImage(shader) : materialBesideMainImage(shader);
      const MaterialProgram program(shader);
      all = program.interface();
      std::vector<std::string> warnings;
      static_cast<void>(uniformControls(*shader, program.uniforms(), &warnings));
      for (const std::string& warning : warnings) log(LogLevel::Warning, warning);
    } else {
      all = ofProgram(*shader, stage);
    }
  }
  Json json = {
      {"luxo", LUXO_VERSION},
      {"inspect", 1},
      {"shader", name},
      {"stage", kStages[static_cast<std::size_t>(suffix == ".vert" ? gpu::ShaderStage::Vertex : all.stage)]},
      {"material", isMaterial}};
  if (isMaterial) {
    json["uniforms"] =
        all.blocks.empty() ? Json::array() : jsonOf(all.blocks.front().members, all.stage, true);
    tellPreset(name, use.preset, json["uniforms"]);
    if (inStyle)
      json.update(
          {{"attributes", jsonOf(all.inputs, all.stage)}, {"varyings", jsonOf(all.outputs, all.stage)}});
    return json;
  }
  if (!all.layout.empty()) json["layout"] = all.layout;
  json["inputs"] = jsonOf(all.inputs, all.stage);
  json["outputs"] = jsonOf(all.outputs, all.stage);
  json["blocks"] = Json::array();
  for (const gpu::ShaderBlock& block : all.blocks) json["blocks"].push_back(jsonOf(block, all.stage));
  json["samplers"] = jsonOf(all.samplers, all.stage);
  json["constants"] = jsonOf(all.constants, all.stage);
  return json;
}

std::string shaderText(const Json& json) {
  const bool isMaterial = json["material"].get<bool>();
  std::string text =
      fmt::format("{}: {}\n", json["shader"].get<std::string>(),
                  json.contains("varyings") ? "a program in the course's style, the shader of a material"
                  : isMaterial              ? "the shader of a material"
                                            : fmt::format("a {} shader", json["stage"].get<std::string>()));
  const auto list = [&](const char* key, std::string_view title) {
    if (!json.contains(key) || json[key].empty()) return;
    text += fmt::format("{}\n", title);
    for (const Json& variable : json[key]) text += lineOf(variable, 2, json.contains("varyings"));
  };
  if (json.contains("layout"))
    text += fmt::format("layout {}\n", fmt::join(json["layout"].get<std::vector<std::string>>(), ", "));
  list("uniforms", "uniforms");
  list("attributes", "attributes");
  list("varyings", "varyings");
  list("inputs", json["stage"] == "vertex" ? "attributes" : "inputs");
  list("outputs", json["stage"] == "vertex" ? "varyings" : "outputs");
  if (json.contains("blocks"))
    for (const Json& block : json["blocks"]) {
      const bool grows = !block["members"].empty() && isRuntimeSized(block["members"].back());
      text += fmt::format("block {}: {}, {} bytes{}", block["name"].get<std::string>(),
                          block["kind"].get<std::string>(), block["size"].get<std::uint32_t>(),
                          grows ? " and what its last member has" : "");
      if (block.contains("set"))
        text += fmt::format(", set {}, binding {}", block["set"].get<std::uint32_t>(),
                            block["binding"].get<std::uint32_t>());
      text += block["active"].get<bool>() ? "\n" : ", not used\n";
      for (const Json& member : block["members"]) text += lineOf(member, 2);
    }
  list("samplers", "samplers and images");
  list("constants", "specialization constants");
  return text;
}

}  // namespace luxo
