// SPDX-License-Identifier: Apache-2.0
// What must happen between two uses of a resource: the state tracker from which every barrier comes, but for
// those around a batch of uploads (transfer.cpp), which are of all memory. Pure. Synchronization validation
// (1.3.239) does not see dynamic-rendering attachments, so this is what keeps them right.
#pragma once

#include "gpu/vk.h"

#include <optional>

namespace luxo::gpu {

/// How a command is about to use a resource. Shaders here are vertex and fragment shaders, unless said
/// otherwise.
enum class Use {
  ColorAttachment,  ///< drawn to, blended with, loaded, or the source of a resolve
  ResolveTarget,    ///< a colour resolve writes it
  DepthAttachment,  ///< tested and written
  TransferSource,
  TransferDestination,  ///< copied or cleared into
  SampledFragment,      ///< a texture in the fragment shader
  VertexBuffer,
  IndexBuffer,
  StorageWrite,    ///< read, written or counted in, by the fragment shader
  ComputeStorage,  ///< read and written by a compute shader
  HostRead,        ///< mapped memory, read by the host once the submission is complete
  Present,         ///< handed to the window system
};

inline constexpr Use kLastUse = Use::Present;

/// What becomes of what the resource holds.
enum class Contents {
  Keep,
  Discard,  ///< the use overwrites all of it, or does not care: cheaper
};

/// Where in the pipeline a use happens, what it does to memory, and the layout an image must be in.
struct Scope {
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 accesses = VK_ACCESS_2_NONE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  bool writes = false;
};

[[nodiscard]] Scope scopeOf(Use use) noexcept;

/// The two halves of a barrier: everything in `source` happens before, and is seen by, everything in
/// `destination`.
struct Dependency {
  VkPipelineStageFlags2 sourceStages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 sourceAccesses = VK_ACCESS_2_NONE;
  VkPipelineStageFlags2 destinationStages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 destinationAccesses = VK_ACCESS_2_NONE;
  VkImageLayout oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageLayout newLayout = VK_IMAGE_LAYOUT_UNDEFINED;

  friend bool operator==(const Dependency&, const Dependency&) = default;
};

enum class ResourceKind { Buffer, Image };

/// The uses of one resource so far, in the order of recording, which must be the order of submission. Host
/// writes need no use: a submission makes all that was written (and flushed) before it visible.
class ResourceState {
 public:
  explicit ResourceState(ResourceKind kind) : kind_(kind) {}

  /// A swapchain image just acquired: its contents are gone, and the submission waits for it before
  /// `waitStage`.
  [[nodiscard]] static ResourceState acquired(VkPipelineStageFlags2 waitStage);

  /// Notes the use and returns what must come before it; nothing when it can follow at once: a first use of a
  /// buffer, or a read of what is already seen there.
  [[nodiscard]] std::optional<Dependency> advance(Use use, Contents contents = Contents::Keep);

  [[nodiscard]] VkImageLayout layout() const noexcept { return layout_; }

 private:
  ResourceKind kind_;
  VkImageLayout layout_ = VK_IMAGE_LAYOUT_UNDEFINED;
  // The last write (a change of layout is one) and the reads since.
  VkPipelineStageFlags2 writeStages_ = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 writeAccesses_ = VK_ACCESS_2_NONE;
  VkPipelineStageFlags2 readStages_ = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 readAccesses_ = VK_ACCESS_2_NONE;
};

}  // namespace luxo::gpu
