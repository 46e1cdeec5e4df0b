// SPDX-License-Identifier: Apache-2.0
// Records passes: their barriers, their targets, their draws.
#pragma once

#include <span>

#include "draw/mesh_store.h"
#include "draw/passes.h"
#include "draw/render_view.h"
#include "draw/scene_pipelines.h"
#include "draw/statistics.h"
#include "gpu/context.h"

namespace luxo {

/// Of one view, into one open recording.
class PassRecorder {
 public:
  PassRecorder(gpu::Context& context, ScenePipelines& pipelines, MeshStore& store, RenderView& view,
               const RenderView::Bindings& bindings, VkCommandBuffer commands, FrameStatistics& statistics)
      : context_(context),
        pipelines_(pipelines),
        store_(store),
        view_(view),
        bindings_(bindings),
        commands_(commands),
        statistics_(statistics) {}

  void record(const Pass& pass);

 private:
  struct IndexRange {
    std::uint32_t first = 0, end = 0;
  };
  struct InstanceRange {
    std::uint32_t first = 0, count = 0;
  };

  [[nodiscard]] VkClearColorValue clearOf(Target target) const;
  void useTargets(const Pass& pass);
  void begin(const Pass& pass);
  void setScissor(const PixelRect& rect);
  void bindPaint(const gpu::GraphicsPipeline& pipeline, const DrawState& state);
  void draw(const DrawBatch& batch);
  void drawRays(const RayPoints& points);
  void shade(const DrawState& state, std::size_t group, std::span<const PixelRect> areas);
  void search(const CasterDraw& draw);
  void flattenShadow(const FlatShadowDraw& draw);
  void drawShadows(Form form, const RayPoints& points, std::size_t group);
  void drawLayers(const RayPoints& points, std::size_t group);
  void drawTriangles(const DrawState& state, VkBuffer vertices, std::uint32_t first,
                     std::uint32_t vertexCount, std::uint32_t instance = 0);
  void drawLightMap(std::size_t group);
  void drawIntoMap(const gpu::GraphicsPipeline& pipeline, const LightMapDrawn::Caster& caster,
                   std::uint32_t face);
  void compareWithMap(Form form, std::size_t group);
  void drawWhole(std::uint32_t instance);
  void clearMisses(std::span<const PixelPlace> misses);
  void bindIndices(const DeviceMesh& mesh);
  /// Gives how many draws that took.
  std::uint32_t drawWindows(const DeviceMesh& mesh, IndexRange range, InstanceRange instances);
  void drawAll(const DeviceMesh& mesh, std::size_t vertices);
  /// `triangles` and `vertices`: of one instance.
  void count(std::uint32_t draws, std::uint32_t instances, std::uint64_t triangles, std::uint64_t vertices);

  gpu::Context& context_;
  ScenePipelines& pipelines_;
  MeshStore& store_;
  RenderView& view_;
  const RenderView::Bindings& bindings_;
  VkCommandBuffer commands_;
  FrameStatistics& statistics_;
  // Of the pass.
  TargetFormat format_;
  std::size_t slot_ = 0;                    ///< of the shadows of its group
  VkDescriptorSet found_ = VK_NULL_HANDLE;  ///< with these
  VkDescriptorSet layers_ = VK_NULL_HANDLE;
  PixelRect rows_;
};

}  // namespace luxo
