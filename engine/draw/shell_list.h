// SPDX-License-Identifier: Apache-2.0
// The draws of nodes whose surfaces are found in every pixel: which triangles of their shells, and in which
// state.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "cull/cull.h"
#include "draw/draw_list.h"
#include "draw/drawn_facing.h"
#include "draw/options.h"
#include "scene/snapshot.h"
#include "shell/shell_view.h"

namespace luxo {

/// Object units, where extreme scales round what is derived from sizes to 0.
inline constexpr double kLeastSpacing = 1e-200;

/// Fills DrawList::shellIndices, exactPatches, exactParameters, byRays, outlines and tooLarge.
class ShellList {
 public:
  /// All must outlive this.
  ShellList(const Snapshot& snapshot, const DrawOptions& options, Geometry& geometry, DrawList& list)
      : snapshot_(snapshot), options_(options), geometry_(geometry), list_(list) {}

  /// The draws of one node, and what they know of it.
  struct Draws {
    std::vector<DrawBatch> batches;
    shared::ExactInstance exact;
    Vec3 origin{0};  ///< of the shell's vertices
  };
  /// A draw for each formula of the surface, each side that is seen and each kind of search; nothing where
  /// all of the node is left to rays. `batch`: what is known of all of them.
  [[nodiscard]] std::optional<Draws> add(DrawBatch batch, const SnapshotNode& node, const VisibleNode& v);

  /// Of all nodes' draws, which are in the list by now: some of the pixels that rays graze.
  void listOutlines();
  /// After what is hidden has been dropped: the indices that nodes share follow all others.
  void placeSharedIndices();

 private:
  /// Where in sharedIndices_ the triangles are in whose patch no edge is a point, and those where one is.
  using Ranges = std::array<std::pair<std::uint32_t, std::uint32_t>, 2>;

  [[nodiscard]] std::shared_ptr<const Shell> shellOf(const SnapshotNode& node, const VisibleNode& v,
                                                     const PixelRect& pixels);
  void addNearSection(const SnapshotNode& node, const Shell& shell, const Shell::Part& part);
  void addDraws(std::vector<DrawBatch>& batches, DrawBatch batch, const ShellView& view,
                const std::optional<DrawnFacing>& facing, std::uint32_t firstIndex, std::uint32_t count);
  void addSharedDraws(std::vector<DrawBatch>& batches, DrawBatch batch, std::uint32_t firstIndex,
                      std::uint32_t count);
  void listOutline(const DrawBatch& batch, std::uint32_t instance, std::uint32_t index);
  [[nodiscard]] Ranges sharedRanges(const Shell& shell, std::uint32_t firstIndex, std::uint32_t count);
  [[nodiscard]] std::uint32_t patchesOf(const SnapshotNode& node, const Shell& shell);
  [[nodiscard]] bool sharesDraws(const PixelRect& pixels) const;

  const Snapshot& snapshot_;
  const DrawOptions& options_;
  Geometry& geometry_;
  DrawList& list_;
  std::map<std::pair<const void*, std::vector<double>>, std::uint32_t> firstPatchOf_;
  std::map<std::pair<const Shell*, std::uint32_t>, Ranges> sharedRanges_;
  std::vector<std::uint32_t> sharedIndices_;
  std::size_t drawnApart_ = 0;  ///< nodes that share no draws
};

}  // namespace luxo
