// SPDX-License-Identifier: Apache-2.0
#include "viewer/sliders.h"

#include <limits>

#include "base/error.h"
#include "option_values.h"
#include "slider_scale.h"

namespace luxo {
namespace {

constexpr int kResetKey = std::numeric_limits<int>::max();  // other keys are indices of parameters

}  // namespace

void Sliders::adopt(Scene& scene) {
  typing_.reset();
  given_.clear();
  for (const Parameter& parameter : scene.parameters()) given_.push_back(parameter.value);
  std::erase_if(chosen_, [&](const auto& choice) {
    const auto id = scene.findParameter(choice.first);
    const auto range = id ? scene[*id].range : std::nullopt;
    if (!range || !range->contains(choice.second)) return true;
    scene.setParameter(*id, choice.second);
    return false;
  });
}

bool Sliders::obey(const window::Grab& grab, Scene& scene) {
  typing_.reset();
  if (grab.key == kResetKey) {
    if (grab.pressed) reset(scene);
    return grab.pressed;
  }
  const ParameterId id{static_cast<std::uint32_t>(grab.key)};
  if (id.index >= scene.parameters().size() || !scene[id].range) return false;
  if (grab.types) {
    typing_ = {.parameter = id, .text = {}};
    return false;
  }
  const double value = sliderValue(scene[id], grab.fraction);
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
  if (takes) choose(typing_->parameter, typedValue(*typing_, scene), scene);
  if (key.key == window::key::kEnter || key.key == window::key::kEscape) typing_.reset();
  return takes;
}

double Sliders::typedValue(const Typing& typing, const Scene& scene) {
  const Parameter& parameter = scene[typing.parameter];
  const double value = parseNumber(parameter.labelOrName(), typing.text);
  try {
    requireAllowed(parameter, value);
  } catch (const Error& error) {
    throw Error(ErrorKind::Usage, error.what());
  }
  return value;
}

void Sliders::reset(Scene& scene) {
  typing_.reset();
  for (std::uint32_t i = 0; i < given_.size(); ++i) scene.setParameter(ParameterId{i}, given_[i]);
  chosen_.clear();
}

std::optional<window::Panel> Sliders::panel(const Scene& scene, std::span<const double> values) const {
  window::Panel panel{.place = window::Panel::Place::BottomLeft, .title = {}, .rows = {}};
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    const Parameter& parameter = scene[ParameterId{i}];
    if (!parameter.range) continue;
    const bool isTyped = typing_ && typing_->parameter.index == i;
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
