// SPDX-License-Identifier: Apache-2.0
#include "required_error.h"

#include <fmt/format.h>

#include <string>

namespace luxo {
namespace {

/// With three digits, or as many as it takes to differ from `other`.
std::string shown(double value, double other) {
  constexpr int kAllDigits = 17;
  std::string text;
  for (int digits = 3; digits <= kAllDigits; ++digits) {
    text = fmt::format("{:.{}g}", value, digits);
    if (text != fmt::format("{:.{}g}", other, digits)) break;
  }
  return text;
}

}  // namespace

std::string unconvergedText(std::uint64_t pixels) {
  return fmt::format("{} pixels are lost: no attempt found their point of the surface, or their light",
                     pixels);
}

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
    return RequirementMiss{fmt::format("the proven error is {} px, more than the {} px required",
                                       shown(error.boundPx, mostPx), shown(mostPx, error.boundPx)),
                           "ask for a smaller --tolerance"};
  if (error.residualMaxPx && !(*error.residualMaxPx <= mostPx))
    return RequirementMiss{
        fmt::format("the largest residual is {} px, more than the {} px required",
                    shown(*error.residualMaxPx, mostPx), shown(mostPx, *error.residualMaxPx)),
        "single precision allows no less here; --engine reference casts rays in double"};
  if (error.unconvergedPx > 0)
    return RequirementMiss{unconvergedText(error.unconvergedPx),
                           "move the camera a little, or cast rays: --engine reference"};
  return std::nullopt;
}

}  // namespace luxo
