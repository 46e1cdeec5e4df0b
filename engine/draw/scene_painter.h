// SPDX-License-Identifier: Apache-2.0
// Records a snapshot into a command buffer: culls, tessellates, uploads what changed, draws the passes.
// The renderer (files) and the viewer (window) both paint with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "draw/draw_list.h"
#include "draw/mesh_store.h"
#include "draw/options.h"
#include "draw/ray_points.h"
#include "draw/scale_normalization.h"
#include "draw/scene_pipelines.h"
#include "draw/statistics.h"
#include "gpu/frame.h"
#include "gpu/texture.h"

namespace luxo {

/// Precision of the linear picture: files take Full, which is exact to float; a window shows 8 bits and takes
/// Half.
enum class Precision { Full, Half };

class ScenePainter {
 public:
  ScenePainter(gpu::Context& context, Precision precision);

  /// Records everything needed into the ring's open recording and adds its cost to `statistics`. The picture
  /// is in target() once the recording has been submitted and is complete. Throws Error(Scene).
  void record(gpu::FrameRing& frames, VkCommandBuffer commands, const Snapshot& scene,
              const DrawOptions& options, FrameStatistics& statistics,
              const SearchRefinement& refinement = {});

  /// Records that the last recording's picture gets these points, found in its doubtful pixels; where
  /// something is drawn over what is found, that is drawn again. Nothing may have been recorded since.
  void recordRays(gpu::FrameRing& frames, VkCommandBuffer commands, const RayPoints& points,
                  FrameStatistics& statistics);

  /// What is asked now and then while shells are made: whether that should end. The recording goes on, and
  /// leaves what has none to rays.
  void setInterruption(std::function<bool()> asked) { geometry_.shells.setInterruption(std::move(asked)); }
  /// Whether that happened in the last recording: the next one makes what is missing.
  [[nodiscard]] bool interrupted() const { return geometry_.shells.interrupted(); }

  /// Of the last recording, which has to be complete.
  [[nodiscard]] LostPixels lostPixels();
  /// Pixels in which searches lost a surface, or found what they could not certify, in any layer; and those
  /// that are left to rays from the start. By rows.
  struct Doubt {
    PixelPlace pixel;
    bool lost;  ///< or left to rays
  };
  [[nodiscard]] std::vector<Doubt> doubts();
  /// The depths of found surfaces in the pixels that tell whether the picture is right (DrawOptions::audit).
  [[nodiscard]] std::vector<DepthProbe> probes();
  [[nodiscard]] const DrawList& list() const { return list_; }
  /// Whether a recording that draws only what the last one lost completes the picture: nothing is seen
  /// through.
  [[nodiscard]] bool completable() const { return completable_; }
  /// Whether the last recording finds surfaces, by searches or by rays.
  [[nodiscard]] bool searches() const { return !list_.found.empty(); }

  /// The last recorded picture: scene-linear RGBA, one sample, row 0 at the top.
  [[nodiscard]] gpu::Texture& target() { return resolved_ ? resolved_ : color_; }

 private:
  /// A buffer that follows what the host has: written only when its bytes differ from the last.
  struct Mirror {
    gpu::Buffer buffer;
    std::vector<std::byte> bytes;
  };

  /// A draw list on the device.
  struct Uploads {
    Mirror view, instances, lights, patternParameters, exactInstances, exactPatches, exactParameters,
        shellIndices;
  };

  struct Bindings {
    VkDescriptorSet scene = VK_NULL_HANDLE;
    VkDescriptorSet pattern = VK_NULL_HANDLE;  ///< where a draw has a pattern
    VkDescriptorSet exact = VK_NULL_HANDLE;    ///< where a draw has a shell
    VkBuffer shellIndices = VK_NULL_HANDLE;    ///< where a draw has a shell
  };

  /// What rays have found, on the device.
  struct RayDraws {
    const RayPoints& points;
    VkDescriptorSet pattern = VK_NULL_HANDLE;
    VkDescriptorSet scene = VK_NULL_HANDLE;
  };

  void prepareTargets(VkExtent2D extent, VkSampleCountFlagBits samples);
  void preparePipelines();
  [[nodiscard]] Bindings bind(gpu::FrameRing& frames, const Uploads& uploads, const gpu::Buffer& instances);
  void clearDoubts(bool searches);
  void chooseProbes();
  /// The passes of a frame: what is found, meshes, what is seen through. With `rays` what is found is there
  /// already, if nothing was drawn over it.
  void recordPasses(VkCommandBuffer commands, const Bindings& bindings, bool completes, const RayDraws* rays,
                    FrameStatistics& statistics);
  void recordProbes(VkCommandBuffer commands);
  void paintRays(VkCommandBuffer commands, const RayDraws& rays, FrameStatistics& statistics);
  void upload(const DrawList& list, const shared::ViewData& view, bool always, Uploads& uploads);
  void clearFeedback(const DrawList& list);
  void write(Mirror& mirror, std::span<const std::byte> bytes, VkBufferUsageFlags usage, const char* name,
             bool always);
  void paint(VkCommandBuffer commands, const Bindings& bindings, std::span<const DrawBatch> batches,
             FrameStatistics& statistics);

  gpu::Context* context_;
  PassFormat format_;
  ScaleNormalization scaleNormalization_;
  ScenePipelines pipelines_;
  Geometry geometry_;
  MeshStore store_;
  Uploads uploads_, completion_;  ///< what completes a picture does not overwrite what the next begins with
  gpu::Buffer feedback_;          ///< of the last recording: by slot, then by instance
  std::vector<std::uint32_t> feedbackNodes_;
  DrawList list_;        ///< of the last recording
  DrawOptions options_;  ///< its, as far as the device is able
  VkClearColorValue background_{};
  gpu::Buffer doubts_;  ///< two bits a pixel
  std::vector<PixelPlace> probed_;
  gpu::Buffer probes_;  ///< their depths, or those of all pixels
  bool probesAll_ = false;
  Mirror rayVertices_, rayInstances_;
  bool completable_ = false;
  VkDeviceSize lightStride_ = 0;
  gpu::Texture color_, resolved_, depth_;
};

}  // namespace luxo
