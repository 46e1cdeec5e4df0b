// SPDX-License-Identifier: Apache-2.0
#include "draw/exact_data.h"

#include <algorithm>
#include <cmath>

namespace luxo {
namespace {

// Far outside of every domain, and harmless in single precision.
constexpr float kNoPole = 1e30f;

/// What single precision rounds away of a number, a few times over.
constexpr double kRounding = 3 * 0x1p-24;

/// How far the node's points are from its origin, in metres of the world.
double reach(const SnapshotNode& node, const VisibleNode& visible) {
  return std::max(glm::length(node.boundsObject.min), glm::length(node.boundsObject.max)) * visible.stretch;
}

/// Row `row` of clipFromEye as a linear function of the object's points.
Vec4 clipRow(const View& view, const Transform& eyeFromObject, int row) {
  Vec3 inEye;
  for (int column = 0; column < 3; ++column) inEye[column] = view.clipFromEye[column][row];
  return {glm::transpose(eyeFromObject.linear) * inEye,
          glm::dot(inEye, eyeFromObject.translation) + view.clipFromEye[3][row]};
}

}  // namespace

shared::ExactInstance exactInstance(const View& view, const SnapshotNode& node, const VisibleNode& visible) {
  const Transform eye = eyeFromObject(view, node.worldFromObject);
  const Vec2 half(0.5 * view.size.width, 0.5 * view.size.height);
  const Vec4 depth(-(glm::transpose(eye.linear) * Vec3(0, 0, 1)), -eye.translation.z);
  const double range = view.far - view.near;
  const double rounding = kRounding * view.pixelsPerUnit;
  // Of what has the size of the distance, and of the object.
  const double everywhere = rounding * (view.perspective() ? 1 : glm::length(view.halfExtent) + reach(node, visible));
  return {.x = Vec4f(half.x * clipRow(view, eye, 0)),
          .y = Vec4f(-half.y * clipRow(view, eye, 1)),
          .depth = Vec4f(depth),
          .clipDepth = view.perspective() ? Vec2f(view.near, rounding * reach(node, visible))
                                           : Vec2f(view.far / range, -1 / range),
          .half_ = Vec2f(half),
          .translation = Vec3f(node.worldFromObject.translation - view.eye),
          .facing = visible.mirrored ? 1.0f : -1.0f,
          .tolerance = static_cast<float>(std::max(kExactTolerancePx, everywhere)),
          .firstPatch = 0,
          .wrong = 0};
}

void appendPatches(const Surface& surface, std::span<const double> parameters, const Hull& hull,
                   std::vector<shared::ExactPatch>& patches, std::vector<float>& values) {
  for (std::uint32_t i = 0; i < surface.patchCount(); ++i) {
    const HullPatch& patch = hull.patchData[i];
    const Domain& domain = patch.domain;
    const bool ofU = patch.collapsedUMin || patch.collapsedUMax;
    const Interval& across = ofU ? domain.u : domain.v;
    const bool low = ofU ? patch.collapsedUMin : patch.collapsedVMin;
    const bool high = ofU ? patch.collapsedUMax : patch.collapsedVMax;
    patches.push_back({.domain = Vec4f(domain.u.lo, domain.v.lo, domain.u.hi, domain.v.hi),
                       .wraps = Vec2f(patch.wrapsU ? domain.u.width() : 0, patch.wrapsV ? domain.v.width() : 0),
                       .poles = Vec2f(low ? static_cast<float>(across.lo) : -kNoPole,
                                      high ? static_cast<float>(across.hi) : kNoPole),
                       .polesOfU = ofU,
                       .orientation = static_cast<float>(patch.orientation),
                       .firstParameter = static_cast<std::uint32_t>(values.size())});
    const PatchInputs inputs(surface.patches()[i], parameters);
    const std::span<const double> all = inputs;
    values.insert(values.end(), all.begin(), all.end());
  }
  if (values.empty()) values.push_back(0);  // something to bind
}

bool mayHoldEye(const View& view, const SnapshotNode& node, const VisibleNode& visible, const Hull& hull) {
  const double margin = 2 * hull.offset * visible.stretch + 2 * view.near;
  const Box& box = node.boundsWorld;
  for (int i = 0; i < 3; ++i)
    if (!(view.eye[i] >= box.min[i] - margin && view.eye[i] <= box.max[i] + margin)) return false;
  return true;
}

}  // namespace luxo
