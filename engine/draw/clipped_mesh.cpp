// SPDX-License-Identifier: Apache-2.0
#include "draw/clipped_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "draw/pixel_rows.h"

namespace luxo {
namespace {

/// Pixels: the ends of an edge so long are rounded by 2^-24 of it, four times (the object's matrix, its
/// place, the camera's matrix, the division): by 2^-8 of a pixel, the raster's own step.
constexpr double kLongestEdgePx = 0x1p14;

/// Of the near plane: what is nearer may be clipped. The device clips at the plane itself.
constexpr double kNearer = 0.5;

struct Vertex {
  Vec3 position, normal;
  Vec2 parameters;
  Vec4 tangent;
  Vec3 rest, restNormal;
};

double at(const Vec4& plane, const Vertex& vertex) { return glm::dot(plane, Vec4(vertex.position, 1)); }

/// The same bits whichever end is given first.
Vertex crossing(const Vec4& plane, const Vertex* a, const Vertex* b) {
  const auto place = [](const Vertex& v) { return std::tie(v.position.x, v.position.y, v.position.z); };
  if (place(*b) < place(*a)) std::swap(a, b);
  const double ofA = at(plane, *a), part = ofA / (ofA - at(plane, *b));
  return {glm::mix(a->position, b->position, part),
          glm::mix(a->normal, b->normal, part),
          glm::mix(a->parameters, b->parameters, part),
          glm::mix(a->tangent, b->tangent, part),
          glm::mix(a->rest, b->rest, part),
          glm::mix(a->restNormal, b->restNormal, part)};
}

/// The part of a convex polygon on a plane's positive side.
void clip(std::vector<Vertex>& polygon, const Vec4& plane) {
  std::vector<Vertex> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const bool keepsA = at(plane, a) >= 0, keepsB = at(plane, b) >= 0;
    if (keepsA) part.push_back(a);
    if (keepsA != keepsB) part.push_back(crossing(plane, &a, &b));
  }
  polygon = std::move(part);
}

/// Planes in object space, positive where the picture is: as far beside it as it is large, and nearer than
/// the near plane.
std::vector<Vec4> planesAround(const View& view, const Transform& worldFromObject) {
  const PixelRows rows = pixelRows(view, worldFromObject);
  const Vec4 width = view.perspective() ? rows.depth : Vec4(0, 0, 0, 1);
  const double reach = 1.5 * std::max(view.size.width, view.size.height);
  std::vector<Vec4> planes{reach * width + rows.x, reach * width - rows.x, reach * width + rows.y,
                           reach * width - rows.y};
  if (view.perspective()) planes.push_back(rows.depth - Vec4(0, 0, 0, kNearer * view.near));
  return planes;
}

double longestEdge(const Mesh& mesh) {
  double longest2 = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const Vec3 edge = mesh.positions[mesh.indices[next]] - mesh.positions[mesh.indices[i]];
    longest2 = std::max(longest2, glm::dot(edge, edge));
  }
  return std::sqrt(longest2);
}

}  // namespace

std::shared_ptr<const Mesh> clippedMesh(const View& view, const SnapshotNode& node,
                                        const VisibleNode& visible, const std::shared_ptr<const Mesh>& mesh) {
  const double pixels =
      visible.stretch * visible.pixelsPerUnit / (view.perspective() ? visible.nearestDepth : 1);
  // An edge is no longer than its mesh is large.
  if (glm::length(node.boundsObject.extent()) * pixels <= kLongestEdgePx) return mesh;
  if (!(longestEdge(*mesh) * pixels > kLongestEdgePx)) return mesh;
  const std::vector<Vec4> planes = planesAround(view, node.worldFromObject);
  Mesh part{.bound = mesh->bound, .dropped = mesh->dropped};
  Vec3 sum(0);
  std::vector<Vertex> polygon;
  for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
    polygon.clear();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh->indices[i + k];
      polygon.push_back({mesh->positions[v], mesh->normals[v], mesh->parameters[v],
                         mesh->tangents.empty() ? Vec4(0) : mesh->tangents[v],
                         mesh->rest.empty() ? Vec3(0) : Vec3(mesh->rest[v]),
                         mesh->rest.empty() ? Vec3(0) : Vec3(mesh->restNormals[v])});
    }
    for (const Vec4& plane : planes) clip(polygon, plane);
    const auto first = static_cast<std::uint32_t>(part.positions.size());
    for (const Vertex& vertex : polygon) {
      part.positions.push_back(vertex.position);
      part.normals.push_back(vertex.normal);
      part.parameters.push_back(vertex.parameters);
      if (!mesh->tangents.empty()) part.tangents.push_back(vertex.tangent);
      if (!mesh->rest.empty()) {
        part.rest.emplace_back(vertex.rest);
        part.restNormals.emplace_back(vertex.restNormal);
      }
      sum += vertex.position;
    }
    for (std::uint32_t k = 2; k < polygon.size(); ++k)
      part.indices.insert(part.indices.end(), {first, first + k - 1, first + k});
  }
  if (!part.positions.empty()) part.origin = sum / static_cast<double>(part.positions.size());
  return std::make_shared<const Mesh>(std::move(part));
}

}  // namespace luxo
