// SPDX-License-Identifier: Apache-2.0
// Meshes on the device: uploaded when first drawn, dropped when nobody holds the mesh any more.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "mesh/index_windows.h"
#include "shell/shell.h"
#include "tessellate/mesh.h"

namespace luxo {

/// One mesh as the shaders read it: float, object space relative to the mesh's origin.
struct DeviceMesh {
  gpu::Buffer vertices;    ///< position and normal interleaved: 24 bytes a vertex; or ShellVertex
  gpu::Buffer parameters;  ///< (u, v): 8 bytes a vertex; empty until a view of geometry needs it
  /// 16 bytes a vertex, 0 of meshes without; of what has moved where that was (draw/rest_frame.h). Empty
  /// until a map of normals or a shader needs it.
  gpu::Buffer tangents;
  gpu::Buffer indices;
  /// 16 bits each, relative to the first vertex of their window; where there are no windows 32, relative to
  /// 0.
  std::vector<IndexWindow> windows;
  std::uint32_t indexCount = 0;
};

/// One shell as the shaders read it: float, object space relative to the shell's origin.
struct ShellVertex {
  Vec3f position;
  Vec2f parameters;
  Vec3f cell;  ///< extent in u and v; how much derivatives change over it, object units
  std::uint32_t patch = 0;
};

class MeshStore {
 public:
  explicit MeshStore(gpu::Context& context) : context_(&context) {}

  [[nodiscard]] const DeviceMesh& get(const std::shared_ptr<const Mesh>& mesh, bool withParameters,
                                      bool withTangents = false);
  [[nodiscard]] const DeviceMesh& get(const std::shared_ptr<const Shell>& shell);

  /// Drops the meshes that are gone. The device may still be drawing them: destruction is deferred.
  void dropUnused();

 private:
  struct Entry {
    std::weak_ptr<const void> source;
    DeviceMesh device;
  };

  gpu::Context* context_;
  std::map<const void*, Entry> entries_;
};

}  // namespace luxo
