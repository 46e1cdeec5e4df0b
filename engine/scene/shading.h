// SPDX-License-Identifier: Apache-2.0
// How a pixel's colour is found, and the names users write for it.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace luxo {

enum class Shading {
  Flat,       ///< one normal per triangle
  Gouraud,    ///< light at vertices, interpolated
  Phong,      ///< light in every pixel, from the interpolated normal
  Exact,      ///< light in every pixel, from the point of the surface itself that the pixel sees
  Toon,       ///< two levels of the diffuse colour, and an outline
  Wireframe,  ///< the edges of the triangles
  Normal,     ///< view of data: world normal
  Uv,         ///< view of data: surface parameters
  Depth,      ///< view of data: distance along the view axis
  Id,         ///< view of data: the node's number
  Residual,   ///< view of data: how far the point drawn is from the pixel's ray
};

inline constexpr std::array<std::string_view, 11> kShadingNames = {
    "flat", "gouraud", "phong", "exact", "toon", "wireframe", "normal", "uv", "depth", "id", "residual"};

[[nodiscard]] constexpr std::string_view nameOf(Shading shading) {
  return kShadingNames[static_cast<std::size_t>(shading)];
}

/// Whether it shows the geometry instead of light.
[[nodiscard]] constexpr bool showsData(Shading shading) {
  return shading == Shading::Wireframe || shading == Shading::Normal || shading == Shading::Uv ||
         shading == Shading::Depth || shading == Shading::Id || shading == Shading::Residual;
}

/// The shading of that name, or nothing.
[[nodiscard]] constexpr std::optional<Shading> shadingNamed(std::string_view name) {
  for (std::size_t i = 0; i < kShadingNames.size(); ++i)
    if (kShadingNames[i] == name) return static_cast<Shading>(i);
  return std::nullopt;
}

}  // namespace luxo
