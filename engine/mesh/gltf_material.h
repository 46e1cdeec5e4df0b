// SPDX-License-Identifier: Apache-2.0
// Materials of glTF as Blinn's.
#pragma once

#include "mesh/gltf_file.h"

namespace luxo {

/// The sharpest highlight: two degrees wide; rougher is what roughness is from 0.21 on.
inline constexpr double kMaxGltfShininess = 1000;
/// What is reflected of light that falls straight on what is no metal.
inline constexpr double kGltfReflectance = 0.04;

/// The strongest specular colour that glTF can say: all light that falls straight on it is reflected.
[[nodiscard]] inline double strongestGltfSpecular(double shininess) { return (shininess + 2) / 8; }

/// Reads materials, their maps and images. Of metallic-roughness, m and r, with base colour c: diffuse = (1 -
/// m) c; ambient = c, since surroundings are seen in metal, too; shininess n = 2 / r^4 - 2, at most
/// kMaxGltfShininess, whose lobe (N.H)^n is Beckmann's of alpha = r^2 (Walter et al., Microfacet models for
/// refraction, 2007, 5.1); specular = (0.04 + m (c - 0.04)) (n + 2) / 8, which is that lobe's height with pi
/// times the light, as diffuse is counted here. KHR_materials_specular scales the 0.04, by a map of colours,
/// too. Unlit: the colour glows. Maps of metal and roughness are not read. Gives for each material the number
/// of the uvs that its maps use (TEXCOORD_n); maps that use others than its first are not read.
[[nodiscard]] std::vector<std::uint64_t> readGltfMaterials(const ModelSource& source, GltfFile& file,
                                                           Model& model);

}  // namespace luxo
