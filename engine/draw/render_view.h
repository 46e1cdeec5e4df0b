// SPDX-License-Identifier: Apache-2.0
// One view of a scene, of a camera: what is drawn in it, what of that is on the device, the targets it is
// drawn to, and what its searches have told. All else is shared by views (scene_painter.h).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "draw/draw_list.h"
#include "draw/layer_lists.h"
#include "draw/mirrored_buffer.h"
#include "draw/options.h"
#include "draw/ray_points.h"
#include "draw/scene_pipelines.h"
#include "draw/search_feedback.h"
#include "draw/texel_store.h"
#include "draw/trace_buffers.h"
#include "draw/view_targets.h"
#include "gpu/buffer.h"
#include "gpu/frame.h"
#include "shared/scene_data.h"

namespace luxo {

/// Pictures of a view overlap on the device: none waits for the one before, but for a slot still in use.
/// Refinement waits for each.
class RenderView {
 public:
  RenderView(gpu::Context& context, Precision precision);

  /// What the last recording, which has to be complete, leaves in doubt, by rows: a point that is lost, or
  /// seen and not certified; shadows; layers. `submit`: runs a recording, and waits for it; where anything is
  /// open.
  using Recording = std::function<void(VkCommandBuffer commands)>;
  [[nodiscard]] std::vector<Doubt> doubts(const std::function<void(const Recording& record)>& submit);
  /// The depths of found surfaces in the pixels that tell whether the picture is right (DrawOptions::audit).
  [[nodiscard]] std::vector<DepthProbe> probes();

  /// The points that pixels show of meshes. Cost: a copy of 12 bytes a pixel, where there are some.
  [[nodiscard]] ShownMeshes shown();

  /// Of the last recording.
  [[nodiscard]] const DrawList& list() const { return list_; }
  [[nodiscard]] const DrawOptions& options() const { return options_; }
  /// Whether what is seen through had no room in the last recording, which has to be complete, but will have
  /// in the next, which finds all anew.
  [[nodiscard]] bool makeRoom();
  /// How many points of it there are in that, and are not, for want of room. Where some are not, the next
  /// recording finds all anew.
  [[nodiscard]] LayerLists::Found layerPoints();
  /// Whether there has to be more room for what rays have found, and will be when all is recorded anew.
  [[nodiscard]] bool makeRoomFor(const RayPoints& points);
  /// Whether it finds surfaces, by searches or by rays.
  [[nodiscard]] bool searches() const { return !list_.found.empty() || !list_.layers.found.empty(); }
  /// Whether the last recording has lit again what the one before it has found.
  [[nodiscard]] bool relit() const { return relit_; }
  /// What shaders of materials do that they must not, in the last recording, which has to be complete: of all
  /// points that were lit, be they seen or not.
  [[nodiscard]] shared::ShaderFaults shaderFaults();
  /// Scene-linear RGBA, one sample, row 0 at the top.
  [[nodiscard]] gpu::Texture& picture() { return targets_.picture(); }

  // What follows is for who records.

  /// Another recording begins, with these draws: makes room for them, and uploads what differs from the last.
  void begin(DrawList list, const DrawOptions& options, const VkClearColorValue& background,
             VkExtent2D extent);
  /// The last one goes on with points that rays have found.
  void goOn(const RayPoints& points);
  /// What the last one has found stays, as that is all that these draws would find (draw/found_alike.h): it
  /// is lit again.
  void relight(DrawList list, const VkClearColorValue& background);
  /// Whether that may be, and the targets hold it: nothing of it was in a recording that was thrown away.
  [[nodiscard]] bool hasFound(const Snapshot& snapshot, const DrawList& list, const DrawOptions& options,
                              const gpu::FrameRing& frames) const;
  /// All of the last one is recorded, of this snapshot.
  void recorded(const Snapshot& snapshot, const gpu::FrameRing& frames);

  /// What draws read, in an open recording.
  struct Bindings {
    VkDescriptorSet scene = VK_NULL_HANDLE;
    VkBuffer instances = VK_NULL_HANDLE;            ///< of that, for vertices
    VkDescriptorSet pattern = VK_NULL_HANDLE;       ///< where a draw has a pattern
    VkDescriptorSet texture = VK_NULL_HANDLE;       ///< where a draw has a texture
    VkDescriptorSet foundTexture = VK_NULL_HANDLE;  ///< and lights what was found
    VkDescriptorSet exact = VK_NULL_HANDLE;         ///< where a draw has a shell
    VkBuffer shellIndices = VK_NULL_HANDLE;         ///< where a draw has a shell
    VkBuffer clusterIndices = VK_NULL_HANDLE;       ///< where a draw is of some clusters
    VkDescriptorSet sceneOfRays = VK_NULL_HANDLE;   ///< of the points that rays have found
    VkBuffer rayVertices = VK_NULL_HANDLE;          ///< these
    VkBuffer rayShadows = VK_NULL_HANDLE;           ///< and the shadows there
    VkBuffer rayLayers = VK_NULL_HANDLE;            ///< and what is seen through there
    VkDescriptorSet shadow = VK_NULL_HANDLE;        ///< where casters are looked for
    std::vector<VkDescriptorSet> found;  ///< what the passes of a deferred picture have found, for each group
    std::vector<VkDescriptorSet> layers;  ///< where something is seen through, by slot of groups
  };
  [[nodiscard]] Bindings bind(gpu::FrameRing& frames, ScenePipelines& pipelines, TexelStore& texels);

  [[nodiscard]] ViewTargets& targets() { return targets_; }
  [[nodiscard]] SearchFeedback& feedback() { return feedback_; }
  /// Where the list traces: what shaders ask, and the answers.
  [[nodiscard]] TraceBuffers& traces() { return traces_; }
  [[nodiscard]] LayerLists& layerLists() { return layerLists_; }
  /// Where the list runs shaders.
  [[nodiscard]] gpu::Buffer& faults() { return faults_; }
  [[nodiscard]] const VkClearColorValue& background() const { return background_; }
  /// Where a light set is in the buffer of them all.
  [[nodiscard]] std::uint32_t lightOffset(std::uint32_t lightSet) const;

 private:
  /// A draw list on the device.
  struct Uploads {
    MirroredBuffer view, instances, materials, lights, patternParameters, exactInstances, exactPatches,
        exactParameters, shellIndices, clusterIndices, casters, meshPlaces, closedCasters, gridStarts,
        gridEntries, casterCells, casterParameters, lightMaps;
  };

  [[nodiscard]] bool makeRoomForMore(std::size_t points);
  /// To those of layers, where the lists have been copied.
  void addMeshPoints(std::vector<Doubt>& doubts);
  void upload(bool always);
  void uploadCasters(bool always);
  void bindTextures(gpu::FrameRing& frames, ScenePipelines& pipelines, VkBufferView texels,
                    Bindings& bindings);
  [[nodiscard]] VkDescriptorSet bindFound(gpu::FrameRing& frames, ScenePipelines& pipelines,
                                          std::size_t index);
  [[nodiscard]] VkDescriptorSet bindCasters(gpu::FrameRing& frames, ScenePipelines& pipelines,
                                            VkBufferView texels);
  [[nodiscard]] VkDescriptorSet bindLayers(gpu::FrameRing& frames, ScenePipelines& pipelines,
                                           std::size_t slot);
  [[nodiscard]] std::vector<PixelPlace> chooseProbes() const;

  gpu::Context* context_;
  ViewTargets targets_;
  SearchFeedback feedback_;
  LayerLists layerLists_;
  TraceBuffers traces_;
  gpu::Buffer faults_;
  DrawList list_;
  DrawOptions options_;
  VkClearColorValue background_{};
  Uploads uploads_;
  MirroredBuffer rayVertices_, rayShadows_, rayInstances_, rayLayers_, rayLayerPoints_, rayLayerLights_,
      rayLayerDetails_;
  bool hasRays_ = false, relit_ = false;
  /// A recording that keeps what it finds.
  struct Recorded {
    Snapshot snapshot;
    const gpu::FrameRing* frames;
    std::uint64_t thrownAway;  ///< FrameRing::thrownAway() then
  };
  std::optional<Recorded> recorded_;
};

}  // namespace luxo
