// SPDX-License-Identifier: Apache-2.0
#include "viewer/sliders.h"

#include <limits>

#include "base/error.h"
#include "slider_scale.h"

namespace luxo {
namespace {

constexpr int kResetKey = std::numeric_limits<int>::max();  // other keys are indices of parameters

}  // namespace

void Sliders::adopt(Scene& scene) {
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
  if (grab.key == kResetKey) {
    if (grab.pressed) reset(scene);
    return grab.pressed;
  }
  const ParameterId id{static_cast<std::uint32_t>(grab.key)};
  if (id.index >= scene.parameters().size() || !scene[id].range) return false;
  const double value = sliderValue(scene[id], grab.fraction);
  const auto chosen = chosen_.find(scene[id].name);
  if (chosen != chosen_.end() && chosen->second == value) return false;
  scene.setParameter(id, value);
  chosen_[scene[id].name] = value;
  return true;
}

void Sliders::reset(Scene& scene) {
  for (std::uint32_t i = 0; i < given_.size(); ++i) scene.setParameter(ParameterId{i}, given_[i]);
  chosen_.clear();
}

std::optional<window::Panel> Sliders::panel(const Scene& scene, std::span<const double> values) const {
  window::Panel panel{.place = window::Panel::Place::BottomLeft, .title = {}, .rows = {}};
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    const Parameter& parameter = scene[ParameterId{i}];
    if (!parameter.range) continue;
    panel.rows.push_back({.label = parameter.labelOrName(),
                          .text = sliderText(values[i]),
                          .slider = sliderPosition(parameter, values[i]),
                          .key = static_cast<int>(i)});
  }
  if (panel.rows.empty()) return std::nullopt;
  panel.rows.push_back({.label = "", .text = "reset", .key = kResetKey});
  return panel;
}

}  // namespace luxo
