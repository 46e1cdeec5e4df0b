// SPDX-License-Identifier: Apache-2.0
// What the searches of a recording tell the host: which pixels are in doubt, and how deep some pixels are,
// for the audit.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "draw/draw_list.h"
#include "draw/pixel_rows.h"
#include "draw/ray_points.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/frame.h"
#include "gpu/texture.h"

namespace luxo {

/// A pixel in which searches lost a surface, or found what they could not certify, in any layer; or that is
/// left to rays from the start; or whose shadows, or layers, are open.
struct OpenPixel {
  PixelPlace pixel;
  bool point;  ///< or left to rays
  bool shadows;
  bool layers;
  bool left;  ///< to rays, whatever is shown
};

/// What a pixel shows of what searches find.
struct ShownDepth {
  float depth = 0;        ///< as in the depth buffer
  bool certified = true;  ///< the point, or that there is none
};

/// In a ring: a recording does not wait for what the one before it tells.
class SearchFeedback {
 public:
  explicit SearchFeedback(gpu::Context& context) : context_(&context) {}

  /// A recording begins. `probed`: the pixels whose depths are told. Waits only for a slot that is still in
  /// use.
  void begin(const DrawList& list, VkExtent2D extent, std::vector<PixelPlace> probed);

  /// What searches write; only where the list has shells or shadows.
  [[nodiscard]] gpu::Buffer& doubtful() { return slots_[current_].doubtful; }
  /// Which points pixels show of meshes; only where the list finds these.
  [[nodiscard]] gpu::Buffer& shown() { return slots_[current_].shown; }
  [[nodiscard]] bool probes() const { return !slots_[current_].probed.empty(); }
  /// Copies the depths of the probed pixels.
  void recordProbes(VkCommandBuffer commands, gpu::Texture& depth);
  /// And the shadows there, of a group of lights that has some; and of one that transmits how much.
  void recordShadowProbes(VkCommandBuffer commands, gpu::Texture& shadows, std::size_t group);
  void recordTransmittanceProbes(VkCommandBuffer commands, gpu::Texture& transmittance, std::size_t group);
  /// And their colours, at the recording's end.
  void recordColorProbes(VkCommandBuffer commands, gpu::Texture& picture);
  /// Copies what pixels show of a recording that is complete; the picture's alphas are certificates
  /// (shaders/lib/exact_fragment.glsl).
  void recordShown(VkCommandBuffer commands, gpu::Texture& depth, gpu::Texture& picture,
                   std::span<const PixelPlace> pixels);

  /// The recording after the last one goes on with it.
  void goOn();

  /// What follows is of the last recording, which has to be complete.
  /// By rows. `byRays`: what is left to rays; `shadowsByRays`: the shadows of which are.
  [[nodiscard]] std::vector<OpenPixel> open(std::span<const PixelRect> byRays,
                                            std::span<const PixelRect> shadowsByRays);
  [[nodiscard]] std::vector<DepthProbe> depths();
  /// As recordShown() has copied it, of each of its pixels.
  [[nodiscard]] std::vector<ShownDepth> shown(std::span<const PixelPlace> pixels);
  /// By rows, all.
  [[nodiscard]] std::vector<shared::ShownPoint> shownPoints();

 private:
  struct Slot {
    gpu::Buffer doubtful;                 ///< some bits a pixel
    gpu::Buffer shown;                    ///< shared::ShownPoint of each pixel
    gpu::Buffer depths;                   ///< of the probed pixels, or of all where they are many
    gpu::Buffer shadows, transmittances;  ///< and by group of lights
    gpu::Buffer colors;                   ///< of the probed pixels, or of all
    VkDeviceSize colorBytes = 0;          ///< of a pixel
    std::size_t lightGroups = 0;          ///< so many are added up
    std::vector<PixelPlace> probed;
    bool searches = false;  ///< for surfaces, shadows or layers
    std::size_t shadowGroups = 0;
    std::vector<bool> transmits;  ///< which groups do
    std::uint64_t submission = 0;
  };

  void prepareDoubts(Slot& slot);
  void prepareShown(Slot& slot);
  void prepareProbes(Slot& slot, std::vector<PixelPlace> probed);
  void recordProbes(VkCommandBuffer commands, gpu::Texture& texture, VkImageAspectFlags aspect,
                    gpu::Buffer& values, VkDeviceSize texelBytes, VkDeviceSize offset);
  [[nodiscard]] VkDeviceSize probeBytes(const Slot& slot) const;

  gpu::Context* context_;
  VkExtent2D extent_{};
  std::array<Slot, gpu::FrameRing::kFrames> slots_;
  std::size_t current_ = 0;
  /// Of the pixels that recordShown() was given, or of all.
  gpu::Buffer shownDepths_, shownColors_;
  VkDeviceSize shownColorBytes_ = 0;  ///< of a pixel
};

}  // namespace luxo
