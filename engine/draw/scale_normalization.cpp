// SPDX-License-Identifier: Apache-2.0
#include "draw/scale_normalization.h"

#include <algorithm>
#include <cmath>

#include "math/transform.h"
#include "surface/scaled.h"

namespace luxo {
namespace {

/// How many times as large an object may seem, by the largest stretch of its transform, as it is.
constexpr double kMaxExcess = 64;

/// How far the transform stretches each axis, rounded to a power of two.
Vec3 powersOfTwo(const Mat3& linear) {
  Vec3 powers;
  for (int axis = 0; axis < 3; ++axis)
    powers[axis] = std::exp2(std::round(std::log2(glm::length(linear[axis]))));
  return powers;
}

/// Of triangles nothing is searched for.
bool isUneven(const SnapshotNode& node) {
  if (node.surface.isPolygonal()) return false;
  const Vec3 extent = node.boundsObject.extent();
  const Mat3& linear = node.worldFromObject.linear;
  Vec3 inWorld;
  for (int axis = 0; axis < 3; ++axis) inWorld[axis] = extent[axis] * glm::length(linear[axis]);
  const double seems = largestStretch(linear) * glm::length(extent), is = glm::length(inWorld);
  if (!(std::isfinite(seems) && seems > kMaxExcess * is)) return false;
  const Vec3 powers = powersOfTwo(linear);
  return std::isfinite(powers.x + powers.y + powers.z) && powers.x * powers.y * powers.z > 0;
}

}  // namespace

const Snapshot& ScaleNormalization::of(const Snapshot& snapshot) {
  if (std::ranges::none_of(snapshot.nodes, isUneven)) {
    known_.clear();
    return snapshot;
  }
  for (auto& [key, known] : known_) known.used = false;
  evened_ = snapshot;
  for (SnapshotNode& node : evened_.nodes) {
    if (!isUneven(node)) continue;
    const Vec3 scale = powersOfTwo(node.worldFromObject.linear);
    const auto [entry, isNew] = known_.try_emplace({node.surface.identity(), {scale.x, scale.y, scale.z}});
    Known& known = entry->second;
    if (isNew) known = {.from = node.surface, .scaled = scaled(node.surface, scale)};
    known.used = true;
    node.surface = known.scaled;
    node.evened = scale;
    for (int axis = 0; axis < 3; ++axis) node.worldFromObject.linear[axis] /= scale[axis];
    node.boundsObject = {node.boundsObject.min * scale, node.boundsObject.max * scale};
  }
  std::erase_if(known_, [](const auto& entry) { return !entry.second.used; });
  return evened_;
}

}  // namespace luxo
