// SPDX-License-Identifier: Apache-2.0
#include "shader_presets.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/suggestion.h"

namespace luxo {
namespace {

using Json = nlohmann::ordered_json;

// A file of presets has some hundred bytes for each.
constexpr std::uintmax_t kMaxBytes = 1 << 20;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw Error(ErrorKind::Scene, fmt::format("{}: {}", file.string(), why),
              R"(as in { "presets": { "copper": { "metal": [0.8, 0.5, 0.3], "grooves": 90 } } })");
}

/// As -P has it.
std::string valueText(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number()) return fmt::format("{}", value.get<double>());
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::string valueText(const std::filesystem::path& file, const std::string& name, const Json& value) {
  std::string text = valueText(value);
  if (value.is_array())
    for (const Json& number : value) text += fmt::format("{}{}", text.empty() ? "" : ",", valueText(number));
  if (text.empty())
    refuse(file, fmt::format("'{}' is no value: a number, a list of them, true, false or a name", name));
  return text;
}

Json valueOf(const std::string& text) {
  if (const auto number = finiteNumber(text)) return *number;
  if (text == "true" || text == "false") return text == "true";
  Json list = Json::array();
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto number = finiteNumber(text.substr(begin, end - begin));
    if (!number) return text;
    list.push_back(*number);
    begin = end + 1;
  }
  return list;
}

Json parsed(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream && !stream.eof()) refuse(file, "it cannot be read");
  const Json json = Json::parse(text, nullptr, false, true);
  if (json.is_discarded()) refuse(file, "it is no JSON");
  return json;
}

}  // namespace

std::filesystem::path presetFileOf(const std::string& shader) { return shader + ".presets.json"; }

ShaderPresets readPresets(const std::string& shader) {
  const std::filesystem::path file = presetFileOf(shader);
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) return {};
  if (!std::filesystem::is_regular_file(file, failure)) refuse(file, "it is no regular file");
  if (std::filesystem::file_size(file, failure) > kMaxBytes || failure)
    refuse(file, "it has more than 1 MiB");
  const Json json = parsed(file);
  if (!json.is_object() || !json.contains("presets") || !json["presets"].is_object())
    refuse(file, "it has no \"presets\"");
  ShaderPresets presets;
  for (const auto& [name, values] : json["presets"].items()) {
    if (!values.is_object())
      refuse(file, fmt::format("the preset '{}' is no list of names and values", name));
    std::vector<ParameterValue>& preset = presets[name];
    for (const auto& [uniform, value] : values.items())
      preset.push_back({uniform, valueText(file, uniform, value)});
  }
  return presets;
}

std::vector<ParameterValue> presetOf(const std::string& shader, const std::string& name) {
  const ShaderPresets presets = readPresets(shader);
  if (const auto found = presets.find(name); found != presets.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [known, values] : presets) names.push_back(known);
  throw Error(ErrorKind::Usage, fmt::format("--preset: '{}' has no preset '{}'", shader, name),
              names.empty() ? fmt::format("there is no {}", presetFileOf(shader).string())
                            : didYouMean(name, names, fmt::format("it has {}", listed(names))));
}

void writePresets(const std::string& shader, const ShaderPresets& presets) {
  Json json = {{"presets", Json::object()}};
  for (const auto& [name, values] : presets) {
    Json& preset = json["presets"][name] = Json::object();
    for (const auto& [uniform, text] : values) preset[uniform] = valueOf(text);
  }
  const std::filesystem::path file = presetFileOf(shader), part = file.string() + ".part";
  std::error_code failure;
  std::ofstream stream(part);
  stream << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
  stream.close();
  if (stream) std::filesystem::rename(part, file, failure);
  if (!stream || failure) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw Error(ErrorKind::Write, fmt::format("cannot write the presets '{}'", file.string()),
                "see whether its folder may be written");
  }
}

}  // namespace luxo
