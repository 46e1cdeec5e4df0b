// SPDX-License-Identifier: Apache-2.0
#include "mesh/model.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "mesh/turn.h"

namespace luxo {
namespace {

Vec4 unitQuaternion(const Vec4& q) {
  const double length = glm::length(q);
  return length > 0 ? q / length : Vec4(0, 0, 0, 1);
}

// Shoemake, Animating rotation with quaternion curves, 1985; chords where arcs are as good.
Vec4 slerp(const Vec4& a, Vec4 b, double part) {
  double cosine = glm::dot(a, b);
  if (cosine < 0) {  // q and -q are one rotation: the shorter way
    b = -b;
    cosine = -cosine;
  }
  if (cosine > 1 - 1e-9) return unitQuaternion(a + part * (b - a));
  const double angle = std::acos(cosine);
  return unitQuaternion((std::sin((1 - part) * angle) * a + std::sin(part * angle) * b) / std::sin(angle));
}

}  // namespace

Vec4 Keyframes::at(double seconds, bool rotation) const {
  const bool cubic = interpolation == Interpolation::CubicSpline;
  LUXO_REQUIRE(!times.empty() && values.size() == (cubic ? 3 : 1) * times.size());
  const auto value = [&](std::size_t key) { return values[cubic ? 3 * key + 1 : key]; };
  const auto normal = [&](const Vec4& v) { return rotation ? unitQuaternion(v) : v; };
  const auto after = std::size_t(std::upper_bound(times.begin(), times.end(), seconds) - times.begin());
  if (after == 0) return normal(value(0));
  const std::size_t before = after - 1;
  if (after == times.size() || interpolation == Interpolation::Step) return normal(value(before));

  const double length = times[after] - times[before], part = (seconds - times[before]) / length;
  if (!cubic)
    return rotation ? slerp(normal(value(before)), normal(value(after)), part)
                    : value(before) + part * (value(after) - value(before));
  // Hermite's cubic; the tangents are per second.
  const double p2 = part * part, p3 = p2 * part;
  return normal((2 * p3 - 3 * p2 + 1) * value(before) +
                length * (p3 - 2 * p2 + part) * values[3 * before + 2] + (3 * p2 - 2 * p3) * value(after) +
                length * (p3 - p2) * values[3 * after]);
}

Vec3 ModelNode::translationAt(double seconds) const {
  return translationKeys ? Vec3(translationKeys->at(seconds, false)) : translation;
}
Vec4 ModelNode::rotationAt(double seconds) const {
  return rotationKeys ? rotationKeys->at(seconds, true) : rotation;
}
Vec3 ModelNode::scaleAt(double seconds) const {
  return scaleKeys ? Vec3(scaleKeys->at(seconds, false)) : scale;
}
Transform ModelNode::parentFromNodeAt(double seconds) const {
  return compose(translationAt(seconds), rotationOf(rotationAt(seconds)), scaleAt(seconds));
}

Transform worldFromNodeAt(const Model& model, std::uint32_t node, double seconds) {
  std::vector<std::uint32_t> path;  // files nest nodes as deep as they like: no recursion
  for (std::uint32_t i = node; i != kNone; i = model.nodes[i].parent) path.push_back(i);
  Transform worldFromNode = model.nodes[path.back()].parentFromNodeAt(seconds);
  for (std::size_t i = path.size() - 1; i-- > 0;)
    worldFromNode = worldFromNode * model.nodes[path[i]].parentFromNodeAt(seconds);
  return worldFromNode;
}

std::vector<Transform> worldFromNodesAt(const Model& model, double seconds) {
  std::vector<Transform> worldFromNode;
  worldFromNode.reserve(model.nodes.size());
  for (const ModelNode& node : model.nodes) {
    const Transform local = node.parentFromNodeAt(seconds);
    worldFromNode.push_back(node.parent == kNone ? local : worldFromNode[node.parent] * local);
  }
  return worldFromNode;
}

std::uint64_t Model::triangleCount() const {
  std::uint64_t count = 0;
  for (const TriangleMesh& mesh : meshes) count += mesh.triangleCount();
  return count;
}

}  // namespace luxo
