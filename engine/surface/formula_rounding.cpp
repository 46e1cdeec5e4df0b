// SPDX-License-Identifier: Apache-2.0
#include "surface/formula_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "math/float32.h"
#include "math/sampling.h"

namespace luxo {
namespace {

/// Places: of a surface, and of each patch at least. Measured: of a mirror with a radius of 30 m the four
/// corners tell less than half, and more places no more.
constexpr std::size_t kRoundingProbes = 512, kLeastRoundingProbes = 32;

}  // namespace

double formulaRounding(const Surface& surface, std::uint32_t patchNumber,
                       std::span<const double> parameters) {
  const Patch& patch = surface.patches()[patchNumber];
  const std::size_t probes = std::max(kRoundingProbes / surface.patchCount(), kLeastRoundingProbes);
  const PatchInputs all(patch, parameters);
  const std::span<const double> given = all;
  std::vector<double> inputs(given.begin(), given.end());
  if (patch.function->originOfU) inputs[*patch.function->originOfU - 2] = 0;
  const Vec2 low(patch.domain.u.lo - patch.originOfU(), patch.domain.v.lo),
      size(patch.domain.u.width(), patch.domain.v.width());
  const Tape& position = patch.function->position;
  double most = 0;
  for (std::size_t k = 0; k < probes; ++k) {
    const Vec2 at = roundedToFloat(low + quasirandomPoint(static_cast<double>(k)) * size);
    Vec3 exact;
    std::array<float, 3> rounded;
    position.evaluatePoint(at.x, at.y, inputs, std::span(&exact.x, 3));
    position.evaluateInSingle(static_cast<float>(at.x), static_cast<float>(at.y), inputs, rounded);
    const double moved = glm::length(Vec3(rounded[0], rounded[1], rounded[2]) - exact);
    if (std::isfinite(moved)) most = std::max(most, moved);
  }
  return most;
}

double formulaRounding(const Surface& surface, std::span<const double> parameters) {
  double most = 0;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch)
    most = std::max(most, formulaRounding(surface, patch, parameters));
  return most;
}

}  // namespace luxo
