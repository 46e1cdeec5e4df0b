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

/// Draws colour, depth, position, normal, uv and id, one sample per pixel. Errors as Renderer::render.
[[nodiscard]] MeasuredFrame measure(Renderer& renderer, const Snapshot& snapshot, DrawOptions options);

}  // namespace luxo
