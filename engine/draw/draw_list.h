// SPDX-License-Identifier: Apache-2.0
// From what is visible to what is drawn: meshes, instance data, light sets, and as few draws as possible.
// Pure data: nothing here knows a device.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "cull/cull.h"
#include "draw/options.h"
#include "draw/statistics.h"
#include "scene/snapshot.h"
#include "shared/scene_data.h"
#include "tessellate/mesh_cache.h"

namespace luxo {

/// What decides the shaders and fixed-function state of a draw. Light counts are part of it (the loops over
/// lights unroll); which lights they are is data.
struct DrawState {
  Shading shading = Shading::Phong;
  Output output = Output::Color;
  std::uint32_t plainLights = 0, shadedLights = 0;
  bool blended = false;

  friend auto operator<=>(const DrawState&, const DrawState&) = default;
};

/// Which faces are left out. A curved surface that shows both sides is drawn in two halves, its near side
/// (Back culled) and its far side (Front culled): at the silhouette the two meet at equal depth, and rounding
/// must not let a spark of the far side through. Opaque far sides are pushed away by a fraction of a pixel's
/// slope.
enum class FaceCulling { None, Back, Front };

/// One indexed draw: consecutive instances of one mesh in one state.
struct DrawBatch {
  DrawState state;
  std::shared_ptr<const Mesh> mesh;
  FaceCulling culling = FaceCulling::None;
  bool flat = false;      ///< lies in one plane: its sides never meet
  bool mirrored = false;  ///< the transforms turn counter-clockwise into clockwise
  std::uint32_t lightSet = 0;
  std::uint32_t firstInstance = 0, instanceCount = 0;
};

struct DrawList {
  shared::ViewData view;
  std::vector<shared::InstanceData> instances;
  std::vector<shared::LightSet> lightSets;  ///< never empty
  std::vector<DrawBatch> opaque;            ///< grouped, roughly front to back
  std::vector<DrawBatch> transparent;       ///< strictly back to front
  double boundPx = 0;                       ///< largest proven error of a drawn mesh on the screen
};

/// Throws Error(Scene) when more lights reach a node than a shader takes (shared::kMostLights).
[[nodiscard]] DrawList listDraws(const Snapshot& snapshot, const VisibleList& visible,
                                 const DrawOptions& options, MeshCache& meshes);

}  // namespace luxo
