// SPDX-License-Identifier: Apache-2.0
// A triangle mesh: what model files and programs give beside formulas. Immutable and shared: copies are cheap
// and are one mesh; reading is safe from any thread.
//
//     const TriangleMesh quad = triangleMesh({.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
//                                             .indices = {0, 1, 2, 0, 2, 3}});
//
// Its triangles are the truth: who draws, bounds or casts rays takes positions() as they are.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/bounds.h"
#include "math/vec.h"

namespace luxo {

/// Where normals come from.
enum class NormalRule {
  Given,   ///< the file's; where a vertex has none, as Smooth
  Smooth,  ///< of the triangles that meet there, weighed by their angles, up to creases
  Flat,    ///< of each triangle
};

/// The most triangles of a cluster.
inline constexpr std::uint32_t kClusterTriangles = 128;
/// Metres; as kMaxSceneNumber.
inline constexpr double kMaxCoordinate = 1e18;
/// The most corners, and vertices, of a mesh: two of their numbers, and a bit, fit 64 bits.
inline constexpr std::uint64_t kMaxCorners = 1ull << 31;

/// What a mesh is made of. Front faces are counter-clockwise; where most given normals point out of the other
/// side, all triangles are turned. Vertices that nothing uses do no harm.
struct MeshArrays {
  std::vector<Vec3> positions = {};         ///< metres, finite, up to kMaxCoordinate
  std::vector<Vec3f> normals = {};          ///< none, or one a position, of any length; (0, 0, 0): not given
  std::vector<Vec2f> uvs = {};              ///< none, or one a position; finite
  std::vector<std::uint32_t> indices = {};  ///< three a triangle
  std::vector<std::uint32_t> materials = {};  ///< none (all are 0), or one a triangle
  /// None, or one a triangle, of smooth normals: edges between equal numbers are smooth whatever their
  /// crease, others sharp; triangles of number 0 are flat.
  std::vector<std::uint32_t> smoothing = {};
  /// None, or one a position with a normal for each: where the vertex was, and its normal, before a program
  /// moved it (scene/vertex_movement.h). Then `normals` are all given.
  std::vector<Vec3f> rest = {}, restNormals = {};
};

struct MeshOptions {
  NormalRule normals = NormalRule::Given;
  /// Of smooth normals: radians between two triangles from which their edge is sharp.
  double crease = radians(45);
  bool tangents = false;  ///< for normal maps; needs uvs
};

/// Up to kClusterTriangles neighbouring triangles, all of one material.
struct MeshCluster {
  std::uint32_t firstTriangle = 0, triangles = 0;
  /// Every index of the cluster is in [firstVertex, firstVertex + kWindowVertices). Neighbouring clusters
  /// mostly share it: so one window of indices (mesh/index_windows.h) holds many.
  std::uint32_t firstVertex = 0;
  std::uint32_t material = 0;
  Box bounds;  ///< holds the cluster
  Sphere sphere;
  /// Unit; every triangle's normal is within the angle of it whose sine is `spread`; 1: no use, they spread
  /// over a half-space or more.
  Vec3 axis{0};
  double spread = 1;
  double thinnest = 0;  ///< no triangle of it has a smaller height; metres

  /// At least how far an eye is behind the planes of all its triangles, so that none shows its front if that
  /// is above 0, and before them. Metres, of an eye at (xyz, 1); or the sine, times the length of xyz, of
  /// parallel rays toward (xyz, 0). Rounded down.
  [[nodiscard]] double behind(const Vec4& eye) const;
  [[nodiscard]] double before(const Vec4& eye) const;
};

/// Consecutive triangles and clusters of one material; one a material, in the order of their numbers.
struct MeshGroup {
  std::uint32_t material = 0;
  std::uint32_t firstTriangle = 0, triangles = 0;
  std::uint32_t firstCluster = 0, clusters = 0;
};

/// What is known of the edges, where edges between the same two points are one, whatever the normals and uvs
/// of their vertices.
struct MeshEdges {
  std::uint64_t border = 0;       ///< of one triangle alone
  std::uint64_t turned = 0;       ///< of two triangles that go along it the same way: one is inside out
  std::uint64_t nonManifold = 0;  ///< of three triangles or more
  std::uint64_t unbalanced = 0;   ///< along which not as many triangles go one way as the other

  /// Whether the triangles bound a solid (or several): every edge is balanced.
  [[nodiscard]] bool closed() const { return unbalanced == 0; }
};

class TriangleMesh {
 public:
  /// No mesh: valid() is false, and nothing else may be asked.
  TriangleMesh() = default;

  [[nodiscard]] bool valid() const { return data_ != nullptr; }
  [[nodiscard]] const std::string& name() const;

  /// Vertices. Object space, metres, relative to origin(): finite, never -0. What was one point has the same
  /// bits. Each float is the nearest to what was given: off by at most 2^-24 of the bounds' largest side, or
  /// of the coordinate, whichever is the larger.
  [[nodiscard]] std::span<const Vec3f> positions() const;
  /// Zero, or the middle of a mesh that is farther from the origin than it is large.
  [[nodiscard]] const Vec3& origin() const;
  /// origin() + positions()[vertex], in double: where the vertex is.
  [[nodiscard]] Vec3 point(std::uint32_t vertex) const { return origin() + Vec3(positions()[vertex]); }
  [[nodiscard]] std::span<const Vec3f> normals() const;  ///< one a vertex, unit to 2e-7
  [[nodiscard]] std::span<const Vec2f> uvs() const;      ///< one a vertex, or none; finite
  /// One a vertex, or none: MeshArrays::rest, object space, metres; and unit to 2e-7.
  [[nodiscard]] std::span<const Vec3f> rest() const;
  [[nodiscard]] std::span<const Vec3f> restNormals() const;
  /// One a vertex, or none. x, y, z: unit to 2e-7, perpendicular to the normal to 1e-6; w: 1 or -1, the
  /// bitangent, w * cross(normal, tangent), points to the top of an image, where v is 0
  /// (mesh/vertex_tangents.h).
  [[nodiscard]] std::span<const Vec4f> tangents() const;

  /// Three a triangle, each below positions().size(), in the order of clusters. No triangle has an area of
  /// zero: the cross product of its edges, in double, is not zero. Every vertex is used.
  [[nodiscard]] std::span<const std::uint32_t> indices() const;
  [[nodiscard]] std::uint32_t triangleCount() const { return std::uint32_t(indices().size() / 3); }
  [[nodiscard]] std::span<const MeshCluster> clusters() const;  ///< they hold every triangle once, in order
  [[nodiscard]] std::span<const MeshGroup> groups() const;      ///< so do they

  [[nodiscard]] const Box& bounds() const;  ///< of the points, to the bit
  [[nodiscard]] const MeshEdges& edges() const;
  [[nodiscard]] bool closed() const { return edges().closed(); }
  /// Triangles given that have no area, and were left out. A surface without them has the same points.
  [[nodiscard]] std::uint64_t dropped() const;

  /// Whether both are the same mesh, not only alike.
  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
  /// Of the mesh, for maps; the same for all copies.
  [[nodiscard]] const void* identity() const { return data_.get(); }

 private:
  struct Data;
  friend TriangleMesh triangleMesh(MeshArrays arrays, std::string_view name, const MeshOptions& options);
  explicit TriangleMesh(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  std::shared_ptr<const Data> data_;
};

/// Whether a mesh of these has a triangle with an area: one without is refused. Required: indices below
/// positions.size(). Cost: the positions, and the triangles up to the first that has one.
[[nodiscard]] bool hasArea(const MeshArrays& arrays);

/// Makes a mesh. Equal arrays give equal meshes. Error(Scene), naming the mesh, the vertex or triangle and
/// the value: numbers that are not finite or too large, indices beyond the end, arrays whose lengths do not
/// agree, no triangle with an area, tangents without uvs. In parallel; the mesh does not depend on the number
/// of threads. Cost, of a closed million: about 0.45 s on one core, 75 bytes a triangle meanwhile, and 25 of
/// what stays, 12 more with uvs and tangents; with flat normals 120 meanwhile, and 85 of what stays, since
/// three vertices a triangle are its own.
[[nodiscard]] TriangleMesh triangleMesh(MeshArrays arrays, std::string_view name = "mesh",
                                        const MeshOptions& options = {});

}  // namespace luxo
