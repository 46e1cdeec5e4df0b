// SPDX-License-Identifier: Apache-2.0
// One scene drawn and held against the ground truth: how many pixels are wrong, and how many of them nobody
// was told about.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "draw/renderer.h"
#include "reference/verification.h"

namespace luxo::random {

/// Counts are of samples: four per pixel where four are drawn.
struct Trial {
  PixelSize size;
  int samples = 1;
  std::uint64_t pixels = 0, hits = 0, undecided = 0;
  WrongPixels wrong;  ///< of all samples; `pixels` row * width + column
  /// Resolved colours that are not the mean of the truth's, where every sample of the pixel is right.
  std::uint64_t wrongColors = 0;
  double worstPx = 0;  ///< largest error of a point on the screen, among those of the right layer
  std::uint64_t unconverged = 0, uncertified = 0, resolvedByRays = 0, auditFailed = 0;  ///< as reports say
  /// Wrong, beyond what the report counts as unconverged or uncertified.
  std::uint64_t silentlyWrong = 0;
  double pictureSeconds = 0, referenceSeconds = 0;  ///< of all processors
  double drawSeconds = 0, castSeconds = 0;          ///< of these: of the colours alone
  bool complete = true;  ///< false: it was stopped, and the counts are of what was judged until then

  /// Whether the pictures cost more than was measured (engine/shell/README.md, section 4): twice the processor
  /// time of the reference, one second, and one for what devices compile: none of 4,145 random scenes, the
  /// worst of them 1.6 times and two seconds.
  [[nodiscard]] bool costly() const { return drawSeconds > 2 * castSeconds + 2; }
};

struct TrialOptions {
  int samples = 1;  ///< 1 or 4
  Skips skips = {};
  Audit audit = {};                                    ///< none: what is wrong in a proof is seen, not mended
  std::function<bool()> goesOn = [] { return true; };  ///< asked now and then
};

/// Processor time of this process so far, of all its threads.
[[nodiscard]] double processorSeconds();

/// Draws colour, (u, v) and numbers, at every sample's place, in exact shading, and casts the reference at
/// the same places. Of four samples each is judged in a picture of its own; the picture that resolves them
/// has to show the mean of the truth's colours. Cost: three pictures and one of the reference, four times
/// that (and one) with four samples; a hundred rays per wrong pixel. Errors as Renderer::render.
[[nodiscard]] Trial tryScene(Renderer& renderer, const Snapshot& snapshot, const TrialOptions& options = {});

}  // namespace luxo::random
