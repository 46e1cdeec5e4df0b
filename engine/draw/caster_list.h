// SPDX-License-Identifier: Apache-2.0
// Surfaces as rays from one point meet them: their cells and that point's grid of them, for shaders that look
// for shadows, where the point is a light, and for what is seen through, where it is the eye.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "draw/draw_list.h"
#include "surface/caster_code.h"

namespace luxo {

/// What a formula loses is measured at some hundred places, and a bound has to hold everywhere.
inline constexpr double kTimesMeasured = 4;

/// Of each buffer of DrawList::casters: what every device binds at once (maxStorageBufferRange).
inline constexpr std::size_t kMaxCasterBytes = std::size_t{1} << 27;

/// Fills DrawList::casters.
class CasterList {
 public:
  /// All must outlive this.
  CasterList(const Snapshot& snapshot, Geometry& geometry, DrawList& list);

  /// What a shader needs to look for a node; whoever asks adds what he asks for.
  struct Entry {
    std::optional<shared::ShadowCaster> caster;  ///< nothing of one without points
    std::shared_ptr<const CasterCells> cells;
  };
  /// `from`: world; w = 1: the point; w = 0: the direction toward it. Nothing where shaders cannot find it:
  /// it ends nowhere, its formula is too large, or there is no room for more (kMaxCasterBytes).
  [[nodiscard]] std::optional<Entry> entryOf(const SnapshotNode& node, const CasterCode& found,
                                             const Vec4& from, int gridSize);
  /// Whether single precision loses more of the caster's formula than of the distances involved. Where a
  /// light grazes what it falls on, what a caster is off by moves its shadow far more: rays find that.
  [[nodiscard]] bool losesMore(const SnapshotNode& node);
  /// How far from its surface floats leave a point of a mesh that is found by its parameters
  /// (shaders/lib/surface_place.glsl); metres.
  [[nodiscard]] double roundingOfPlaces(const SnapshotNode& node);
  /// The number of the caster.
  std::uint32_t add(const shared::ShadowCaster& caster);

  /// Pixels in which anything of these points is; nothing where none are, all where one is behind the eye.
  [[nodiscard]] std::optional<PixelRect> pixelsAround(std::span<const Vec3> points) const;

 private:
  /// Where in the list cells and their parameters begin: they are put there once.
  struct Place {
    std::shared_ptr<const CasterCells> cells;
    std::uint32_t firstCell = 0, firstParameter = 0;
  };
  const Place& placeOf(const std::shared_ptr<const CasterCells>& cells, const SnapshotNode& node,
                       const CasterCode& found);
  void addCells(const CasterCells& cells, const Surface& surface);
  void addTriangles(const SurfaceTriangles& triangles, bool parameters);
  /// Whether where on a triangle a ray meets it decides how much light gets through.
  [[nodiscard]] bool readsParameters(const SnapshotNode& node) const;
  /// One whose share of the room is enough: grids may be of any size, and those of a thousand lights, or of
  /// as many layers, are smaller.
  [[nodiscard]] std::shared_ptr<const LightGrid> gridThatFits(const SnapshotNode& node,
                                                              const Vec4& fromObject, int gridSize);

  const Snapshot& snapshot_;
  Geometry& geometry_;
  DrawList& list_;
  std::size_t share_;  ///< bytes that one entry may take of a buffer
  std::map<std::pair<const CasterCells*, bool>, Place> places_;  ///< of triangles, with their parameters?
};

}  // namespace luxo
