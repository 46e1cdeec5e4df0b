// SPDX-License-Identifier: Apache-2.0
#include "draw/mesh_store.h"

#include <span>
#include <string_view>
#include <vector>

#include "draw/rest_frame.h"

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

std::vector<ShellVertex> verticesOf(const Shell& shell) {
  std::vector<ShellVertex> vertices;
  vertices.reserve(shell.positions.size());
  for (std::size_t i = 0; i < shell.positions.size(); ++i) {
    const Vec2 origin(shell.patchData[shell.patches[i]].originOfU, 0);
    vertices.push_back({.position = Vec3f(shell.positions[i] - shell.origin),
                        .parameters = Vec2f(shell.parameters[i] - origin),
                        .cell = Vec3f(shell.cells[i].x, shell.cells[i].y, shell.changes[i]),
                        .patch = shell.patches[i]});
  }
  return vertices;
}

std::vector<Vec4f> restFrames(const Mesh& mesh) {
  std::vector<Vec4f> frames;
  frames.reserve(mesh.rest.size());
  for (std::size_t i = 0; i < mesh.rest.size(); ++i)
    frames.push_back(restFrame(mesh.rest[i], Vec3(mesh.restNormals[i])));
  return frames;
}

std::vector<std::uint16_t> inWindows(const std::vector<std::uint32_t>& indices,
                                     const std::vector<IndexWindow>& windows) {
  std::vector<std::uint16_t> narrow;
  narrow.reserve(indices.size());
  for (const IndexWindow& window : windows)
    while (narrow.size() < window.end)
      narrow.push_back(static_cast<std::uint16_t>(indices[narrow.size()] - window.firstVertex));
  return narrow;
}

void uploadIndices(gpu::Context& context, DeviceMesh& mesh, const std::vector<std::uint32_t>& indices) {
  mesh.indexCount = static_cast<std::uint32_t>(indices.size());
  mesh.windows = indexWindows(indices);
  constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
  mesh.indices = mesh.windows.empty()
                     ? upload(context, indices, kUsage, "mesh indices")
                     : upload(context, inWindows(indices, mesh.windows), kUsage, "mesh indices");
}

}  // namespace

const DeviceMesh& MeshStore::get(const std::shared_ptr<const Mesh>& mesh, bool withParameters,
                                 bool withTangents) {
  Entry& entry = entries_[mesh.get()];
  DeviceMesh& device = entry.device;
  // An expired entry of the same address belongs to a mesh that is gone.
  if (entry.source.lock() != mesh) {
    entry = {.source = mesh, .device = {}};
    device.vertices =
        upload(*context_, interleaved(*mesh), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "mesh vertices");
    uploadIndices(*context_, device, mesh->indices);
  }
  if (withParameters && !device.parameters) {
    const std::vector<Vec2f> parameters(mesh->parameters.begin(), mesh->parameters.end());
    device.parameters = upload(*context_, parameters, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "mesh parameters");
  }
  if (withTangents && !device.tangents) {
    std::vector<Vec4f> tangents(mesh->tangents.begin(), mesh->tangents.end());
    if (!mesh->rest.empty()) tangents = restFrames(*mesh);
    tangents.resize(mesh->positions.size(), Vec4f(0));
    device.tangents = upload(*context_, tangents, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "mesh tangents");
  }
  return device;
}

const DeviceMesh& MeshStore::get(const std::shared_ptr<const Shell>& shell) {
  Entry& entry = entries_[shell.get()];
  if (entry.source.lock() != shell) {
    entry = {.source = shell, .device = {}};
    entry.device.vertices =
        upload(*context_, verticesOf(*shell), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "shell vertices");
  }
  return entry.device;
}

void MeshStore::dropUnused() {
  std::erase_if(entries_, [](const auto& entry) { return entry.second.source.expired(); });
}

}  // namespace luxo
