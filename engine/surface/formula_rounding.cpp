// SPDX-License-Identifier: Apache-2.0
#include "surface/formula_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "math/float32.h"
#include "math/sampling.h"

namespace luxo {

double formulaRounding(const Patch& patch, std::span<const double> parameters, std::size_t probes) {
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

}  // namespace luxo
