// SPDX-License-Identifier: Apache-2.0
// Casters of shadows that are known as equations: shaders solve these along the light's rays
// (shaders/lib/closed_test.glsl), without a grid and without cells.
#pragma once

#include <cstdint>
#include <optional>

#include "scene/snapshot.h"
#include "shadow/caster_cache.h"
#include "shared/scene_data.h"

namespace luxo {

struct ClosedCaster {
  std::uint32_t kind = shared::kClosedQuadric;
  /// All but the light's bit, the material and the flags that both do not decide.
  shared::ClosedCaster data{};
};

/// How far points that shadows fall on may be off their surfaces.
struct OffSurfaces {
  double px = 0;        ///< of what is drawn near to them
  double rounding = 0;  ///< what formulas lose in single precision; metres
};

/// `light`: world; w = 1: where it is; w = 0: the direction toward it. `origin`: what positions are relative
/// to, world.
///
/// Nothing of a node without equations, or with several that are not the sheets of one; nor where the light
/// is on the quadric or inside of the torus, as near as 1e-6, or a torus is nearly or more than closed: cells
/// tell there. Cost: a microsecond, and that of the equation once (CasterCache).
[[nodiscard]] std::optional<ClosedCaster> closedCaster(const Snapshot& snapshot, const SnapshotNode& node,
                                                       const Vec4& light, const Vec3& origin,
                                                       const OffSurfaces& off, CasterCache& casters);

}  // namespace luxo
