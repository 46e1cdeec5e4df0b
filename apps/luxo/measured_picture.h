// SPDX-License-Identifier: Apache-2.0
// All outputs of one snapshot: what verify() judges.
#pragma once

#include "draw/renderer.h"
#include "reference/verification.h"

namespace luxo {

struct MeasuredFrame {
  MeasuredPicture picture;
  FrameStatistics statistics;  ///< of the colour picture
};

/// Of a picture with more lights what each of them gives meshes is not drawn, and not judged.
inline constexpr std::size_t kMaxAlone = 32;

/// Draws colour, depth, position, normal, uv and id, one sample per pixel; where meshes of formulas are in
/// shadow the light of each light alone, too, as wholeLights() of withExactShadows() has them. Errors as
/// Renderer::render.
[[nodiscard]] MeasuredFrame measure(Renderer& renderer, const Snapshot& snapshot, DrawOptions options);

}  // namespace luxo
