// SPDX-License-Identifier: Apache-2.0
// Surfaces as rays from one point meet them: their cells and that point's grid of them, for shaders that look
// for shadows, where the point is a light, and for what is seen through, where it is the eye.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "draw/draw_list.h"

namespace luxo {

/// Patches of a node whose points the same code finds, and the parameters of each.
struct CasterPart {
  SurfaceCodePtr code;
  std::vector<std::uint32_t> patches;
  std::vector<std::vector<double>> parameters;
};

/// By their general form, where they have one: surfaces of one name share it.
[[nodiscard]] std::vector<CasterPart> casterParts(SurfaceCodes& codes, const SnapshotNode& node);

/// Fills DrawList::casters.
class CasterList {
 public:
  /// All must outlive this.
  CasterList(const Snapshot& snapshot, Geometry& geometry, DrawList& list)
      : snapshot_(snapshot), geometry_(geometry), list_(list) {}

  /// What a shader needs to look for a part of a node; whoever asks adds what he asks for.
  struct Entry {
    std::optional<shared::ShadowCaster> caster;  ///< nothing of a part without points
    std::shared_ptr<const CasterCells> cells;
  };
  /// `from`: world; w = 1: the point; w = 0: the direction toward it. Nothing where shaders cannot find the
  /// part: it ends nowhere, or its formula is too large.
  [[nodiscard]] std::optional<Entry> entryOf(const SnapshotNode& node, const CasterPart& part,
                                             const Vec4& from, int gridSize);
  /// The number of the caster.
  std::uint32_t add(const shared::ShadowCaster& caster);

  /// Pixels in which anything of these points is; nothing where none are, all where one is behind the eye.
  [[nodiscard]] std::optional<PixelRect> pixelsAround(std::span<const Vec3> points) const;

 private:
  void addCells(const CasterCells& cells, const Surface& surface, const CasterPart& part);

  const Snapshot& snapshot_;
  Geometry& geometry_;
  DrawList& list_;
};

}  // namespace luxo
