// SPDX-License-Identifier: Apache-2.0
#include "plain_knot.h"

#include <span>
#include <vector>

#include "luxo/shaders/plain_knot_frag.h"
#include "luxo/shaders/plain_knot_vert.h"
#include "shared/bindings.h"

namespace luxo::bench {
namespace {

struct KnotData {
  Mat4f clipFromWorld;
  Vec4f eye, towardLight;
};

template <class T>
gpu::Buffer filled(gpu::Context& context, std::span<const T> data, VkBufferUsageFlags usage,
                   std::string_view name) {
  gpu::Buffer buffer(context, {.size = data.size_bytes(), .usage = usage, .name = name});
  buffer.write(0, std::as_bytes(data));
  return buffer;
}

}  // namespace

PlainKnot::PlainKnot(gpu::Context& context, PixelSize size, const TriangleMesh& mesh)
    : indexCount_(std::uint32_t(mesh.indices().size())) {
  std::vector<Vec3f> vertices;
  for (std::uint32_t i = 0; i < mesh.positions().size(); ++i) {
    vertices.emplace_back(mesh.point(i));
    vertices.push_back(mesh.normals()[i]);
  }
  vertices_ = filled<Vec3f>(context, vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "vertices of a plain mesh");
  indices_ = filled(context, mesh.indices(), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, "indices of a plain mesh");
  const VkExtent2D extent{std::uint32_t(size.width), std::uint32_t(size.height)};
  constexpr VkFormat kColor = VK_FORMAT_R32G32B32A32_SFLOAT, kFloat3 = VK_FORMAT_R32G32B32_SFLOAT;
  targets_ = PlainTargets(context, extent, kColor, "plain mesh");
  pipeline_ =
      gpu::GraphicsPipeline(context, {.name = "plain mesh",
                                      .vertexShader = luxo_plain_knot_vert,
                                      .fragmentShader = luxo_plain_knot_frag,
                                      .bindings = {{0, 2 * sizeof(Vec3f), VK_VERTEX_INPUT_RATE_VERTEX}},
                                      .attributes = {{shared::kAttributePosition, 0, kFloat3, 0},
                                                     {shared::kAttributeNormal, 0, kFloat3, sizeof(Vec3f)}},
                                      .colors = {{kColor}},
                                      .depthFormat = PlainTargets::kDepth});
}

void PlainKnot::record(VkCommandBuffer commands, const View& view) {
  Mat4 eyeFromWorld(view.eyeFromWorld);
  eyeFromWorld[3] = Vec4(view.eyeFromWorld * -view.eye, 1);
  const KnotData data{.clipFromWorld = Mat4f(view.clipFromEye * eyeFromWorld),
                      .eye = Vec4f(Vec3f(view.eye), 1),
                      .towardLight = Vec4f(Vec3f(kKnotLight), 0)};
  targets_.begin(commands, 0);
  pipeline_.bind(commands);
  pipeline_.push(commands, std::as_bytes(std::span(&data, 1)));
  vkCmdSetCullMode(commands, VK_CULL_MODE_BACK_BIT);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  constexpr VkDeviceSize kStart = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, vertices_.pointer(), &kStart);
  vkCmdBindIndexBuffer(commands, indices_, 0, VK_INDEX_TYPE_UINT32);
  vkCmdDrawIndexed(commands, indexCount_, 1, 0, 0, 0);
  vkCmdEndRendering(commands);
}

}  // namespace luxo::bench
