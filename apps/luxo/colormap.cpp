// SPDX-License-Identifier: Apache-2.0
#include "colormap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "base/srgb_curve.h"
#include "base/suggestion.h"

namespace luxo {
namespace {

struct Colormap {
  std::string_view name;
  bool diverging;
  std::array<std::uint32_t, 10> colors;  // 0xrrggbb, equally far from each other
};

constexpr std::array kColormaps = {
    Colormap{
        "viridis",
        false,
        {0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e, 0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725}},
    Colormap{
        "vik",
        true,
        {0x001261, 0x033e7d, 0x1e6f9d, 0x71a8c4, 0xc9dde7, 0xeacebd, 0xd39774, 0xbe6533, 0x8b2706, 0x590008}},
};

const Colormap& find(std::string_view name) {
  const auto found = std::ranges::find(kColormaps, name, &Colormap::name);
  if (found == kColormaps.end()) {
    const std::vector<std::string> names = colormapNames();
    throw Error(ErrorKind::Usage, fmt::format("there is no colormap '{}'", name),
                didYouMean(std::string(name), names, fmt::format("give one of {}", listed(names))));
  }
  return *found;
}

/// Of five digits: far less than a code.
double linear(std::uint32_t color, std::size_t channel) {
  return std::round(1e5 * linearFromSrgb((color >> (16 - 8 * channel) & 255) / 255.0)) / 1e5;
}

}  // namespace

std::vector<std::string> colormapNames() {
  std::vector<std::string> names;
  for (const Colormap& map : kColormaps) names.emplace_back(map.name);
  return names;
}

bool isDiverging(std::string_view colormap) { return find(colormap).diverging; }

Quantity3 colorsOf(std::string_view colormap, const std::string& name) {
  const auto& colors = find(colormap).colors;
  Quantity3 formulas;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    std::string formula = fmt::format("{}", linear(colors[0], channel));
    for (std::size_t k = 1; k < colors.size(); ++k) {
      const double rise = linear(colors[k], channel) - linear(colors[k - 1], channel);
      formula += fmt::format(" {} {:.5g}*clamp({}*{} - {}, 0, 1)", rise < 0 ? '-' : '+', std::abs(rise),
                             colors.size() - 1, name, k - 1);
    }
    formulas[channel] = formula;
  }
  return formulas;
}

}  // namespace luxo
