// SPDX-License-Identifier: Apache-2.0
// Meshes that a material's vertex program moves (shaders/MATERIALS.md): once a moment, for all that looks at
// it. Drawing, shadows, rays and models know the moved mesh alone; its vertices tell where they were at rest,
// for the program's varyings in the pixel.
#pragma once

#include <list>
#include <mutex>
#include <string>
#include <vector>

#include "math/vec.h"
#include "scene/material.h"
#include "surface/surface.h"

namespace luxo {

/// What a vertex program has of each vertex. Object space, metres.
struct VerticesAtRest {
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> uvs;  ///< 0 of meshes without
};

/// Error(Scene) at the first word gl_Position of the shader's vertex program.
[[noreturn]] void refuseMovement(const MaterialShader& shader, const std::string& why,
                                 const std::string& advice);

/// A mesh as it is moved is a function of it and of the material, whatever was asked before. Safe from any
/// thread, one at a time.
class VertexMovement {
 public:
  VertexMovement() = default;
  virtual ~VertexMovement();
  VertexMovement(const VertexMovement&) = delete;
  VertexMovement& operator=(const VertexMovement&) = delete;

  /// The surface itself where all vertices stay. Asked for the same again soon it is the same surface, not
  /// only an equal one. Triangles without an area are left out; a closed mesh that is turned inside out keeps
  /// its outside. Normals turn as the mean of the triangles around the vertex does; what has a normal by
  /// itself at rest, as at a crease, keeps one by itself. Requires triangles, and a material that
  /// movesVertices(). Error(Scene), at its place: what is wrong with the shader, places that are no numbers
  /// or too far away, a movement that is not one for all views. Cost: run(), and triangleMesh().
  [[nodiscard]] Surface moved(const Surface& surface, const Material& material);

 private:
  struct Held {
    Surface surface;
    Material material;
    Surface moved;
  };

  /// What the program makes of each vertex with matrices that are the identity: gl_Position. Nothing: all
  /// stay, to float's rounding. This one throws Error(Scene): it takes a device
  /// (draw/device_vertex_movement.h).
  [[nodiscard]] virtual std::vector<Vec4f> run(const VerticesAtRest& vertices, const Material& material);

  std::mutex mutex_;
  std::list<Held> held_;  ///< the last asked for first
};

}  // namespace luxo
