// SPDX-License-Identifier: Apache-2.0
// What the exact shaders know of a node: its pixels as linear functions of its points, and its patches.
#pragma once

#include <span>
#include <vector>

#include "cull/cull.h"
#include "scene/snapshot.h"
#include "shared/scene_data.h"
#include "tessellate/hull.h"

namespace luxo {

/// Largest residual of a point that is drawn, pixels, where single precision allows: what it rounds away of the
/// picture's distances and of the object's size may be more.
inline constexpr double kExactTolerancePx = 1e-4;

/// All of the instance but firstPatch and wrong.
[[nodiscard]] shared::ExactInstance exactInstance(const View& view, const SnapshotNode& node,
                                                  const VisibleNode& visible);

/// Appends the patches of a hull, and the values of their formulas' parameters.
void appendPatches(const Surface& surface, std::span<const double> parameters, const Hull& hull,
                   std::vector<shared::ExactPatch>& patches, std::vector<float>& values);

/// Whether the eye may be inside the hull, or so near that the near plane may be.
[[nodiscard]] bool mayHoldEye(const View& view, const SnapshotNode& node, const VisibleNode& visible,
                              const Hull& hull);

}  // namespace luxo
