// SPDX-License-Identifier: Apache-2.0
// Graphics and compute pipelines as data: everything has a default, one struct overrides it; and what shaders
// say themselves (attributes, push constants, what they must be given) is read from them.
#pragma once

#include "gpu/descriptor.h"
#include "gpu/handle.h"
#include "gpu/shader_optimizer.h"
#include "gpu/vk.h"

#include <compare>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace luxo::gpu {

enum class Blend {
  None,
  Alpha,     ///< source over destination, colours not premultiplied; alpha becomes coverage
  Color,     ///< as Alpha, but the destination's alpha stays
  Mean,      ///< the part of the source that vkCmdSetBlendConstants() says, the rest of the destination; the
             ///< larger alpha
  Through,   ///< the source, and of the destination the part that a second source says; alpha stays; needs
             ///< features().dualSrcBlend
  Add,       ///< the sum of colours; the destination's alpha
  Multiply,  ///< the product of colours; the destination's alpha
  Lighten,   ///< the larger of colours; the destination's alpha
  Or,        ///< of integers: bits that are set in either; needs features().logicOp
};

/// Added to the depth of what is drawn: units of the depth buffer's resolution, and of the depth's largest
/// slope per pixel. With reversed depth negative values push away.
struct DepthBias {
  float constant = 0, slope = 0;
};

/// What fragments are drawn onto, and how they join what is there.
struct ColorAttachment {
  VkFormat format = VK_FORMAT_UNDEFINED;
  Blend blend = Blend::None;

  friend auto operator<=>(const ColorAttachment&, const ColorAttachment&) = default;
};

/// For dynamic rendering. Viewport, scissor, cull mode, front face and depth bias are
/// always dynamic (see below); so are the blend constants of Blend::Mean.
struct GraphicsPipelineDesc {
  std::string_view name;
  std::span<const std::uint32_t> vertexShader;    ///< SPIR-V, entry `main`
  std::span<const std::uint32_t> fragmentShader;  ///< SPIR-V; empty = depth only

  /// What there is: attributes that the vertex shader does not read are left out, with bindings that have no
  /// other; and there must be one for all that it reads, of the same type (gpu/vertex_input.h).
  std::vector<VkVertexInputBindingDescription> bindings;
  std::vector<VkVertexInputAttributeDescription> attributes;
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPolygonMode polygonMode = VK_POLYGON_MODE_FILL;  ///< others need features().fillModeNonSolid

  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  /// In the order of the fragment shader's outputs; none: fragments write buffers, or depth. Blends that
  /// differ need features().independentBlend; Or is of all or of none.
  std::vector<ColorAttachment> colors;
  bool colorWrite = true;                      ///< off: all colours stay, and depth alone is drawn
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;  ///< undefined: no depth buffer, and none of the next two

  /// Triangles are not cut where they are nearer than the near plane: their depth is clamped. Where
  /// features().depthClamp is missing they are cut.
  bool depthClamp = false;
  bool depthWrite = true;
  VkCompareOp depthCompare = VK_COMPARE_OP_GREATER;  ///< reversed depth: nearer is greater, cleared to 0

  /// Of both stages; one that a shader does not have is left out of it. There must be one for all that either
  /// declares.
  std::vector<SpecializationConstant> specialization;
  SetLayouts setLayouts;  ///< with all descriptors that either stage uses (gpu/stage_resources.h)
};

/// Whether some attachment does.
[[nodiscard]] bool blendsBy(const GraphicsPipelineDesc& desc, Blend blend);

class GraphicsPipeline {
 public:
  GraphicsPipeline() = default;
  /// 0.4 to 1.1 ms, of exact shaders 15 to 40 ms; a CPU device compiles more at the first draw (20 to 43 ms).
  /// Throws Error on failure.
  GraphicsPipeline(Context& context, const GraphicsPipelineDesc& desc);

  /// One for each description, made on all cores: drivers compile in the thread that asks them to.
  [[nodiscard]] static std::vector<GraphicsPipeline> makeAll(Context& context,
                                                             std::span<const GraphicsPipelineDesc> descs);

  operator VkPipeline() const noexcept { return pipeline_; }
  explicit operator bool() const noexcept { return static_cast<bool>(pipeline_); }
  [[nodiscard]] VkPipelineLayout layout() const noexcept { return layout_; }

  /// Sets no depth bias, too.
  void bind(VkCommandBuffer commands) const;
  /// Requires as many bytes as the shaders have.
  void push(VkCommandBuffer commands, std::span<const std::byte> constants) const;
  void bindSet(VkCommandBuffer commands, std::uint32_t index, VkDescriptorSet set,
               std::span<const std::uint32_t> dynamicOffsets = {}) const;

 private:
  std::uint32_t pushConstantBytes_ = 0;
  Handle<VkPipelineLayout> layout_;
  Handle<VkPipeline> pipeline_;
};

struct ComputePipelineDesc {
  std::string_view name;
  std::span<const std::uint32_t> shader;  ///< SPIR-V, entry `main`, without specialization constants
  SetLayouts setLayouts;                  ///< with all descriptors that it uses
};

class ComputePipeline {
 public:
  ComputePipeline() = default;
  /// Some 5 to 20 ms where no cache has it. Throws Error on failure.
  ComputePipeline(Context& context, const ComputePipelineDesc& desc);

  explicit operator bool() const noexcept { return static_cast<bool>(pipeline_); }

  void bind(VkCommandBuffer commands) const;
  /// Requires as many bytes as the shaders have.
  void push(VkCommandBuffer commands, std::span<const std::byte> constants) const;
  void bindSet(VkCommandBuffer commands, std::uint32_t index, VkDescriptorSet set) const;

 private:
  std::uint32_t pushConstantBytes_ = 0;
  Handle<VkPipelineLayout> layout_;
  Handle<VkPipeline> pipeline_;
};

/// Until the next pipeline is bound.
void setDepthBias(VkCommandBuffer commands, DepthBias bias);

/// Viewport and scissor of the whole target with y up: clip-space (-1, -1) is the bottom left, depth goes 0
/// to 1. VK_FRONT_FACE_COUNTER_CLOCKWISE then means counter-clockwise as seen in the picture. With a guard of
/// g the picture is the middle g-th of clip space, and triangles are cut at the edges of a viewport g times
/// as large, which must be within limits().maxViewportDimensions.
void setViewport(VkCommandBuffer commands, VkExtent2D extent, float guard = 1);
/// The same of a part of the target.
void setViewport(VkCommandBuffer commands, const VkRect2D& part, float guard = 1);

}  // namespace luxo::gpu
