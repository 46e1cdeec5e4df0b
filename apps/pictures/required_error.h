// SPDX-License-Identifier: Apache-2.0
// `--require-error`: whether what a frame says of its error is enough.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "report.h"

namespace luxo {

struct RequirementMiss {
  std::string what, hint;
};

/// That so many pixels are not converged.
[[nodiscard]] std::string unconvergedText(std::uint64_t pixels);

/// What of the frame is farther than `mostPx` pixels from its surface, or not known to be nearer: meshes by
/// their proven bound; pixels of exact shading by their largest residual, and there is none too many of those
/// that were lost; pixels of the reference by being proven. Nothing: the requirement is met. A point that is
/// not proven to be the nearest one to the viewer lies on its surface as well as the others do; those are
/// counted apart, as uncertified.
[[nodiscard]] std::optional<RequirementMiss> requirementMiss(const FrameReport& frame, double mostPx);

}  // namespace luxo
