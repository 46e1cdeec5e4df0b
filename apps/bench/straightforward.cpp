// SPDX-License-Identifier: Apache-2.0
#include "straightforward.h"

#include <cstddef>
#include <span>

#include "luxo/shaders/straightforward_frag.h"
#include "luxo/shaders/straightforward_vert.h"
#include "shared/bindings.h"

namespace luxo::bench {
namespace {

/// object_data.glsl, scalar layout.
struct ObjectData {
  Mat4f MVP, M, Minv;
  Vec3f wEye;
  std::array<Vec4f, 2> wLiPos;
  std::array<Vec3f, 2> Le;
  Vec3f La;
  Vec3f ka, kd, ks;
  float shine;
  Vec3f wShadeAxis;
  float cosRim, focalLength;
  std::uint32_t isShade;
};
static_assert(sizeof(ObjectData) == 4 * (3 * 16 + 3 + 8 + 6 + 3 + 9 + 1 + 3 + 2 + 1));

ObjectData objectData(const LampState& state, const Object& object, const Pose& pose) {
  const Material& material = object.material;
  return {.MVP = state.P * state.V * pose.M,
          .M = pose.M,
          .Minv = pose.Minv,
          .wEye = state.wEye,
          .wLiPos = {Vec4f(8, 14, 6, 1), Vec4f(state.wFocus, 1)},
          .Le = {Vec3f(70), 110.0f * Vec3f(1, 0.9f, 0.7f)},
          .La = Vec3f(0.05f),
          .ka = material.ka,
          .kd = material.kd,
          .ks = material.ks,
          .shine = material.shine,
          .wShadeAxis = state.wShadeAxis,
          .cosRim = (kShadeHeight - kShadeFocalLength) / (kShadeHeight + kShadeFocalLength),
          .focalLength = kShadeFocalLength,
          .isShade = object.isShade};
}

}  // namespace

Straightforward::Straightforward(gpu::Context& context, PixelSize size, VkFormat colorFormat)
    : aspect_(float(size.width) / float(size.height)),
      layout_(context, {{.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC}}) {
  for (Object& object : lampObjects()) {
    const auto bytes = std::as_bytes(std::span(object.geometry.vtxData));
    gpu::Buffer vertices(
        context, {.size = bytes.size(), .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, .name = "strips"});
    vertices.write(0, bytes);
    objects_.push_back({std::move(object), std::move(vertices)});
  }

  const VkDeviceSize alignment = context.limits().minUniformBufferOffsetAlignment;
  uniformStride_ = (sizeof(ObjectData) + alignment - 1) / alignment * alignment;
  for (gpu::Buffer& buffer : uniforms_)
    buffer = gpu::Buffer(context, {.size = uniformStride_ * kObjects,
                                   .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                   .memory = gpu::MemoryUse::Upload,
                                   .name = "object uniforms"});

  const VkExtent2D extent{static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height)};
  targets_ = PlainTargets(context, extent, colorFormat, "straightforward");
  constexpr VkFormat kFloat2 = VK_FORMAT_R32G32_SFLOAT, kFloat3 = VK_FORMAT_R32G32B32_SFLOAT;
  pipeline_ = gpu::GraphicsPipeline(
      context, {.name = "straightforward",
                .vertexShader = luxo_straightforward_vert,
                .fragmentShader = luxo_straightforward_frag,
                .bindings = {{0, sizeof(VertexData), VK_VERTEX_INPUT_RATE_VERTEX}},
                .attributes = {{shared::kAttributePosition, 0, kFloat3, offsetof(VertexData, pos)},
                               {shared::kAttributeNormal, 0, kFloat3, offsetof(VertexData, norm)},
                               {shared::kAttributeParameters, 0, kFloat2, offsetof(VertexData, tex)}},
                .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
                .colors = {{colorFormat}},
                .depthFormat = PlainTargets::kDepth,
                .depthCompare = VK_COMPARE_OP_LESS,
                .setLayouts = {layout_}});
}

void Straightforward::record(gpu::FrameRing& frames, VkCommandBuffer commands, float time) {
  const LampState state = lampAt(time, aspect_);
  gpu::Buffer& uniforms = uniforms_[frames.slot()];
  const VkDescriptorSet set = frames.descriptors().write(layout_, {{uniforms, 0, sizeof(ObjectData)}});

  targets_.begin(commands, 1);
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const DrawnObject& drawn = objects_[i];
    const ObjectData data = objectData(state, drawn.object, state.poses[i]);
    const auto offset = static_cast<std::uint32_t>(i * uniformStride_);
    uniforms.write(offset, std::as_bytes(std::span(&data, 1)));
    pipeline_.bind(commands);
    pipeline_.bindSet(commands, 0, set, {&offset, 1});
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    constexpr VkDeviceSize kStart = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, drawn.vertices.pointer(), &kStart);
    draw(commands, drawn.object.geometry);
  }
  vkCmdEndRendering(commands);
}

void Straightforward::draw(VkCommandBuffer commands, const ParamSurface& geometry) const {
  for (std::uint32_t i = 0; i < geometry.nStrips; ++i)
    vkCmdDraw(commands, geometry.nVtxStrip, 1, i * geometry.nVtxStrip, 0);
}

std::uint32_t Straightforward::triangles() const {
  std::uint32_t count = 0;
  for (const DrawnObject& drawn : objects_)
    count += drawn.object.geometry.nStrips * (drawn.object.geometry.nVtxStrip - 2);
  return count;
}

std::uint32_t Straightforward::drawCalls() const {
  std::uint32_t count = 0;
  for (const DrawnObject& drawn : objects_) count += drawn.object.geometry.nStrips;
  return count;
}

}  // namespace luxo::bench
