// SPDX-License-Identifier: Apache-2.0
#include "required_error.h"

#include <fmt/format.h>

namespace luxo {

std::optional<RequirementMiss> requirementMiss(const FrameReport& frame, double mostPx) {
  const FrameError& error = frame.statistics.error;
  if (frame.reference) {
    if (error.boundPx <= mostPx) return std::nullopt;
    return RequirementMiss{
        fmt::format("{} pixels are undecided, so nothing is proven of them", frame.reference->undecided),
        "move the camera a little"};
  }
  // Written so that what is not a number misses.
  if (!(error.boundPx <= mostPx))
    return RequirementMiss{
        fmt::format("the proven error is {:.3g} px, more than the {:.3g} px required", error.boundPx, mostPx),
        "ask for a smaller --tolerance"};
  if (error.residualMaxPx && !(*error.residualMaxPx <= mostPx))
    return RequirementMiss{fmt::format("the largest residual is {:.3g} px, more than the {:.3g} px required",
                                       *error.residualMaxPx, mostPx),
                           "single precision allows no less here; --engine reference casts rays in double"};
  if (error.unconvergedPx > 0)
    return RequirementMiss{
        fmt::format("{} pixels are lost: their point of the surface was not found", error.unconvergedPx),
        "move the camera a little, or cast rays: --engine reference"};
  return std::nullopt;
}

}  // namespace luxo
