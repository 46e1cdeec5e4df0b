// SPDX-License-Identifier: Apache-2.0
// Surfaces that are hard to draw exactly, as the text of scene files: random ones of each kind that has a
// name.
#pragma once

#include <nlohmann/json.hpp>

#include <span>
#include <string_view>

#include "random/numbers.h"

namespace luxo::random {

using Json = nlohmann::ordered_json;

struct SurfaceKind {
  std::string_view name, what;
  /// An entry of a scene file's `surfaces`.
  Json (*make)(Numbers& numbers);
};

/// All kinds; the order decides which scene an index stands for.
[[nodiscard]] std::span<const SurfaceKind> surfaceKinds();

}  // namespace luxo::random
