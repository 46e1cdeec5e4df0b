// SPDX-License-Identifier: Apache-2.0
// Points of a snapshot's surfaces as pictures name them, by node and (u, v), or of triangles by node and
// place; and whether two of them are of one layer.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reference/cell_tree.h"
#include "scene/snapshot.h"

namespace luxo::reference {

/// A point of a surface that a picture may show.
struct Place {
  std::uint32_t node = 0;  ///< index into Snapshot::nodes
  std::uint32_t patch = 0;
  Vec2 parameters{0};
  Vec3 position{0};  ///< world
  Vec2 pixel{0};     ///< pixel coordinates (scene/view.h)
};

/// Reads a snapshot, which must outlive it. Safe from any thread.
class Layers {
 public:
  explicit Layers(const Snapshot& snapshot);

  /// The index of the node of that number (SnapshotNode::number); nothing: there is none.
  [[nodiscard]] std::optional<std::uint32_t> nodeOf(double number) const;

  /// The point at (u, v), evaluated in double; a thousandth of a patch beyond its edge is still of the patch.
  /// Where several patches meet, the one whose point is nearest to `near`. Nothing when (u, v) is far from
  /// all of them, and when the point is not finite or behind the eye.
  [[nodiscard]] std::optional<Place> at(std::uint32_t node, const Vec2& parameters, const Vec3& near) const;

  /// A point of triangles, where the picture says it is: as far off the triangle as off the ray. Nothing when
  /// it is not finite or behind the eye.
  [[nodiscard]] std::optional<Place> onTriangle(std::uint32_t node, const Vec2& parameters,
                                                const Vec3& position) const;

  /// Whether the surface leads from `shown` to `seen`, which lies on the ray of `pixel`, without leaving the
  /// pixel's neighbourhood on the screen: within twice the distance at which `shown` is, and a thousandth of
  /// a pixel. `normal`: at `seen`, of the triangle itself where it is on one.
  [[nodiscard]] bool same(const Place& shown, const Place& seen, const Vec3& normal, const Vec2& pixel) const;

  /// Metres that a pixel is wide at this depth.
  [[nodiscard]] double footprint(const Vec3& position) const;

 private:
  [[nodiscard]] std::optional<Place> place(std::uint32_t node, std::uint32_t patch,
                                           const Vec2& parameters) const;
  [[nodiscard]] std::optional<Place> placed(std::uint32_t node, std::uint32_t patch, const Vec2& parameters,
                                            const Vec3& position) const;
  [[nodiscard]] bool staysNear(const Place& from, const Vec2& to, const Vec2& pixel, double radius) const;

  const Snapshot& snapshot_;
  std::vector<std::vector<BoundedPatch>> patches_;  // as Snapshot::nodes
  std::vector<std::uint32_t> nodeOfNumber_;
};

}  // namespace luxo::reference
