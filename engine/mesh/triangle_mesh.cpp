// SPDX-License-Identifier: Apache-2.0
#include "mesh/triangle_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/assert.h"
#include "base/error.h"
#include "mesh/mesh_clusters.h"
#include "mesh/mesh_topology.h"
#include "mesh/vertex_normals.h"
#include "mesh/vertex_tangents.h"

namespace luxo {

struct TriangleMesh::Data {
  std::string name;
  MeshVertices vertices;
  std::vector<Vec4f> tangents;
  std::vector<std::uint32_t> indices;
  std::vector<MeshCluster> clusters;
  std::vector<MeshGroup> groups;
  Vec3 origin{0};
  Box bounds;
  MeshEdges edges;
  std::uint64_t dropped = 0;
};

// For all normals n within the angle a of the axis and points p within the radius r of the centre c:
// n.(p - e) >= n.(c - e) - r >= |c - e| cos(angle(axis, c - e) + a) - r, and that cosine is at least
// cos(angle) - sin(a) wherever this is positive. Rounding: each term is off by less than 1e-15 of itself.
double MeshCluster::behind(const Vec4& eye) const {
  if (!(spread < 1)) return -1;
  const Vec3 away = eye.w * sphere.center - Vec3(eye);
  return glm::dot(away, axis) - (spread + 4e-15) * glm::length(away) - eye.w * sphere.radius;
}

double MeshCluster::before(const Vec4& eye) const {
  MeshCluster turned = *this;
  turned.axis = -axis;
  return turned.behind(eye);
}

const std::string& TriangleMesh::name() const { return data_->name; }
std::span<const Vec3f> TriangleMesh::positions() const { return data_->vertices.positions; }
const Vec3& TriangleMesh::origin() const { return data_->origin; }
std::span<const Vec3f> TriangleMesh::normals() const { return data_->vertices.normals; }
std::span<const Vec2f> TriangleMesh::uvs() const { return data_->vertices.uvs; }
std::span<const Vec3f> TriangleMesh::rest() const { return data_->vertices.rest; }
std::span<const Vec3f> TriangleMesh::restNormals() const { return data_->vertices.restNormals; }
std::span<const Vec4f> TriangleMesh::tangents() const { return data_->tangents; }
std::span<const std::uint32_t> TriangleMesh::indices() const { return data_->indices; }
std::span<const MeshCluster> TriangleMesh::clusters() const { return data_->clusters; }
std::span<const MeshGroup> TriangleMesh::groups() const { return data_->groups; }
const Box& TriangleMesh::bounds() const { return data_->bounds; }
const MeshEdges& TriangleMesh::edges() const { return data_->edges; }
std::uint64_t TriangleMesh::dropped() const { return data_->dropped; }

namespace {

[[noreturn]] void refuse(std::string_view name, const std::string& why) {
  throw Error(ErrorKind::Scene, fmt::format("mesh '{}': {}", name, why));
}

bool isFinite(const Vec2f& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool isFinite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void validate(const MeshArrays& arrays, std::string_view name, const MeshOptions& options) {
  const std::size_t vertices = arrays.positions.size(), triangles = arrays.indices.size() / 3;
  if (arrays.indices.size() % 3 != 0)
    refuse(name, fmt::format("{} indices are not three a triangle", arrays.indices.size()));
  if (vertices >= kMaxCorners || arrays.indices.size() >= kMaxCorners)
    refuse(name, fmt::format("{} vertices and {} corners of triangles; it may have {} of each", vertices,
                             arrays.indices.size(), kMaxCorners - 1));
  const auto requireLength = [&](std::string_view what, std::size_t length, std::size_t wanted) {
    if (length != 0 && length != wanted) refuse(name, fmt::format("{} {}, not {}", length, what, wanted));
  };
  requireLength("normals", arrays.normals.size(), vertices);
  requireLength("uvs", arrays.uvs.size(), vertices);
  requireLength("points at rest", arrays.rest.size(), vertices);
  if (arrays.restNormals.size() != arrays.rest.size())
    refuse(name, fmt::format("{} normals at rest, not {}", arrays.restNormals.size(), arrays.rest.size()));
  if (!arrays.rest.empty() && arrays.normals.empty()) refuse(name, "vertices that have moved need normals");
  requireLength("materials", arrays.materials.size(), triangles);
  requireLength("smoothing numbers", arrays.smoothing.size(), triangles);
  if (options.tangents && arrays.uvs.empty()) refuse(name, "tangents need uvs");
  for (std::size_t i = 0; i < vertices; ++i) {
    const Vec3& p = arrays.positions[i];
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (!(largest <= kMaxCoordinate) || std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z))
      refuse(name, fmt::format("vertex {} is ({}, {}, {}), which is not within {:g}", i, p.x, p.y, p.z,
                               kMaxCoordinate));
  }
  for (std::size_t i = 0; i < arrays.normals.size(); ++i)
    if (!isFinite(arrays.normals[i])) refuse(name, fmt::format("the normal of vertex {} is not finite", i));
  for (const auto* some : {&arrays.rest, &arrays.restNormals})
    for (std::size_t i = 0; i < some->size(); ++i)
      if (!isFinite((*some)[i])) refuse(name, fmt::format("vertex {} is not finite at rest", i));
  for (std::size_t i = 0; i < arrays.uvs.size(); ++i)
    if (!isFinite(arrays.uvs[i])) refuse(name, fmt::format("the uv of vertex {} is not finite", i));
  for (std::size_t i = 0; i < arrays.indices.size(); ++i)
    if (arrays.indices[i] >= vertices)
      refuse(name, fmt::format("triangle {} has vertex {} of {}", i / 3, arrays.indices[i], vertices));
}

// What floats are relative to, so that they are exact enough far from zero.
Vec3 originOf(const std::vector<Vec3>& positions) {
  Box box;
  for (const Vec3& position : positions) box.add(position);
  if (box.empty()) return Vec3(0);
  const Vec3 center = box.center(), extent = box.extent();
  const double far = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
  return far > std::max({extent.x, extent.y, extent.z}) ? center : Vec3(0);
}

// As a mesh stores it; + 0: no -0.
Vec3f stored(const Vec3& position, const Vec3& origin) { return Vec3f(position - origin) + 0.0f; }

bool hasArea(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  return glm::cross(Vec3(b) - Vec3(a), Vec3(c) - Vec3(a)) != Vec3(0);
}

// Triangles without an area go, and what is said of them; gives how many. The order of the others stays.
std::uint64_t dropTriangles(const std::vector<Vec3f>& positions, MeshArrays& arrays) {
  std::size_t kept = 0;
  const std::size_t triangles = arrays.indices.size() / 3;
  for (std::size_t i = 0; i < triangles; ++i) {
    const auto at = [&](std::size_t corner) { return positions[arrays.indices[3 * i + corner]]; };
    if (!hasArea(at(0), at(1), at(2))) continue;
    std::copy_n(arrays.indices.begin() + std::ptrdiff_t(3 * i), 3,
                arrays.indices.begin() + std::ptrdiff_t(3 * kept));
    if (!arrays.materials.empty()) arrays.materials[kept] = arrays.materials[i];
    if (!arrays.smoothing.empty()) arrays.smoothing[kept] = arrays.smoothing[i];
    ++kept;
  }
  arrays.indices.resize(3 * kept);
  if (!arrays.materials.empty()) arrays.materials.resize(kept);
  if (!arrays.smoothing.empty()) arrays.smoothing.resize(kept);
  return triangles - kept;
}

EdgeList edgesOf(const std::vector<Vec3f>& positions, const std::vector<std::uint32_t>& indices) {
  const std::vector<std::uint32_t> points = pointNumbers(positions);
  std::vector<std::uint32_t> corners(indices.size());
  std::transform(indices.begin(), indices.end(), corners.begin(), [&](std::uint32_t i) { return points[i]; });
  return EdgeList(corners, positions.size());
}

// Sorts the triangles by their material, which keeps the order of equals.
std::vector<MeshGroup> groupByMaterial(std::vector<std::uint32_t>& indices,
                                       const std::vector<std::uint32_t>& materials) {
  const auto triangles = std::uint32_t(indices.size() / 3);
  if (materials.empty()) return {{.triangles = triangles}};
  std::vector<std::uint32_t> order(triangles);
  std::iota(order.begin(), order.end(), 0u);
  if (!std::is_sorted(materials.begin(), materials.end())) {
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return materials[a] < materials[b]; });
    std::vector<std::uint32_t> sorted(indices.size());
    for (std::size_t i = 0; i < sorted.size(); ++i)
      sorted[i] = indices[3 * std::size_t(order[i / 3]) + i % 3];
    indices = std::move(sorted);
  }
  std::vector<MeshGroup> groups;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const std::uint32_t material = materials[order[i]];
    if (groups.empty() || groups.back().material != material)
      groups.push_back({.material = material, .firstTriangle = i});
    ++groups.back().triangles;
  }
  return groups;
}

/// Makes front faces of those that most normals point out of.
void turnFronts(const MeshVertices& vertices, std::vector<std::uint32_t>& indices) {
  double facing = 0;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const Vec3 a(vertices.positions[indices[i]]), b(vertices.positions[indices[i + 1]]),
        c(vertices.positions[indices[i + 2]]);
    const Vec3 across = unit(glm::cross(b - a, c - a));
    for (std::size_t k = i; k < i + 3; ++k)
      facing += glm::dot(across, unit(Vec3(vertices.normals[indices[k]])));
  }
  if (facing >= 0) return;
  for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
}

}  // namespace

bool hasArea(const MeshArrays& arrays) {
  const Vec3 origin = originOf(arrays.positions);
  for (std::size_t i = 0; i + 3 <= arrays.indices.size(); i += 3) {
    const auto at = [&](std::size_t corner) {
      return stored(arrays.positions[arrays.indices[i + corner]], origin);
    };
    if (hasArea(at(0), at(1), at(2))) return true;
  }
  return false;
}

TriangleMesh triangleMesh(MeshArrays arrays, std::string_view name, const MeshOptions& options) {
  validate(arrays, name, options);
  auto data = std::make_shared<TriangleMesh::Data>();
  data->name = name;
  data->origin = originOf(arrays.positions);

  MeshVertices& vertices = data->vertices;
  {
    const std::vector<Vec3> given = std::move(arrays.positions);
    vertices.positions.reserve(given.size());
    for (const Vec3& position : given) vertices.positions.push_back(stored(position, data->origin));
  }
  vertices.normals = std::move(arrays.normals);
  vertices.uvs = std::move(arrays.uvs);
  for (Vec2f& uv : vertices.uvs) uv += 0.0f;
  vertices.rest = std::move(arrays.rest);
  vertices.restNormals = std::move(arrays.restNormals);
  for (auto* some : {&vertices.rest, &vertices.restNormals})
    for (Vec3f& v : *some) v += 0.0f;

  if (!vertices.normals.empty()) turnFronts(vertices, arrays.indices);
  // Slivers that fill the gap beside a vertex on an edge belong to the whole, so edges are counted with them.
  EdgeList edges = edgesOf(vertices.positions, arrays.indices);
  data->edges = edges.count();
  data->dropped = dropTriangles(vertices.positions, arrays);
  if (arrays.indices.empty()) refuse(name, "it has no triangle with an area");
  if (data->dropped > 0) edges = edgesOf(vertices.positions, arrays.indices);
  std::vector<std::uint32_t> normalOf =
      giveNormals(vertices, arrays.indices, std::move(edges), arrays.smoothing, options);
  if (options.tangents) {
    vertices.normals = reordered(vertices.normals, normalOf);
    data->tangents = giveTangents(vertices, arrays.indices);
    normalOf.clear();
  }
  data->groups = groupByMaterial(arrays.indices, arrays.materials);

  std::vector<std::uint32_t> order;
  data->clusters = makeClusters(vertices.positions, arrays.indices, data->groups, order);
  vertices.positions = reordered(vertices.positions, order);
  vertices.uvs = reordered(vertices.uvs, order);
  vertices.rest = reordered(vertices.rest, order);
  vertices.restNormals = reordered(vertices.restNormals, order);
  data->tangents = reordered(data->tangents, order);
  if (!normalOf.empty()) order = reordered(std::exchange(normalOf, {}), order);
  vertices.normals = reordered(vertices.normals, order);
  data->indices = std::move(arrays.indices);
  boundClusters(data->clusters, vertices.positions, data->origin, data->indices);
  for (const MeshCluster& cluster : data->clusters) data->bounds.add(cluster.bounds);
  return TriangleMesh(std::move(data));
}

}  // namespace luxo
