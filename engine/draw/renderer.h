// SPDX-License-Identifier: Apache-2.0
// Scene -> picture, without any window. The one class a user of luxo needs.
//
//     luxo::Renderer renderer;
//     renderer.render(scene).image.save("picture.png");
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "draw/accumulation.h"
#include "draw/device_cloth_simulation.h"
#include "draw/device_vertex_movement.h"
#include "draw/options.h"
#include "draw/refinement.h"
#include "draw/scene_painter.h"
#include "draw/statistics.h"
#include "gpu/context.h"
#include "gpu/transfer.h"
#include "image/image.h"
#include "scene/scene.h"
#include "scene/snapshot.h"

namespace luxo {

/// Scene-linear float samples, unclamped: three channels, or one for depth and id. Where nothing is hit,
/// auxiliary outputs are 0 and depth is +infinity.
struct Picture {
  Image image;
  FrameStatistics statistics;
};

/// The options a scene asks for itself.
[[nodiscard]] DrawOptions drawOptions(const RenderSettings& settings);

/// Keeps meshes, pipelines and buffers from picture to picture, so that the next one does less.
/// Single-threaded. Every submission is waited for: refinement reads what searches tell. Pictures overlap
/// only where a RenderView is used alone.
class Renderer {
 public:
  /// On the best device; throws Error(Device) when there is none.
  Renderer();
  /// On a device of the caller's, which must outlive the renderer.
  explicit Renderer(gpu::Context& context);

  /// The scene as its own settings describe it: size, time, shading, first camera. Its cloth, and the
  /// meshes that vertex programs move, are moved by this renderer's device.
  [[nodiscard]] Picture render(const Scene& scene);
  /// Asked for the same picture again it submits nothing and reads that once more; with skips.unchanged off
  /// it draws.
  /// Throws Error(Scene) for what cannot be drawn, Error(Retry) when the device runs out of memory or is
  /// lost.
  [[nodiscard]] Picture render(const Snapshot& snapshot, const DrawOptions& options = {});
  /// The same, for those who wait: before every pass it tells how much is done, from 0 to 1, and gives up,
  /// without a picture, once the answer is no.
  [[nodiscard]] std::optional<Picture> render(const Snapshot& snapshot, const DrawOptions& options,
                                              const std::function<bool(double done)>& goesOn);

  [[nodiscard]] gpu::Context& context() { return *context_; }

 private:
  using Recording = RenderView::Recording;

  /// What the readback holds, and how good it is.
  struct Shown {
    Snapshot snapshot;
    DrawOptions options;
    FrameStatistics statistics;
  };

  /// Whether the device takes that many samples in one pass. Where surfaces are searched for each sample is a
  /// picture of its own, with its own certificates and audit: no slower, as searches run once per sample
  /// anyway.
  [[nodiscard]] bool inOnePass(const Snapshot& snapshot, const DrawOptions& options) const;
  /// As its settings ask for, with cloth and meshes that this renderer's device moves.
  [[nodiscard]] Snapshot snapshotOf(const Scene& scene);
  /// Draws one sample of each pixel into the view, refines it, and reads that back.
  void draw(const Snapshot& snapshot, const DrawOptions& options, FrameStatistics& statistics);
  /// Runs what `record` records, and waits.
  void submit(const Recording& record, FrameStatistics& statistics);
  /// Adds what the painter drew last to the mean of `before` others, and reads that back if it is complete.
  void accumulate(int before, bool complete, FrameStatistics& statistics);
  void recordReadback(VkCommandBuffer commands, gpu::Texture& picture);
  [[nodiscard]] Image readPicture(const Snapshot& snapshot, const DrawOptions& options, FrameError& error);

  std::unique_ptr<gpu::Context> owned_;
  gpu::Context* context_;
  gpu::FrameRing frames_;
  ScenePainter painter_;
  RenderView view_;
  std::optional<Accumulator> accumulator_;  ///< made for the first picture of several passes
  Refinement refinement_{frames_, painter_, view_};
  gpu::Readback readback_;
  VkExtent2D readbackExtent_{};
  std::optional<Shown> shown_;
  std::shared_ptr<DeviceClothSimulation> cloth_;    ///< of scenes; made for the first that has some
  std::shared_ptr<DeviceVertexMovement> vertices_;  ///< the same
};

}  // namespace luxo
