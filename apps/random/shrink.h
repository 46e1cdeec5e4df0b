// SPDX-License-Identifier: Apache-2.0
// From a scene that fails to a small one that fails as well: delta debugging on the scene's JSON (A. Zeller,
// R. Hildebrandt, "Simplifying and isolating failure-inducing input", 2002), greedy.
#pragma once

#include <functional>
#include <optional>

#include "random/hard_surface.h"
#include "random/trial.h"

namespace luxo::random {

/// What a scene does: its trial where it fails, nothing where it does not or is no scene.
using Failure = std::function<std::optional<Trial>(const Json& scene)>;

struct ShrinkLimits {
  int trials = 200;
  double seconds = 60;  ///< of the wall's clock; the trial at hand is finished
};

/// The smallest scene found: fewer nodes, one sample, a small picture aimed at a wrong pixel with pixels as
/// large as before, fewer terms, smaller domains, rounder numbers. `scene` has `render.size` and a camera and
/// fails with `first`. Cost: the trials.
[[nodiscard]] Json shrunk(const Json& scene, const Trial& first, const Failure& failure,
                          const ShrinkLimits& limits = {});

}  // namespace luxo::random
