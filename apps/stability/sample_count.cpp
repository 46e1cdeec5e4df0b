// SPDX-License-Identifier: Apache-2.0
#include "stability/sample_count.h"

#include <cstring>
#include <filesystem>
#include <string_view>

#include "base/assert.h"
#include "base/error.h"
#include "gpu/barrier.h"
#include "gpu/frame.h"
#include "gpu/shader_compiler.h"
#include "gpu/texture.h"
#include "luxo/shaders/sources.h"
#include "shared/bindings.h"

namespace luxo {
namespace {

constexpr std::string_view kVertex = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bindings.h"
layout(location = kAttributePosition) in vec3 position;
layout(push_constant) uniform Push { mat4 clipFromObject; uint first; uint side; };
invariant gl_Position;
void main() { gl_Position = clipFromObject * vec4(position, 1.0); }
)";

constexpr std::string_view kFragment = R"(#version 460
#extension GL_EXT_scalar_block_layout : require
layout(scalar, set = 0, binding = 0) buffer Counts { uint counts[]; };
layout(push_constant) uniform Push { mat4 clipFromObject; uint first; uint side; };
layout(location = 0) out vec4 seen;
void main() {
  seen = vec4(1.0);
  uint pixel = first + uint(gl_FragCoord.y) * side + uint(gl_FragCoord.x);
  atomicAdd(counts[2 * pixel + (gl_FrontFacing ? 0 : 1)], 1);
}
)";

// Of the picture that is drawn beside the counts: pipelines have one.
constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;

struct Push {
  Mat4f clipFromObject;
  std::uint32_t first = 0, side = 0;
};

gpu::Buffer filled(gpu::Context& context, VkBufferUsageFlags usage, std::span<const std::byte> bytes) {
  gpu::Buffer buffer(context, {.size = bytes.size(), .usage = usage, .name = "counted mesh"});
  buffer.write(0, bytes);
  return buffer;
}

}  // namespace

SampleCounter::SampleCounter(gpu::Context& context, int side)
    : context_(&context), side_(side), layout_(context, {{}}) {
  const gpu::ShaderCompiler compiler((std::filesystem::path()));
  const auto vertex = compiler.compile(
      {.source = {"count.vert", kVertex}, .stage = gpu::ShaderStage::Vertex, .includes = kShaderSources});
  const auto fragment = compiler.compile({.source = {"count.frag", kFragment}});
  pipeline_ = gpu::GraphicsPipeline(
      context, {.name = "count samples",
                .vertexShader = vertex.spirv,
                .fragmentShader = fragment.spirv,
                .bindings = {{.binding = 0, .stride = sizeof(Vec3f)}},
                .attributes = {{.location = shared::kAttributePosition,
                                .binding = 0,
                                .format = VK_FORMAT_R32G32B32_SFLOAT}},
                // Where a triangle replaces all of a 64-pixel tile, lavapipe drops those binned before, and
                // their counts with them; where it blends it does not.
                .colors = {{kFormat, gpu::Blend::Color}},
                .setLayouts = {layout_}});
}

void SampleCounter::setMesh(std::span<const Vec3> positions, std::span<const std::uint32_t> indices) {
  const std::vector<Vec3f> single(positions.begin(), positions.end());
  positions_ = filled(*context_, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, std::as_bytes(std::span(single)));
  indices_ = filled(*context_, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, std::as_bytes(indices));
  indexCount_ = static_cast<std::uint32_t>(indices.size());
}

std::vector<SampleCount> SampleCounter::count(std::span<const Mat4> clipFromObject) {
  const std::size_t pixels = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  gpu::Buffer counts(*context_, {.size = clipFromObject.size() * pixels * sizeof(SampleCount),
                                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                 .memory = gpu::MemoryUse::Readback,
                                 .name = "sample counts"});
  const VkExtent2D extent{static_cast<std::uint32_t>(side_), static_cast<std::uint32_t>(side_)};
  gpu::Texture picture(*context_, {.extent = extent,
                                   .format = kFormat,
                                   .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                   .name = "counted picture"});
  gpu::FrameRing frames(*context_);
  const VkCommandBuffer commands = frames.begin();
  gpu::use(commands, {{counts, gpu::Use::TransferDestination}});
  vkCmdFillBuffer(commands, counts, 0, VK_WHOLE_SIZE, 0);
  gpu::use(commands, {{counts, gpu::Use::StorageWrite},
                      {picture, gpu::Use::ColorAttachment, gpu::Contents::Discard},
                      {positions_, gpu::Use::VertexBuffer},
                      {indices_, gpu::Use::IndexBuffer}});
  const VkRenderingAttachmentInfo attachment{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                             .imageView = picture.view(),
                                             .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE};
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {.extent = extent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &attachment};
  vkCmdBeginRendering(commands, &rendering);
  gpu::setViewport(commands, extent);
  pipeline_.bind(commands);
  pipeline_.bindSet(commands, 0, frames.descriptors().write(layout_, {counts}));
  vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, positions_.pointer(), &offset);
  vkCmdBindIndexBuffer(commands, indices_, 0, VK_INDEX_TYPE_UINT32);
  for (std::size_t i = 0; i < clipFromObject.size(); ++i) {
    const Push push{Mat4f(clipFromObject[i]), static_cast<std::uint32_t>(i * pixels), extent.width};
    pipeline_.push(commands, std::as_bytes(std::span(&push, 1)));
    vkCmdDrawIndexed(commands, indexCount_, 1, 0, 0, 0);
  }
  vkCmdEndRendering(commands);
  gpu::use(commands, {{counts, gpu::Use::HostRead}});
  frames.wait(frames.submit());

  std::vector<SampleCount> result(clipFromObject.size() * pixels);
  std::memcpy(result.data(), counts.read().data(), result.size() * sizeof(SampleCount));
  return result;
}

}  // namespace luxo
