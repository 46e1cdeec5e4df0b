// SPDX-License-Identifier: Apache-2.0
#include "gpu/pipeline.h"

#include "base/assert.h"
#include "base/stopwatch.h"
#include "gpu/address_space.h"
#include "gpu/debug.h"
#include "gpu/result.h"
#include "gpu/shader_reflection.h"
#include "gpu/stage_resources.h"
#include "gpu/vertex_input.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace luxo::gpu {
namespace {

constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

std::uint32_t count(const auto& range) { return static_cast<std::uint32_t>(range.size()); }

// Lives as long as it takes to build the pipeline, so it is destroyed at once.
class ShaderModule {
 public:
  ShaderModule(VkDevice device, std::span<const std::uint32_t> spirv, std::string_view pipeline)
      : device_(device) {
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = spirv.size_bytes(),
                                        .pCode = spirv.data()};
    check(vkCreateShaderModule(device_, &info, nullptr, &module_),
          fmt::format("load a shader of pipeline \"{}\"", pipeline));
  }
  ~ShaderModule() { vkDestroyShaderModule(device_, module_, nullptr); }
  ShaderModule(const ShaderModule&) = delete;
  ShaderModule& operator=(const ShaderModule&) = delete;

  operator VkShaderModule() const noexcept { return module_; }

 private:
  VkDevice device_;
  VkShaderModule module_ = VK_NULL_HANDLE;
};

VkPipelineColorBlendAttachmentState blendState(Blend blend) {
  VkPipelineColorBlendAttachmentState state{.colorWriteMask =
                                                VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                                VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT};
  if (blend == Blend::None || blend == Blend::Or) return state;
  state.blendEnable = VK_TRUE;
  if (blend == Blend::Through) {
    state.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
    state.dstColorBlendFactor = VK_BLEND_FACTOR_SRC1_COLOR;
    state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    return state;
  }
  if (blend == Blend::Add) {
    state.srcColorBlendFactor = state.dstColorBlendFactor = state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    return state;
  }
  if (blend == Blend::Lighten) {
    state.srcColorBlendFactor = state.dstColorBlendFactor = state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    state.colorBlendOp = VK_BLEND_OP_MAX;
    return state;
  }
  if (blend == Blend::Multiply) {
    state.srcColorBlendFactor = VK_BLEND_FACTOR_DST_COLOR;
    state.dstColorBlendFactor = state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    return state;
  }
  if (blend == Blend::Mean) {
    state.srcColorBlendFactor = VK_BLEND_FACTOR_CONSTANT_COLOR;
    state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR;
    state.alphaBlendOp = VK_BLEND_OP_MAX;
    return state;
  }
  state.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
  state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.srcAlphaBlendFactor = blend == Blend::Alpha ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ZERO;
  state.dstAlphaBlendFactor =
      blend == Blend::Alpha ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  return state;
}

std::vector<VkPipelineColorBlendAttachmentState> blendStates(const GraphicsPipelineDesc& desc) {
  std::vector<VkPipelineColorBlendAttachmentState> states;
  for (const ColorAttachment& color : desc.colors)
    states.push_back(desc.colorWrite ? blendState(color.blend) : VkPipelineColorBlendAttachmentState{});
  return states;
}

std::vector<std::span<const DescriptorBinding>> bindingsOf(const SetLayouts& layouts) {
  std::vector<std::span<const DescriptorBinding>> bindings;
  for (const DescriptorLayout& layout : layouts) bindings.emplace_back(layout.bindings());
  return bindings;
}

/// What the shaders of a pipeline ask for, beside what they must be given.
struct Asked {
  std::vector<StageInput> inputs;
  std::uint32_t pushConstantBytes = 0;
};

Asked askedBy(const GraphicsPipelineDesc& desc) {
  const StageResources ofVertices = stageResources(desc.vertexShader),
                       ofFragments = stageResources(desc.fragmentShader);
  GivenResources given{desc.name, VK_SHADER_STAGE_VERTEX_BIT, bindingsOf(desc.setLayouts),
                       desc.specialization};
  requireAllGiven(given, ofVertices);
  given.stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  given.written = desc.colorWrite ? desc.colors.size() : 0;
  requireAllGiven(given, ofFragments);
  StageInterface vertex = stageInterface(desc.vertexShader);
  const std::uint32_t ofFragment =
      ofFragments.pushConstants ? stageInterface(desc.fragmentShader).pushConstantBytes : 0;
  return {std::move(vertex.inputs), std::max(vertex.pushConstantBytes, ofFragment)};
}

/// Bytes of push constants.
std::uint32_t askedBy(const ComputePipelineDesc& desc) {
  requireAllGiven({desc.name, VK_SHADER_STAGE_COMPUTE_BIT, bindingsOf(desc.setLayouts), {}, 0},
                  stageResources(desc.shader));
  return stageInterface(desc.shader).pushConstantBytes;
}

/// Of either kind of pipeline.
template <class Desc>
Handle<VkPipelineLayout> createLayout(Context& context, const Desc& desc, std::uint32_t pushConstantBytes,
                                      VkShaderStageFlags stages) {
  std::vector<VkDescriptorSetLayout> sets;
  for (const DescriptorLayout& set : desc.setLayouts) sets.push_back(set);
  const VkPushConstantRange constants{.stageFlags = stages, .size = pushConstantBytes};
  const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                        .setLayoutCount = count(sets),
                                        .pSetLayouts = sets.data(),
                                        .pushConstantRangeCount = pushConstantBytes > 0 ? 1u : 0u,
                                        .pPushConstantRanges = &constants};
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(vkCreatePipelineLayout(context.device(), &info, nullptr, &layout),
        fmt::format("create the layout of pipeline \"{}\"", desc.name));
  return {context, layout};
}

void requireConsistent(const Context& context, const GraphicsPipelineDesc& desc) {
  const Features& features = context.features();
  LUXO_REQUIRE(!desc.vertexShader.empty());
  LUXO_REQUIRE(desc.polygonMode == VK_POLYGON_MODE_FILL || features.fillModeNonSolid);
  const bool alike = std::ranges::all_of(
      desc.colors, [&](const ColorAttachment& color) { return color.blend == desc.colors.front().blend; });
  LUXO_REQUIRE(alike || features.independentBlend);
  LUXO_REQUIRE(!blendsBy(desc, Blend::Or) || (alike && features.logicOp));
  LUXO_REQUIRE(!blendsBy(desc, Blend::Through) || features.dualSrcBlend);
}

/// The shaders of a pipeline, and the constants that all of them are given.
class Stages {
 public:
  Stages(const Context& context, const GraphicsPipelineDesc& desc)
      : vertex_(context.device(), desc.vertexShader, desc.name) {
    for (std::uint32_t i = 0; i < desc.specialization.size(); ++i)
      entries_.push_back({.constantID = desc.specialization[i].id,
                          .offset = static_cast<std::uint32_t>(i * sizeof(SpecializationConstant) +
                                                               offsetof(SpecializationConstant, bits)),
                          .size = sizeof(SpecializationConstant::bits)});
    constants_ = {.mapEntryCount = count(entries_),
                  .pMapEntries = entries_.data(),
                  .dataSize = desc.specialization.size() * sizeof(SpecializationConstant),
                  .pData = desc.specialization.data()};
    add(VK_SHADER_STAGE_VERTEX_BIT, vertex_);
    if (desc.fragmentShader.empty()) return;
    fragment_.emplace(context.device(), desc.fragmentShader, desc.name);
    add(VK_SHADER_STAGE_FRAGMENT_BIT, *fragment_);
  }
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  [[nodiscard]] const std::vector<VkPipelineShaderStageCreateInfo>& infos() const { return infos_; }

 private:
  void add(VkShaderStageFlagBits bit, VkShaderModule module) {
    infos_.push_back({.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                      .stage = bit,
                      .module = module,
                      .pName = "main",
                      .pSpecializationInfo = &constants_});
  }

  ShaderModule vertex_;
  std::optional<ShaderModule> fragment_;
  std::vector<VkSpecializationMapEntry> entries_;
  VkSpecializationInfo constants_{};
  std::vector<VkPipelineShaderStageCreateInfo> infos_;
};

VkPipeline createPipeline(const Context& context, const GraphicsPipelineDesc& desc, const Asked& asked,
                          VkPipelineLayout layout) {
  const Stages stages(context, desc);
  const VertexInput vertices(desc, asked.inputs);
  const VkPipelineVertexInputStateCreateInfo input{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
      .vertexBindingDescriptionCount = count(vertices.bindings),
      .pVertexBindingDescriptions = vertices.bindings.data(),
      .vertexAttributeDescriptionCount = count(vertices.attributes),
      .pVertexAttributeDescriptions = vertices.attributes.data()};
  const VkPipelineInputAssemblyStateCreateInfo assembly{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, .topology = desc.topology};
  const VkPipelineViewportStateCreateInfo viewport{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
  const VkPipelineRasterizationStateCreateInfo raster{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
      .depthClampEnable = desc.depthClamp && context.features().depthClamp,
      .polygonMode = desc.polygonMode,
      .lineWidth = 1};
  const VkPipelineMultisampleStateCreateInfo multisample{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
      .rasterizationSamples = desc.samples};
  const bool depth = desc.depthFormat != VK_FORMAT_UNDEFINED;
  const VkPipelineDepthStencilStateCreateInfo depthState{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
      .depthTestEnable = depth,
      .depthWriteEnable = depth && desc.depthWrite,
      .depthCompareOp = desc.depthCompare};
  const auto attachments = blendStates(desc);
  const VkPipelineColorBlendStateCreateInfo blend{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
      .logicOpEnable = blendsBy(desc, Blend::Or),
      .logicOp = VK_LOGIC_OP_OR,
      .attachmentCount = count(attachments),
      .pAttachments = attachments.data()};
  std::vector states{VK_DYNAMIC_STATE_VIEWPORT,   VK_DYNAMIC_STATE_SCISSOR,
                     VK_DYNAMIC_STATE_CULL_MODE,  VK_DYNAMIC_STATE_FRONT_FACE,
                     VK_DYNAMIC_STATE_DEPTH_BIAS, VK_DYNAMIC_STATE_DEPTH_BIAS_ENABLE};
  if (blendsBy(desc, Blend::Mean)) states.push_back(VK_DYNAMIC_STATE_BLEND_CONSTANTS);
  const VkPipelineDynamicStateCreateInfo dynamic{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
      .dynamicStateCount = count(states),
      .pDynamicStates = states.data()};
  std::vector<VkFormat> formats;
  for (const ColorAttachment& color : desc.colors) formats.push_back(color.format);
  const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                .colorAttachmentCount = count(formats),
                                                .pColorAttachmentFormats = formats.data(),
                                                .depthAttachmentFormat = desc.depthFormat};
  const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                          .pNext = &rendering,
                                          .stageCount = count(stages.infos()),
                                          .pStages = stages.infos().data(),
                                          .pVertexInputState = &input,
                                          .pInputAssemblyState = &assembly,
                                          .pViewportState = &viewport,
                                          .pRasterizationState = &raster,
                                          .pMultisampleState = &multisample,
                                          .pDepthStencilState = &depthState,
                                          .pColorBlendState = &blend,
                                          .pDynamicState = &dynamic,
                                          .layout = layout};
  const std::string what = fmt::format("create the pipeline \"{}\"", desc.name);
  requireRoomForShaders(what);
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(context.device(), context.pipelineCache(), 1, &info, nullptr, &pipeline),
        what);
  return pipeline;
}

}  // namespace

bool blendsBy(const GraphicsPipelineDesc& desc, Blend blend) {
  return std::ranges::find(desc.colors, blend, &ColorAttachment::blend) != desc.colors.end();
}

GraphicsPipeline::GraphicsPipeline(Context& context, const GraphicsPipelineDesc& desc)
    : GraphicsPipeline(std::move(makeAll(context, {&desc, 1}).front())) {}

std::vector<GraphicsPipeline> GraphicsPipeline::makeAll(Context& context,
                                                        std::span<const GraphicsPipelineDesc> descs) {
  std::vector<GraphicsPipeline> pipelines(descs.size());
  std::vector<Asked> asked(descs.size());
  tbb::parallel_for(std::size_t{0}, descs.size(), [&](std::size_t i) {
    requireConsistent(context, descs[i]);
    asked[i] = askedBy(descs[i]);
  });
  for (std::size_t i = 0; i < descs.size(); ++i) {
    pipelines[i].pushConstantBytes_ = asked[i].pushConstantBytes;
    pipelines[i].layout_ = createLayout(context, descs[i], asked[i].pushConstantBytes, kStages);
  }
  // What is counted, and named, is for one thread.
  std::vector<VkPipeline> created(descs.size(), VK_NULL_HANDLE);
  const auto keep = [&] {
    for (std::size_t i = 0; i < descs.size(); ++i)
      if (created[i] != VK_NULL_HANDLE) pipelines[i].pipeline_ = {context, created[i]};
  };
  const Stopwatch watch;
  try {
    tbb::parallel_for(std::size_t{0}, descs.size(), [&](std::size_t i) {
      created[i] = createPipeline(context, descs[i], asked[i], pipelines[i].layout_);
    });
  } catch (...) {
    keep();
    throw;
  }
  keep();
  for (std::size_t i = 0; i < descs.size(); ++i) setName(context, created[i], descs[i].name);
  context.counted().pipelinesCreated += descs.size();
  context.counted().pipelineMs += watch.milliseconds();
  return pipelines;
}

void GraphicsPipeline::bind(VkCommandBuffer commands) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  setDepthBias(commands, {});
}

void GraphicsPipeline::push(VkCommandBuffer commands, std::span<const std::byte> constants) const {
  LUXO_REQUIRE_COMPARE(constants.size(), ==, pushConstantBytes_);
  vkCmdPushConstants(commands, layout_, kStages, 0, pushConstantBytes_, constants.data());
}

void GraphicsPipeline::bindSet(VkCommandBuffer commands, std::uint32_t index, VkDescriptorSet set,
                               std::span<const std::uint32_t> dynamicOffsets) const {
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, index, 1, &set,
                          count(dynamicOffsets), dynamicOffsets.data());
}

ComputePipeline::ComputePipeline(Context& context, const ComputePipelineDesc& desc)
    : pushConstantBytes_(askedBy(desc)),
      layout_(createLayout(context, desc, pushConstantBytes_, VK_SHADER_STAGE_COMPUTE_BIT)) {
  const ShaderModule shader(context.device(), desc.shader, desc.name);
  const VkComputePipelineCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
      .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                .module = shader,
                .pName = "main"},
      .layout = layout_};
  const std::string what = fmt::format("create the pipeline \"{}\"", desc.name);
  requireRoomForShaders(what);
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(context.device(), context.pipelineCache(), 1, &info, nullptr, &pipeline),
        what);
  pipeline_ = {context, pipeline};
  setName(context, pipeline, desc.name);
  context.counted().pipelinesCreated += 1;
}

void ComputePipeline::bind(VkCommandBuffer commands) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
}

void ComputePipeline::push(VkCommandBuffer commands, std::span<const std::byte> constants) const {
  LUXO_REQUIRE_COMPARE(constants.size(), ==, pushConstantBytes_);
  vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, pushConstantBytes_, constants.data());
}

void ComputePipeline::bindSet(VkCommandBuffer commands, std::uint32_t index, VkDescriptorSet set) const {
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, index, 1, &set, 0, nullptr);
}

void setDepthBias(VkCommandBuffer commands, DepthBias bias) {
  vkCmdSetDepthBiasEnable(commands, bias.constant != 0 || bias.slope != 0);
  vkCmdSetDepthBias(commands, bias.constant, 0, bias.slope);
}

void setViewport(VkCommandBuffer commands, VkExtent2D extent, float guard) {
  setViewport(commands, VkRect2D{.extent = extent}, guard);
}

void setViewport(VkCommandBuffer commands, const VkRect2D& part, float guard) {
  const auto width = static_cast<float>(part.extent.width);
  const auto height = static_cast<float>(part.extent.height);
  const VkViewport viewport{.x = static_cast<float>(part.offset.x) + 0.5f * (1 - guard) * width,
                            .y = static_cast<float>(part.offset.y) + 0.5f * (1 + guard) * height,
                            .width = guard * width,
                            .height = -guard * height,
                            .maxDepth = 1};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &part);
}

}  // namespace luxo::gpu
