// SPDX-License-Identifier: Apache-2.0
#include "gpu/usage.h"

#include "base/assert.h"

namespace luxo::gpu {
namespace {

constexpr VkPipelineStageFlags2 kDepthTests =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags2 kDepthAccesses =
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags2 kColorAccesses =
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;

bool applies(const Scope& scope, ResourceKind kind) {
  switch (scope.layout) {
    case VK_IMAGE_LAYOUT_UNDEFINED:
      return kind == ResourceKind::Buffer;
    case VK_IMAGE_LAYOUT_GENERAL:
    case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
    case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL:
      return true;
    default:
      return kind == ResourceKind::Image;
  }
}

}  // namespace

Scope scopeOf(Use use) noexcept {
  switch (use) {
    case Use::ColorAttachment:
      return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, kColorAccesses,
              VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true};
    case Use::ResolveTarget:
      return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
              VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true};
    case Use::DepthAttachment:
      return {kDepthTests, kDepthAccesses, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true};
    case Use::TransferSource:
      return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
              VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, false};
    case Use::TransferDestination:
      return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true};
    case Use::SampledFragment:
      return {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
              VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, false};
    case Use::VertexBuffer:
      return {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT};
    case Use::IndexBuffer:
      return {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT};
    case Use::StorageWrite:
      return {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
              VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
              VK_IMAGE_LAYOUT_GENERAL, true};
    case Use::ComputeStorage:
      return {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
              VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
              VK_IMAGE_LAYOUT_UNDEFINED, true};
    case Use::HostRead:
      return {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
    case Use::Present:
      // The semaphore that presenting waits for does the rest; the stage chains with the next acquire's wait.
      return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_NONE,
              VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, false};
  }
  return {};
}

ResourceState ResourceState::acquired(VkPipelineStageFlags2 waitStage) {
  ResourceState state(ResourceKind::Image);
  state.writeStages_ = waitStage;
  return state;
}

std::optional<Dependency> ResourceState::advance(Use use, Contents contents) {
  const Scope scope = scopeOf(use);
  const bool image = kind_ == ResourceKind::Image;
  LUXO_REQUIRE(applies(scope, kind_));
  const VkImageLayout layout = image ? scope.layout : VK_IMAGE_LAYOUT_UNDEFINED;
  const bool moves = layout != layout_;

  const bool untouched = writeStages_ == VK_PIPELINE_STAGE_2_NONE && readStages_ == VK_PIPELINE_STAGE_2_NONE;
  const bool seen = (scope.stages & ~readStages_) == 0 && (scope.accesses & ~readAccesses_) == 0;
  const bool unwritten = writeStages_ == VK_PIPELINE_STAGE_2_NONE;
  const bool needed = moves || (scope.writes ? !untouched : !seen && !unwritten);

  std::optional<Dependency> dependency;
  if (needed) {
    const bool excludes = moves || scope.writes;  // must come after the reads too
    // Reads came after the write and through a barrier of their own, so waiting for them waits for it, and it
    // is available already.
    const bool afterReads = excludes && readStages_ != VK_PIPELINE_STAGE_2_NONE;
    dependency = {.sourceStages = afterReads ? readStages_ : writeStages_,
                  .sourceAccesses = afterReads ? VK_ACCESS_2_NONE : writeAccesses_,
                  .destinationStages = scope.stages,
                  .destinationAccesses = scope.accesses,
                  .oldLayout = contents == Contents::Discard ? VK_IMAGE_LAYOUT_UNDEFINED : layout_,
                  .newLayout = layout};
    if (!image) dependency->oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  }

  if (scope.writes || moves) {
    writeStages_ = scope.stages;
    writeAccesses_ = scope.writes ? scope.accesses : VK_ACCESS_2_NONE;
    readStages_ = VK_PIPELINE_STAGE_2_NONE;
    readAccesses_ = VK_ACCESS_2_NONE;
  }
  if (!scope.writes) {
    readStages_ |= scope.stages;
    readAccesses_ |= scope.accesses;
  }
  layout_ = layout;
  return dependency;
}

}  // namespace luxo::gpu
