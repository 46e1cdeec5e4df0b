// SPDX-License-Identifier: Apache-2.0
// A frame as data: a short list of named passes with what they read, write and draw. Whoever records them
// derives the barriers.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "draw/draw_list.h"
#include "draw/ray_points.h"
#include "draw/view_targets.h"
#include "gpu/pipeline.h"

namespace luxo {

/// Before a pass a target is cleared (to the background, to nothing found, to infinitely far), or holds what
/// it held.
enum class Begin { Clear, Keep };

/// Draws whose colours join those that are there in different ways are in passes of their own: shadows of
/// casters are united, in a target where points of rays replace what they find.
struct Attachment {
  Target target = Target::Color;
  Begin begin = Begin::Keep;
  gpu::Blend blend = gpu::Blend::None;  ///< how colours join those that are there

  friend bool operator==(const Attachment&, const Attachment&) = default;
};

/// Rows of the picture, of so many bands of them.
struct LayerBand {
  std::uint32_t index = 0, count = 1;
};

struct Pass {
  const char* name = "";
  std::vector<Attachment> colors;            ///< in the order of the fragment shaders' outputs
  std::optional<Begin> depth = Begin::Keep;  ///< of depthTarget; nothing: the pass does not test it
  Target depthTarget = Target::Depth;        ///< as large as the other targets
  std::vector<Target> reads;                 ///< sampled by its fragments
  bool layers = false;                  ///< its fragments read or write the lists of what is seen through
  bool searches = false;                ///< its fragments write the view's feedback
  std::span<const DrawBatch> batches;   ///< drawn in this order
  std::size_t group = 0;                ///< of DrawList::groups, where shadows or light are of one
  std::span<const CasterDraw> casters;  ///< shadows, on what was found; or layers
  std::span<const FlatShadowDraw> flatShadows;
  bool drawsLightMap = false, readsLightMap = false;  ///< of the group
  LayerBand band;
  bool clearsLayers = false, countsLayers = false;  ///< before it, and after it
  const RayPoints* rays = nullptr;    ///< drawn after these; onto shadows, or into layers, theirs
  std::span<const DrawState> shades;  ///< light on all that was found
  std::span<const RayShadow> pixels;  ///< where not empty: light in these alone
  bool asks = false;                  ///< its fragments may send rays into the scene
  bool probes = false;                ///< depths are copied from it, for the audit
};

/// What kind of frame it is.
struct FrameDesc {
  /// Points that rays have found for the last frame. Where something was drawn over what was found, that is
  /// drawn again.
  const RayPoints* rays = nullptr;
  bool relights = false;     ///< what was found is lit again, and nothing else
  bool emptyPasses = false;  ///< passes with nothing to draw are there, too
  bool probes = false;
  std::uint32_t layerBands = 1;  ///< LayerLists::bands()
};

/// The list must outlive the passes, and have its batches in their order (DrawList::opaque).
[[nodiscard]] std::vector<Pass> passesOf(const DrawList& list, const FrameDesc& frame);
std::vector<Pass> passesOf(const DrawList&& list, const FrameDesc& frame) = delete;

/// What a pass needs pipelines for, but for points of rays, which are few; and what these pipelines draw to.
[[nodiscard]] std::vector<DrawState> statesOf(const Pass& pass);
[[nodiscard]] TargetFormat formatOf(const Pass& pass, const PictureFormat& picture);

}  // namespace luxo
