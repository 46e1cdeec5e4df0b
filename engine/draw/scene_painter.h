// SPDX-License-Identifier: Apache-2.0
// Records pictures of snapshots: culls, tessellates, uploads what changed, records the passes. What it keeps
// serves all views: the renderer (files) and the viewer (window) both paint with it.
#pragma once

#include <functional>
#include <utility>

#include "draw/draw_list.h"
#include "draw/mesh_store.h"
#include "draw/options.h"
#include "draw/passes.h"
#include "draw/ray_points.h"
#include "draw/render_view.h"
#include "draw/scale_normalization.h"
#include "draw/scene_pipelines.h"
#include "draw/secondary_rays.h"
#include "draw/statistics.h"
#include "draw/texel_store.h"
#include "gpu/frame.h"

namespace luxo {

class ScenePainter {
 public:
  explicit ScenePainter(gpu::Context& context);

  /// Error(Scene): the shader of a material in the picture is none, or its uniforms are not of it; as
  /// record(), but nothing is drawn, and what only shows once it is joined with luxo's own stays unknown.
  /// Cost: culls, and compiles the shaders that are new.
  void check(const Snapshot& snapshot, const DrawOptions& options);

  /// Records everything needed into the ring's open recording and adds its cost to `statistics`. The picture
  /// is in view.picture() once the recording has been submitted and is complete. Throws Error(Scene): then
  /// nothing is recorded, and the view is as it was.
  void record(gpu::FrameRing& frames, VkCommandBuffer commands, RenderView& view, const Snapshot& scene,
              const DrawOptions& options, FrameStatistics& statistics);

  /// Records that the view's last picture gets these points, found in its doubtful pixels; where something is
  /// drawn over what is found, that is drawn again.
  void recordRays(gpu::FrameRing& frames, VkCommandBuffer commands, RenderView& view, const RayPoints& points,
                  FrameStatistics& statistics);

  /// Records that the points of the view's last picture are lit again, by shaders with what their rays have
  /// met by now. `points`: of that picture.
  void recordAnswers(gpu::FrameRing& frames, VkCommandBuffer commands, RenderView& view,
                     const SecondaryRays& rays, const RayPoints& points, FrameStatistics& statistics);

  /// What is asked now and then while shells are made: whether that should end. The recording goes on, and
  /// leaves what has none to rays.
  void setInterruption(std::function<bool()> asked) { geometry_.shells.setInterruption(std::move(asked)); }
  /// Whether that happened in the last recording: the next one makes what is missing.
  [[nodiscard]] bool interrupted() const { return geometry_.shells.interrupted(); }

 private:
  [[nodiscard]] DrawOptions possible(const Snapshot& snapshot, const DrawOptions& options) const;
  [[nodiscard]] DrawList listed(const Snapshot& snapshot, const DrawOptions& options,
                                FrameStatistics& statistics);
  void preparePipelines(const DrawList& list, const PictureFormat& format);
  void recordPasses(gpu::FrameRing& frames, VkCommandBuffer commands, RenderView& view,
                    const FrameDesc& frame, FrameStatistics& statistics);

  gpu::Context* context_;
  ScaleNormalization scaleNormalization_;
  ScenePipelines pipelines_;
  Geometry geometry_;
  MeshStore store_;
  TexelStore texels_;
};

}  // namespace luxo
