// SPDX-License-Identifier: Apache-2.0
#include "viewer/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "shader_presets.h"
#include "shader_values.h"

namespace luxo {
namespace {

using Kind = ParameterControl::Kind;

// Beside the keys of sliders.
constexpr int kSaveKey = std::numeric_limits<int>::max() - 1, kNextKey = kSaveKey - 1;

std::string valueText(const ParameterControl& control, const Scene& scene, std::span<const double> values) {
  std::string text;
  for (const std::string& name : control.parameters) {
    const auto id = scene.findParameter(name);
    if (!id) continue;
    const double value = values[id->index];
    if (control.kind == Kind::Choice) return control.choices[static_cast<std::size_t>(value)];
    if (control.kind == Kind::Switch)
      text += fmt::format("{}{}", text.empty() ? "" : ",", value != 0 ? "true" : "false");
    else
      text += fmt::format("{}{}", text.empty() ? "" : ",", value);
  }
  return text;
}

}  // namespace

std::optional<std::string> Presets::obey(const window::Grab& grab, Sliders& sliders, Scene& scene,
                                         std::span<const ParameterControl> controls) {
  if (shader_.empty() || !grab.pressed) return std::nullopt;
  if (grab.key == kSaveKey) return save(scene, controls);
  if (grab.key == kNextKey) return takeNext(sliders, scene, controls);
  return std::nullopt;
}

std::string Presets::save(const Scene& scene, std::span<const ParameterControl> controls) {
  ShaderPresets presets = readPresets(shader_);
  int number = 1;
  while (presets.contains(fmt::format("preset {}", number))) ++number;
  current_ = fmt::format("preset {}", number);
  const std::vector<double> values = scene.parametersAt(0);
  for (const ParameterControl& control : controls)
    presets[current_].push_back({control.label, valueText(control, scene, values)});
  writePresets(shader_, presets);
  return fmt::format("saved '{}' in {}", current_, presetFileOf(shader_).string());
}

std::string Presets::takeNext(Sliders& sliders, Scene& scene, std::span<const ParameterControl> controls) {
  const ShaderPresets presets = readPresets(shader_);
  if (presets.empty()) return fmt::format("there are no presets in {} yet", presetFileOf(shader_).string());
  auto next = presets.upper_bound(current_);
  if (next == presets.end()) next = presets.begin();
  current_ = next->first;
  for (const auto& [uniform, text] : next->second) {
    const auto control = std::ranges::find(controls, uniform, &ParameterControl::label);
    if (control == controls.end()) continue;  // of another time
    const std::vector<std::string> texts = componentTexts(*control, text);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const auto id = scene.findParameter(control->parameters[i]);
      if (id) sliders.choose(*id, parseNumber(uniform, texts[i]), scene);
    }
  }
  return fmt::format("took '{}'", current_);
}

void Presets::addRows(window::Panel& panel) const {
  if (shader_.empty()) return;
  panel.rows.push_back({.label = "preset", .text = current_.empty() ? "next" : current_, .key = kNextKey});
  panel.rows.push_back({.label = "", .text = "save as a preset", .key = kSaveKey});
}

}  // namespace luxo
