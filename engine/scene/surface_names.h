// SPDX-License-Identifier: Apache-2.0
// What formulas of a material may say about the point of a surface that they are read at: its place, its
// normal and how the surface bends there, all as formulas of u and v, derived from the surface's own.
//
//     x y z       place, metres
//     nx ny nz    unit normal, outward (Surface::normal), whichever side is seen
//     k1 k2       the largest and least curvature with that normal, 1 / metres: those of a ball are positive
//     K H         K = k1 k2 and H = (k1 + k2) / 2 (surface/curvature.h)
//
// In the surface's own space: a node may move it, and no colour changes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "formula/expression.h"
#include "scene/pattern.h"
#include "surface/surface.h"

namespace luxo {

inline constexpr std::array<std::string_view, 10> kSurfaceNames = {"x",  "y", "z", "nx", "ny",
                                                                   "nz", "K", "H", "k1", "k2"};
/// What the names stand for, in that order. Variables 0 and 1 of the graph are u and v, the surface's
/// parameters begin at `firstParameter`. Where an edge is a pole, that of 1/10,000 of the range beside it: an
/// error of second order where the surface is smooth there. Required: a formula. Cost: linear in the nodes of
/// the formulas of its patches, each once, however many patches share it, and in the constants of all
/// patches.
[[nodiscard]] std::vector<Expr> surfaceValues(Graph& graph, const Surface& surface,
                                              std::uint32_t firstParameter);

/// K, H, k1 and k2 as what a material's shader is given (Material::curvature); its parameters are the
/// surface's. Nothing of triangles, which are flat. Error(Scene): too large a formula.
[[nodiscard]] Pattern curvaturePattern(const Surface& surface);

}  // namespace luxo
