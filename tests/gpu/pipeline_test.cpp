// SPDX-License-Identifier: Apache-2.0
// Triangles on a small target, read back as floats.
#include "gpu/pipeline.h"

#include "gpu/barrier.h"
#include "gpu/debug.h"
#include "gpu/frame.h"
#include "gpu/shader_compiler.h"
#include "gpu/transfer.h"
#include "support/gpu_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include "luxo/shaders/test_color_frag.h"
#include "luxo/shaders/test_color_vert.h"
#include "luxo/shaders/test_descriptors_frag.h"
#include "luxo/shaders/test_descriptors_vert.h"

namespace luxo::gpu {
namespace {

using Color = std::array<float, 4>;

struct Vertex {
  std::array<float, 3> positionClip;
  Color color;
};

constexpr Color kRed{1, 0, 0, 1};
constexpr Color kGreen{0, 1, 0, 1};
constexpr Color kBlack{0, 0, 0, 0};
constexpr VkExtent2D kTargetExtent{16, 16};

// Covers the bottom left half of the picture; counter-clockwise with y up.
std::vector<Vertex> lowerLeft(const Color& color, float depth = 0.5f) {
  return {{{-1, -1, depth}, color}, {{1, -1, depth}, color}, {{-1, 1, depth}, color}};
}

std::vector<Vertex> covering(const Color& color, float depth = 0.5f) {
  return {{{-1, -1, depth}, color}, {{3, -1, depth}, color}, {{-1, 3, depth}, color}};
}

GraphicsPipelineDesc colorPipeline() {
  return {.name = "color",
          .vertexShader = luxo_test_color_vert,
          .fragmentShader = luxo_test_color_frag,
          .bindings = {{.stride = sizeof(Vertex)}},
          .attributes = {{.location = 0, .format = VK_FORMAT_R32G32B32_SFLOAT},
                         {.location = 1,
                          .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                          .offset = offsetof(Vertex, color)}},
          .colors = {{VK_FORMAT_R32G32B32A32_SFLOAT}},
          .depthFormat = VK_FORMAT_D32_SFLOAT,
          .specialization = {{0, 0}, {1, 0}}};
}

class PipelineTest : public test::GpuTest {
 protected:
  struct Layer {
    std::vector<Vertex> vertices;
    const GraphicsPipeline* pipeline;
    Color tint{1, 1, 1, 1};
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    DepthBias bias = {};
  };

  Texture attachment(VkFormat format, VkImageUsageFlags usage,
                     VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT) {
    return Texture(context(), {.extent = kTargetExtent,
                               .format = format,
                               .usage = usage,
                               .samples = samples,
                               .name = "attachment"});
  }
  Texture colorTarget(VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT) {
    return attachment(format, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  }
  Texture depthTarget() {
    return attachment(VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  }

  static VkRenderingAttachmentInfo cleared(const Texture& texture, VkImageLayout layout) {
    return {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = texture.view(),
            .imageLayout = layout,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
  }

  void draw(VkCommandBuffer commands, const Layer& layer, std::vector<Buffer>& keep) {
    Buffer& vertices = keep.emplace_back(context(), BufferDesc{.size = layer.vertices.size() * sizeof(Vertex),
                                                               .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT});
    vertices.write(0, std::as_bytes(std::span(layer.vertices)));
    layer.pipeline->bind(commands);
    setDepthBias(commands, layer.bias);
    layer.pipeline->push(commands, std::as_bytes(std::span(layer.tint)));
    setViewport(commands, kTargetExtent);
    vkCmdSetCullMode(commands, layer.cull);
    vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    const VkDeviceSize zero = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, vertices.pointer(), &zero);
    vkCmdDraw(commands, static_cast<std::uint32_t>(layer.vertices.size()), 1, 0, 0);
  }

  // Draws the layers in order over black and depth 0.
  std::vector<Color> picture(const std::vector<Layer>& layers) {
    FrameRing frames(context());
    Texture color = colorTarget();
    Texture depth = depthTarget();
    Readback readback(context(), kTargetExtent, color.format());
    const VkCommandBuffer commands = frames.begin();
    const Label label(context(), commands, "layers");
    use(commands,
        {{color, Use::ColorAttachment, Contents::Discard}, {depth, Use::DepthAttachment, Contents::Discard}});
    const auto colorInfo = cleared(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    const auto depthInfo = cleared(depth, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                    .renderArea = {.extent = kTargetExtent},
                                    .layerCount = 1,
                                    .colorAttachmentCount = 1,
                                    .pColorAttachments = &colorInfo,
                                    .pDepthAttachment = &depthInfo};
    std::vector<Buffer> keep;
    vkCmdBeginRendering(commands, &rendering);
    for (const Layer& layer : layers) draw(commands, layer, keep);
    vkCmdEndRendering(commands);
    readback.record(commands, color);
    frames.wait(frames.submit());
    return pixels<Color>(readback);
  }

  template <class T>
  static std::vector<T> pixels(Readback& readback) {
    std::vector<T> result(readback.bytes().size() / sizeof(T));
    std::memcpy(result.data(), readback.bytes().data(), readback.bytes().size());
    return result;
  }

  static const Color& at(const std::vector<Color>& image, std::uint32_t x, std::uint32_t y) {
    return image[y * kTargetExtent.width + x];
  }
};

using PipelineDeathTest = PipelineTest;

TEST_F(PipelineTest, YPointsUpAndRowsStartAtTheTop) {
  const GraphicsPipeline pipeline(context(), colorPipeline());
  const auto image = picture({{lowerLeft(kRed), &pipeline}});
  // The pixel centre (x, y) lies in the triangle when x + (15 - y) < 15, y counting down from the top; on the
  // diagonal itself the fill rule decides.
  for (std::uint32_t y = 0; y < 16; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      if (x == y) continue;
      EXPECT_EQ(at(image, x, y), x < y ? kRed : kBlack) << x << ", " << y;
    }
  }
}

TEST_F(PipelineTest, CounterClockwiseInThePictureIsTheFront) {
  const GraphicsPipeline pipeline(context(), colorPipeline());
  auto clockwise = lowerLeft(kGreen);
  std::swap(clockwise[1], clockwise[2]);
  const auto drawn = [&](const std::vector<Vertex>& triangle, VkCullModeFlags cull) {
    return at(picture({{.vertices = triangle, .pipeline = &pipeline, .cull = cull}}), 1, 14) != kBlack;
  };
  EXPECT_TRUE(drawn(lowerLeft(kRed), VK_CULL_MODE_BACK_BIT));
  EXPECT_FALSE(drawn(lowerLeft(kRed), VK_CULL_MODE_FRONT_BIT));
  EXPECT_FALSE(drawn(clockwise, VK_CULL_MODE_BACK_BIT));
  EXPECT_TRUE(drawn(clockwise, VK_CULL_MODE_FRONT_BIT));
}

TEST_F(PipelineTest, NearerIsGreaterWhateverTheOrder) {
  const GraphicsPipeline pipeline(context(), colorPipeline());
  const Layer near{covering(kRed, 0.6f), &pipeline};
  const Layer far{covering(kGreen, 0.4f), &pipeline};
  EXPECT_EQ(at(picture({near, far}), 8, 8), kRed);
  EXPECT_EQ(at(picture({far, near}), 8, 8), kRed);
}

TEST_F(PipelineTest, DepthIsData) {
  GraphicsPipelineDesc desc = colorPipeline();
  desc.depthCompare = VK_COMPARE_OP_ALWAYS;
  const GraphicsPipeline untested(context(), desc);
  desc = colorPipeline();
  desc.depthWrite = false;
  const GraphicsPipeline unwritten(context(), desc);
  desc = colorPipeline();
  desc.depthCompare = VK_COMPARE_OP_EQUAL;
  const GraphicsPipeline equal(context(), desc);
  const GraphicsPipeline usual(context(), colorPipeline());
  EXPECT_EQ(at(picture({{covering(kRed, 0.6f), &usual}, {covering(kGreen, 0.4f), &untested}}), 8, 8), kGreen);
  EXPECT_EQ(at(picture({{covering(kRed, 0.6f), &unwritten}, {covering(kGreen, 0.4f), &usual}}), 8, 8),
            kGreen);
  EXPECT_EQ(at(picture({{covering(kRed, 0.6f), &usual}, {covering(kGreen, 0.6f), &equal}}), 8, 8), kGreen);
  EXPECT_EQ(at(picture({{covering(kRed, 0.6f), &usual}, {covering(kGreen, 0.7f), &equal}}), 8, 8), kRed);
}

// Of a buffer that nobody binds: validation would tell.
TEST_F(PipelineTest, AttributesThatNoShaderReadsAreLeftOut) {
  GraphicsPipelineDesc desc = colorPipeline();
  desc.bindings.push_back({.binding = 1, .stride = 8});
  desc.attributes.push_back({.location = 2, .binding = 1, .format = VK_FORMAT_R32G32_SFLOAT});
  const GraphicsPipeline more(context(), desc);
  EXPECT_EQ(at(picture({{covering(kRed), &more}}), 8, 8), kRed);
}

TEST_F(PipelineTest, DepthBiasPullsCoplanarThingsForward) {
  const GraphicsPipeline pipeline(context(), colorPipeline());
  const Layer red{covering(kRed), &pipeline}, green{covering(kGreen), &pipeline};
  Layer biased = green;
  biased.bias.constant = 16;  // units of the last place of the depth, toward the viewer as depth is reversed
  EXPECT_EQ(at(picture({red, green}), 8, 8), kRed);
  EXPECT_EQ(at(picture({red, biased}), 8, 8), kGreen);
}

TEST_F(PipelineTest, BlendsSourceOverDestination) {
  GraphicsPipelineDesc desc = colorPipeline();
  desc.colors.front().blend = Blend::Alpha;
  desc.depthCompare = VK_COMPARE_OP_ALWAYS;
  const GraphicsPipeline blended(context(), desc);
  const Color half{1, 0, 0, 0.5f};
  // Exact in floats: every term is a sum of few powers of two.
  EXPECT_EQ(at(picture({{covering(kGreen), &blended}, {covering(half), &blended}}), 8, 8),
            (Color{0.5f, 0.5f, 0, 1}));
  EXPECT_EQ(at(picture({{covering(half), &blended}, {covering(kGreen), &blended}}), 8, 8), kGreen);
  EXPECT_EQ(at(picture({{covering(half), &blended}}), 8, 8), (Color{0.5f, 0, 0, 0.5f}))
      << "alpha is coverage";
}

TEST_F(PipelineTest, DrawsDepthAlone) {
  GraphicsPipelineDesc desc = colorPipeline();
  desc.colorWrite = false;
  const GraphicsPipeline hiding(context(), desc), shown(context(), colorPipeline());
  EXPECT_EQ(at(picture({{covering(kRed), &hiding}}), 8, 8), kBlack);
  const auto image = picture({{lowerLeft(kRed), &hiding}, {covering(kGreen, 0.25f), &shown}});
  EXPECT_EQ(at(image, 2, 12), kBlack) << "it is behind";
  EXPECT_EQ(at(image, 12, 2), kGreen);
}

TEST_F(PipelineTest, PushesAndSpecializesConstants) {
  GraphicsPipelineDesc desc = colorPipeline();
  desc.specialization[0].bits = std::bit_cast<std::uint32_t>(0.25f);
  const GraphicsPipeline pipeline(context(), desc);
  const auto image =
      picture({{.vertices = covering({1, 2, 3, 4}), .pipeline = &pipeline, .tint = {2, 0.5f, -1, 0}}});
  EXPECT_EQ(at(image, 3, 12), (Color{2.25f, 1.25f, -2.75f, 0.25f}));
}

TEST_F(PipelineTest, DrawsWireframes) {
  if (!context().features().fillModeNonSolid) GTEST_SKIP() << "no wireframes on this device";
  GraphicsPipelineDesc desc = colorPipeline();
  desc.polygonMode = VK_POLYGON_MODE_LINE;
  const GraphicsPipeline lines(context(), desc);
  const std::vector<Vertex> triangle{
      {{-0.9f, -0.9f, 0.5f}, kRed}, {{0.9f, -0.9f, 0.5f}, kRed}, {{0, 0.9f, 0.5f}, kRed}};
  const auto image = picture({{triangle, &lines}});
  EXPECT_EQ(at(image, 8, 10), kBlack) << "the inside is empty";
  EXPECT_GT(std::ranges::count(image, kRed), 30) << "three sides of about 14 pixels each";
}

TEST_F(PipelineTest, CountsPipelines) {
  const GraphicsPipeline first(context(), colorPipeline());
  const GraphicsPipeline second(context(), colorPipeline());
  EXPECT_EQ(context().counters().pipelinesCreated, 2u);
}

TEST_F(PipelineTest, ResolvesSamplesToTheirMean) {
  ASSERT_EQ(context().supportedSamples(4), VK_SAMPLE_COUNT_4_BIT);
  GraphicsPipelineDesc desc = colorPipeline();
  desc.samples = VK_SAMPLE_COUNT_4_BIT;
  desc.depthFormat = VK_FORMAT_UNDEFINED;
  const GraphicsPipeline pipeline(context(), desc);
  FrameRing frames(context());
  Texture samples =
      attachment(VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_SAMPLE_COUNT_4_BIT);
  Texture color = colorTarget();
  Readback readback(context(), kTargetExtent, color.format());
  const VkCommandBuffer commands = frames.begin();
  use(commands,
      {{samples, Use::ColorAttachment, Contents::Discard}, {color, Use::ResolveTarget, Contents::Discard}});
  auto info = cleared(samples, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  info.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  info.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
  info.resolveImageView = color.view();
  info.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {.extent = kTargetExtent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &info};
  std::vector<Buffer> keep;
  vkCmdBeginRendering(commands, &rendering);
  draw(commands, {lowerLeft(kRed), &pipeline}, keep);
  vkCmdEndRendering(commands);
  readback.record(commands, color);
  frames.wait(frames.submit());
  const auto image = pixels<Color>(readback);
  // The four standard sample places lie two on each side of the diagonal, none on it.
  for (std::uint32_t i = 0; i < 16; ++i) EXPECT_EQ(at(image, i, i), (Color{0.5f, 0, 0, 0.5f})) << i;
  EXPECT_EQ(at(image, 2, 12), kRed);
  EXPECT_EQ(at(image, 12, 2), kBlack);
}

TEST_F(PipelineTest, BlendsEachAttachmentByItself) {
  if (!context().features().independentBlend) GTEST_SKIP() << "no independent blending on this device";
  GraphicsPipelineDesc desc = colorPipeline();
  desc.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, Blend::Alpha}, {VK_FORMAT_R32_UINT}};
  desc.depthFormat = VK_FORMAT_UNDEFINED;
  desc.specialization[1].bits = 4'000'000'001u;
  const GraphicsPipeline pipeline(context(), desc);
  FrameRing frames(context());
  Texture color = colorTarget();
  Texture numbers = colorTarget(VK_FORMAT_R32_UINT);
  Readback colors(context(), kTargetExtent, color.format());
  Readback ids(context(), kTargetExtent, numbers.format());
  const VkCommandBuffer commands = frames.begin();
  use(commands,
      {{color, Use::ColorAttachment, Contents::Discard}, {numbers, Use::ColorAttachment, Contents::Discard}});
  const std::array infos{cleared(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL),
                         cleared(numbers, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL)};
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {.extent = kTargetExtent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = infos.size(),
                                  .pColorAttachments = infos.data()};
  std::vector<Buffer> keep;
  vkCmdBeginRendering(commands, &rendering);
  draw(commands, {covering({1, 0, 0, 0.25f}), &pipeline}, keep);
  vkCmdEndRendering(commands);
  colors.record(commands, color);
  ids.record(commands, numbers);
  frames.wait(frames.submit());
  EXPECT_EQ(pixels<Color>(colors)[100], (Color{0.25f, 0, 0, 0.25f}));
  EXPECT_EQ(pixels<std::uint32_t>(ids)[100], 4'000'000'001u);
}

// Every kind of descriptor at once, a dynamic offset, a texture made by an earlier pass, a buffer that
// shaders write.
TEST_F(PipelineTest, ShadersSeeTheirDescriptors) {
  constexpr auto kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  const DescriptorLayout layout(context(), {{.type = kStorage},
                                            {.type = kStorage},
                                            {.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC},
                                            {.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
                                            {.type = kStorage}});
  const GraphicsPipeline pipeline(context(), {.name = "descriptors",
                                              .vertexShader = luxo_test_descriptors_vert,
                                              .fragmentShader = luxo_test_descriptors_frag,
                                              .colors = {{VK_FORMAT_R32G32B32A32_SFLOAT}},
                                              .setLayouts = {layout}});
  const auto bufferOf = [&](const std::vector<float>& values, VkBufferUsageFlags usage, MemoryUse memory) {
    Buffer buffer(context(), {.size = values.size() * sizeof(float), .usage = usage, .memory = memory});
    buffer.write(0, std::as_bytes(std::span(values)));
    return buffer;
  };
  constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  const Buffer first = bufferOf({1, 2, 3, 4, 5, 6}, kUsage, MemoryUse::Device);
  const Buffer second = bufferOf({10, 20, 30}, kUsage, MemoryUse::Upload);
  Buffer count = bufferOf({0}, kUsage, MemoryUse::Readback);
  const auto step = static_cast<std::uint32_t>(context().limits().minUniformBufferOffsetAlignment);
  std::vector<float> uniforms(2 * step / sizeof(float) + 1, -1.0f);
  uniforms[2 * step / sizeof(float)] = 7.5f;
  const Buffer third = bufferOf(uniforms, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryUse::Upload);
  Texture fourth =
      attachment(VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  const Handle<VkSampler> sampler = createSampler(context(), VK_FILTER_NEAREST);

  FrameRing frames(context());
  Texture color = colorTarget();
  Readback readback(context(), kTargetExtent, color.format());
  const VkCommandBuffer commands = frames.begin();
  use(commands, {{fourth, Use::TransferDestination, Contents::Discard}});
  const VkClearColorValue value{.float32 = {0, 0.125f, 0, 0}};
  const VkImageSubresourceRange all{
      .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1};
  vkCmdClearColorImage(commands, fourth, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &all);
  use(commands, {{color, Use::ColorAttachment, Contents::Discard},
                 {fourth, Use::SampledFragment},
                 {count, Use::StorageWrite}});
  const auto info = cleared(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {.extent = kTargetExtent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &info};
  vkCmdBeginRendering(commands, &rendering);
  pipeline.bind(commands);
  setViewport(commands, kTargetExtent);
  vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  const VkDescriptorSet set = frames.descriptors().write(
      layout, {first, second, {third, 0, sizeof(float)}, {fourth, sampler}, count});
  const std::array offsets{2 * step};
  pipeline.bindSet(commands, 0, set, offsets);
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRendering(commands);
  use(commands, {{count, Use::HostRead}});
  readback.record(commands, color);
  frames.wait(frames.submit());

  for (const Color& pixel : pixels<Color>(readback)) ASSERT_EQ(pixel, (Color{6, 30, 7.5f, 0.125f}));
  std::uint32_t pixelsDrawn = 0;
  std::memcpy(&pixelsDrawn, count.read().data(), sizeof(pixelsDrawn));
  EXPECT_EQ(pixelsDrawn, kTargetExtent.width * kTargetExtent.height);
}

// What dies is another process, as drivers have threads.
TEST_F(PipelineDeathTest, IsGivenAllThatItsShadersRead) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  GraphicsPipelineDesc desc = colorPipeline();
  desc.specialization.pop_back();
  EXPECT_DEATH(GraphicsPipeline(context(), desc), "constant 1 in the fragment shader of \"color\": nothing");
  desc = {.name = "descriptors",
          .vertexShader = luxo_test_descriptors_vert,
          .fragmentShader = luxo_test_descriptors_frag,
          .colors = {{VK_FORMAT_R32G32B32A32_SFLOAT}}};
  EXPECT_DEATH(GraphicsPipeline(context(), desc),
               "set 0, binding . in the fragment shader of \"descriptors\": nothing");
  const std::vector<std::uint32_t> compute =
      ShaderCompiler("")
          .compile({.source = {"a.comp",
                               "#version 460\nlayout(set = 0, binding = 0) buffer Count { uint count; };\n"
                               "void main() { count = 1; }\n"},
                    .stage = ShaderStage::Compute})
          .spirv;
  const DescriptorLayout layout(context(), {{.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}});
  EXPECT_DEATH(ComputePipeline(context(), {.name = "count", .shader = compute, .setLayouts = {layout}}),
               "set 0, binding 0 in the compute shader of \"count\": storage buffer of other stages");
}

TEST_F(PipelineTest, DescriptorSetsAreWithoutLimit) {
  const DescriptorLayout layout(context(), {{.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}});
  const Buffer buffer(context(), {.size = 16, .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
  FrameRing frames(context());
  std::uint64_t objects = 0;
  for (int frame = 0; frame < 6; ++frame) {
    frames.begin();
    for (int i = 0; i < 200; ++i) ASSERT_NE(frames.descriptors().write(layout, {buffer}), VkDescriptorSet{});
    frames.submit();
    if (frame == 1) objects = context().counters().objects;
  }
  EXPECT_EQ(context().counters().objects, objects) << "both slots have their pools and keep them";
}

}  // namespace
}  // namespace luxo::gpu
