// SPDX-License-Identifier: Apache-2.0
#include "draw/mesh_store.h"

#include <span>
#include <string_view>
#include <vector>

namespace luxo {
namespace {

template <class T>
gpu::Buffer upload(gpu::Context& context, const std::vector<T>& data, VkBufferUsageFlags usage,
                   std::string_view name) {
  const auto bytes = std::as_bytes(std::span(data));
  gpu::Buffer buffer(context, {.size = bytes.size(), .usage = usage, .name = name});
  buffer.write(0, bytes);
  return buffer;
}

std::vector<Vec3f> interleaved(const Mesh& mesh) {
  std::vector<Vec3f> vertices;
  vertices.reserve(2 * mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    vertices.emplace_back(mesh.positions[i] - mesh.origin);
    vertices.emplace_back(mesh.normals[i]);
  }
  return vertices;
}

}  // namespace

const DeviceMesh& MeshStore::get(const std::shared_ptr<const Mesh>& mesh, bool withParameters) {
  Entry& entry = entries_[mesh.get()];
  DeviceMesh& device = entry.device;
  // An expired entry of the same address belongs to a mesh that is gone.
  if (entry.mesh.lock() != mesh) {
    entry = {.mesh = mesh, .device = {}};
    device.vertices =
        upload(*context_, interleaved(*mesh), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "mesh vertices");
    device.indexCount = static_cast<std::uint32_t>(mesh->indices.size());
    if (mesh->positions.size() <= 0xffff) {
      const std::vector<std::uint16_t> narrow(mesh->indices.begin(), mesh->indices.end());
      device.indices = upload(*context_, narrow, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, "mesh indices");
    } else {
      device.indices = upload(*context_, mesh->indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, "mesh indices");
      device.indexType = VK_INDEX_TYPE_UINT32;
    }
  }
  if (withParameters && !device.parameters) {
    const std::vector<Vec2f> parameters(mesh->parameters.begin(), mesh->parameters.end());
    device.parameters = upload(*context_, parameters, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "mesh parameters");
  }
  return device;
}

void MeshStore::dropUnused() {
  std::erase_if(entries_, [](const auto& entry) { return entry.second.mesh.expired(); });
}

}  // namespace luxo
