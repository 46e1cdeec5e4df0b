// SPDX-License-Identifier: Apache-2.0
// `luxo plot`: the scene of one formula.
#pragma once

#include <string>
#include <vector>

#include "option_values.h"
#include "options.h"
#include "scene/scene_file.h"

namespace luxo {

/// What was typed.
struct PlotDesc {
  std::string position;                    ///< "[x, y, z]": three formulas of u and v
  std::string u, v;                        ///< "from:to", numbers or formulas
  std::vector<std::string> definitions{};  ///< "name=formula"
  std::string color{};                     ///< a formula, shown as a colour of `colormap`
  std::string colormap{};  ///< (colormap.h) empty: vik for what is above and below 0, else viridis
  std::vector<std::string> isolines{};  ///< "formula@step", or a formula alone: where it is 0
  std::string grid{};                   ///< "N" or "NxM": lines of constant u, and of constant v
};

/// The surface in two lights, enamelled on both sides, and a camera that is fitted to all that the request
/// sweeps over, from where the surface shows itself. A definition that needs u or v
/// (itself or through another one) belongs to the surface; every other one is a parameter of the scene, whose
/// value the request may replace. Colours and isolines may use what materials may (scene/surface_names.h);
/// a colormap runs from the least to the most of a grid of 65 x 65 points at the initial values, as far below
/// 0 as above where its middle is 0. The scene's settings are what the request asks for. Error(Scene):
/// the formulas have errors; it points into the text as typed. Error(Usage): text of another shape, a
/// parameter that is not defined.
[[nodiscard]] SceneFile plotScene(const PlotDesc& plot, const RenderRequest& request);

}  // namespace luxo
