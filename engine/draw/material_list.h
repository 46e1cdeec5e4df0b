// SPDX-License-Identifier: Apache-2.0
// The materials of a picture as shaders read them, their patterns, and the light on what is lit later.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "cull/cull.h"
#include "draw/draw_list.h"
#include "draw/light_sets.h"
#include "draw/options.h"
#include "scene/snapshot.h"

namespace luxo {

/// Fills DrawList::materials, patternParameters, textures, deferred, findsParameters, findsFootprints,
/// findsFrames, findsPlaces, and groups but for their shadows.
class MaterialList {
 public:
  /// All must outlive this. The list is deferred where DrawOptions::composition says. Throws Error(Scene)
  /// where ambient light is occluded, or shaders send rays, and it cannot be.
  MaterialList(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
               DrawList& list);

  /// The number of a material of the snapshot; listed when first asked for. `shadeOf`:
  /// LightSets::Choice::shadeOf.
  /// `node`: where there are shadows each node has a number of its own, as has what is seen through.
  [[nodiscard]] std::uint32_t numberOf(std::uint32_t material, std::uint32_t shadeOf, std::uint32_t node);
  /// Of a node of the snapshot, once it is listed; kMaxFoundMaterials of others.
  [[nodiscard]] std::uint32_t numberOfNode(std::uint32_t node) const;

  /// Where the parameters of its paint on a node are in DrawList::patternParameters: they are put there.
  [[nodiscard]] std::uint32_t firstPatternParameter(const Material& material, const SnapshotNode& node,
                                                    const Paint& paint);

  /// Whether draws of this state leave the light to a later pass: of what light falls on per fragment, with
  /// nothing else.
  [[nodiscard]] bool litLater(const DrawState& state) const;
  /// Turns the state of a draw that finds and lights into one that finds, and notes the light that is left to
  /// do: that of all lights of the picture, as those that do not reach a node add nothing. Light between
  /// vertices, and drawings, are left to another draw of the same.
  LightSets::Choice lightLater(DrawBatch& batch, LightSets& lightSets, const SnapshotNode& node);
  /// As lightLater(), of what is seen through.
  LightSets::Choice lightLayer(DrawBatch& batch, LightSets& lightSets, const SnapshotNode& node);
  /// Once all nodes are listed, and draws are in their order.
  void listShades();
  /// The lights of a group, in the order of its set: indices into Snapshot::lights.
  [[nodiscard]] const std::vector<std::uint32_t>& lightsOf(std::size_t group) const { return groups_[group]; }
  /// Whether some light of the picture has a shadow that has to be found.
  [[nodiscard]] bool shadows() const { return shadows_; }

 private:
  /// Notes a draw of each group that lights a pattern; gives LightSets::Choice::shadeOf.
  std::uint32_t shadeLater(const DrawState& shade, LightSets& lightSets, const SnapshotNode& node,
                           std::vector<std::set<DrawState>>& shades);
  [[nodiscard]] std::uint32_t patternNumber(const Paint& pattern);

  void listAgain(const DrawBatch& batch, bool layer);

  const Snapshot& snapshot_;
  const DrawOptions& options_;
  DrawList& list_;
  /// By material, shadeOf and, where there are shadows, node.
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> numberOf_;
  std::map<std::uint32_t, std::uint32_t> numberOfNode_;  ///< where there are shadows
  std::map<Paint, std::uint32_t> patternNumbers_;
  std::vector<std::vector<std::uint32_t>> groups_;         ///< the lights of each
  std::vector<std::set<DrawState>> shades_, layerShades_;  ///< of each
  bool shadows_ = false;
  bool crowded_ = false;  ///< more lights reach a node than one set has room for
};

}  // namespace luxo
