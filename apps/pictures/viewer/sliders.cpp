// SPDX-License-Identifier: Apache-2.0
#include "viewer/sliders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/srgb_curve.h"
#include "option_values.h"
#include "shader_values.h"
#include "slider_scale.h"

namespace luxo {
namespace {

// Keys are indices of parameters, and above all these, of the first of a colour's; and this.
constexpr int kColorKeys = 1 << 20, kResetKey = std::numeric_limits<int>::max();

/// Of a colour's components.
std::array<float, 3> swatchOf(const Scene& scene, const ParameterControl& control,
                              std::span<const double> values) {
  std::array<float, 3> codes{};
  for (std::size_t i = 0; i < codes.size() && i < control.parameters.size(); ++i) {
    const auto id = scene.findParameter(control.parameters[i]);
    const double value = std::clamp(id && id->index < values.size() ? values[id->index] : 0, 0.0, 1.0);
    codes[i] = static_cast<float>(control.encoded ? value : srgbFromLinear(value));
  }
  return codes;
}

bool isButton(const ParameterControl* control) {
  return control &&
         (control->kind == ParameterControl::Kind::Choice || control->kind == ParameterControl::Kind::Switch);
}

double nextOf(const ParameterControl& control, double value) {
  return value + 1 > control.range.hi ? control.range.lo : value + 1;
}

std::string buttonText(const ParameterControl& control, double value) {
  if (control.kind == ParameterControl::Kind::Switch) return value != 0 ? "on" : "off";
  const auto index = static_cast<std::size_t>(value);
  return index < control.choices.size() ? control.choices[index] : sliderText(value);
}

/// Of what is typed, one that is not allowed is a mistake of who types it.
void refuseTyped(const Parameter& parameter, double value) {
  try {
    requireAllowed(parameter, value);
  } catch (const Error& error) {
    throw Error(ErrorKind::Usage, error.what());
  }
}

}  // namespace

const ParameterControl* Sliders::controlOf(const std::string& parameter) const {
  for (const ParameterControl& control : controls_)
    if (std::ranges::find(control.parameters, parameter) != control.parameters.end()) return &control;
  return nullptr;
}

std::optional<Interval> Sliders::rangeOf(const Parameter& parameter) const {
  if (parameter.range) return parameter.range;
  const ParameterControl* control = controlOf(parameter.name);
  return control ? std::optional(control->range) : std::nullopt;
}

void Sliders::adopt(Scene& scene, std::span<const ParameterControl> controls) {
  controls_ = controls;
  typing_.reset();
  given_.clear();
  for (const Parameter& parameter : scene.parameters()) given_.push_back(parameter.value);
  std::erase_if(chosen_, [&](const auto& choice) {
    const auto id = scene.findParameter(choice.first);
    const auto range = id ? rangeOf(scene[*id]) : std::nullopt;
    if (!range || (scene[*id].range && !range->contains(choice.second))) return true;
    scene.setParameter(*id, choice.second);
    return false;
  });
}

bool Sliders::obey(const window::Grab& grab, Scene& scene) {
  if (grab.released) return false;
  typing_.reset();
  if (grab.key == kResetKey) {
    if (grab.pressed) reset(scene);
    return grab.pressed;
  }
  const bool isColor = grab.key >= kColorKeys;
  const ParameterId id{static_cast<std::uint32_t>(isColor ? grab.key - kColorKeys : grab.key)};
  if (id.index >= scene.parameters().size() || !rangeOf(scene[id])) return false;
  if (const ParameterControl* control = controlOf(scene[id].name); isButton(control)) {
    if (grab.pressed) choose(id, nextOf(*control, scene.parametersAt(0)[id.index]), scene);
    return grab.pressed;
  }
  if (grab.types || (isColor && grab.pressed)) typing_ = {.parameter = id, .text = {}, .isColor = isColor};
  if (grab.types || isColor) return false;
  Parameter turned = scene[id];
  turned.range = rangeOf(turned);
  const double value = sliderValue(turned, grab.fraction);
  const auto chosen = chosen_.find(scene[id].name);
  if (chosen != chosen_.end() && chosen->second == value) return false;
  choose(id, value, scene);
  return true;
}

void Sliders::choose(ParameterId id, double value, Scene& scene) {
  scene.setParameter(id, value);
  chosen_[scene[id].name] = value;
}

void Sliders::obey(const window::Typed& typed) {
  if (typing_) typing_->text += typed.character;
}

bool Sliders::obey(const window::KeyPress& key, Scene& scene) {
  if (!typing_) return false;
  if (key.key == window::key::kBackspace && !typing_->text.empty()) typing_->text.pop_back();
  const bool takes = key.key == window::key::kEnter && !typing_->text.empty();
  if (takes) take(*typing_, scene);
  if (key.key == window::key::kEnter || key.key == window::key::kEscape) typing_.reset();
  return takes;
}

void Sliders::take(const Typing& typing, Scene& scene) {
  const ParameterControl* control = controlOf(scene[typing.parameter].name);
  if (!typing.isColor || !control) return choose(typing.parameter, typedValue(typing, scene), scene);
  std::vector<double> components;
  for (const std::string& text : componentTexts(*control, typing.text))
    components.push_back(parseNumber(control->label, text));
  for (std::size_t i = 0; i < components.size(); ++i)
    if (const auto id = scene.findParameter(control->parameters[i])) refuseTyped(scene[*id], components[i]);
  for (std::size_t i = 0; i < components.size(); ++i)
    if (const auto id = scene.findParameter(control->parameters[i])) choose(*id, components[i], scene);
}

double Sliders::typedValue(const Typing& typing, const Scene& scene) {
  const Parameter& parameter = scene[typing.parameter];
  const double value = parseNumber(parameter.labelOrName(), typing.text);
  refuseTyped(parameter, value);
  return value;
}

void Sliders::reset(Scene& scene) {
  typing_.reset();
  for (std::uint32_t i = 0; i < given_.size(); ++i) scene.setParameter(ParameterId{i}, given_[i]);
  chosen_.clear();
}

window::Panel::Row Sliders::swatchRow(const ParameterControl& control, ParameterId first, const Scene& scene,
                                      std::span<const double> values) const {
  const std::array<float, 3> codes = swatchOf(scene, control, values);
  const auto byte = [&](std::size_t i) { return std::lround(255 * codes[i]); };
  const bool isTyped = typing_ && typing_->isColor && typing_->parameter.index == first.index;
  return {
      .label = control.label,
      .text = isTyped ? typing_->text + "_" : fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2)),
      .swatch = codes,
      .key = kColorKeys + static_cast<int>(first.index)};
}

std::optional<window::Panel> Sliders::panel(const Scene& scene, std::span<const double> values) const {
  window::Panel panel{.place = window::Panel::Place::BottomLeft, .title = {}, .rows = {}};
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    Parameter parameter = scene[ParameterId{i}];
    parameter.range = rangeOf(parameter);
    if (!parameter.range) continue;
    const ParameterControl* control = controlOf(parameter.name);
    if (control && control->kind == ParameterControl::Kind::Color &&
        control->parameters.front() == parameter.name)
      panel.rows.push_back(swatchRow(*control, ParameterId{i}, scene, values));
    if (isButton(control)) {
      panel.rows.push_back(
          {.label = control->label, .text = buttonText(*control, values[i]), .key = static_cast<int>(i)});
      continue;
    }
    const bool isTyped = typing_ && !typing_->isColor && typing_->parameter.index == i;
    panel.rows.push_back({.label = parameter.labelOrName(),
                          .text = isTyped ? typing_->text + "_" : sliderText(values[i]),
                          .slider = sliderPosition(parameter, values[i]),
                          .key = static_cast<int>(i)});
  }
  if (panel.rows.empty()) return std::nullopt;
  panel.rows.push_back({.label = "", .text = "reset", .key = kResetKey});
  panel.rows.push_back(
      {.label = "", .text = typing_ ? "Enter takes the value, Esc leaves it" : "Ctrl+click types a value"});
  return panel;
}

}  // namespace luxo
