// SPDX-License-Identifier: Apache-2.0
#include "scene/vertex_movement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "mesh/triangle_mesh.h"
#include "mesh/welding.h"
#include "scene/shader_text.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

/// Meshes in memory: those of a picture and of the moment a camera is fitted to, and some for going back; of
/// so many triangles together, some 100 MB, but always some.
constexpr std::size_t kHeldMeshes = 64, kAlwaysHeld = 4, kHeldTriangles = std::size_t{1} << 20;

constexpr double kCancelled = 1e-9;  // sums of unit normals this small have no direction

/// Below it two unit vectors are the same but for float's rounding of one of them: 2^-24 of three numbers.
constexpr double kSameDirection = 1e-6;
/// A normal so far across the mean one, by its cosine, says nothing of the triangles.
constexpr double kAslant = 1e-3;

/// Some triangles of a mesh with vertices of their own.
struct Part {
  std::vector<std::uint32_t> vertices;  ///< of the mesh
  std::vector<std::uint32_t> indices;   ///< three a triangle, into `vertices`
};

Part partOf(const SurfaceTriangles& triangles) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  Part part;
  std::vector<std::uint32_t> numberOf(triangles.mesh.positions().size(), kUnused);
  part.indices.reserve(std::size_t{3} * triangles.count);
  for (std::uint32_t i = 0; i < triangles.count; ++i)
    for (const std::uint32_t vertex : triangles.corners(i)) {
      if (numberOf[vertex] == kUnused) {
        numberOf[vertex] = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(vertex);
      }
      part.indices.push_back(numberOf[vertex]);
    }
  return part;
}

VerticesAtRest atRest(const TriangleMesh& mesh, const Part& part) {
  VerticesAtRest vertices;
  for (const std::uint32_t vertex : part.vertices) {
    vertices.positions.emplace_back(mesh.point(vertex));
    vertices.normals.push_back(mesh.normals()[vertex]);
    vertices.uvs.push_back(mesh.uvs().empty() ? Vec2f(0) : mesh.uvs()[vertex]);
  }
  return vertices;
}

std::string numbers(const Vec4f& v) { return fmt::format("({:g}, {:g}, {:g}, {:g})", v.x, v.y, v.z, v.w); }

/// Where gl_Position is, in the object.
Vec3 placeOf(const Vec4f& position, const Vec3f& rest, const TriangleMesh& mesh,
             const MaterialShader& shader) {
  const auto refuse = [&](std::string_view what, const std::string& advice) {
    refuseMovement(shader,
                   fmt::format("of the vertex ({:g}, {:g}, {:g}) of mesh '{}' gl_Position is the model view "
                               "projection matrix times {}, {}",
                               rest.x, rest.y, rest.z, mesh.name(), numbers(position), what),
                   advice);
  };
  for (int i = 0; i < 4; ++i)
    if (!std::isfinite(position[i]))
      refuse("which is no number",
             "see that it divides by nothing that is 0, and stays within what floats have");
  if (!(position.w > 0)) refuse("which is at infinity, or behind it", "give a w above 0: vec4(place, 1.0)");
  const Vec3 place = Vec3(position) / double(position.w);
  if (!(std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)}) <= kMaxCoordinate))
    refuse(fmt::format("which is farther than {:g} m away", kMaxCoordinate), "move it less far");
  return place;
}

/// Of the triangles around each of the vertices, weighed by their angles there; those that are one point with
/// one normal at rest, whatever their uvs, are one.
class MeanNormals {
 public:
  MeanNormals(const VerticesAtRest& rest, std::span<const std::uint32_t> indices) : indices_(indices) {
    WeldingTable table([&](std::uint32_t i) { return mixed(mixed(0, rest.positions[i]), rest.normals[i]); },
                       [&](std::uint32_t i, std::uint32_t j) {
                         return rest.positions[i] == rest.positions[j] && rest.normals[i] == rest.normals[j];
                       });
    for (std::uint32_t i = 0; i < rest.positions.size(); ++i) firstOf_.push_back(table.firstEqual(i));
  }

  /// One a vertex: unit, or 0 where they have no direction.
  template <class At>
  [[nodiscard]] std::vector<Vec3> of(const At& at) const {
    std::vector<Vec3> sums(firstOf_.size(), Vec3(0));
    for (std::size_t i = 0; i < indices_.size(); i += 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t here = indices_[i + k];
        const Vec3 a = at(indices_[i + (k + 1) % 3]) - at(here), b = at(indices_[i + (k + 2) % 3]) - at(here);
        const Vec3 across = glm::cross(a, b);
        sums[firstOf_[here]] += std::atan2(glm::length(across), glm::dot(a, b)) * unit(across);
      }
    std::vector<Vec3> means;
    for (const std::uint32_t first : firstOf_)
      means.push_back(glm::length(sums[first]) > kCancelled ? unit(sums[first]) : Vec3(0));
    return means;
  }

 private:
  std::span<const std::uint32_t> indices_;
  std::vector<std::uint32_t> firstOf_;  ///< of those that are one
};

/// Of each vertex the others of its first triangle.
std::vector<std::array<std::uint32_t, 2>> verticesBeside(std::span<const std::uint32_t> indices,
                                                         std::size_t vertices) {
  std::vector<std::array<std::uint32_t, 2>> beside(vertices);
  for (std::size_t i = indices.size(); i-- > 0;) {
    const std::size_t first = i - i % 3;
    beside[indices[i]] = {indices[first + (i - first + 1) % 3], indices[first + (i - first + 2) % 3]};
  }
  return beside;
}

/// What is around a vertex: the mean normal there, and two edges of a triangle, across it.
struct Surrounding {
  Vec3 mean, first, second;

  Surrounding(const Vec3& normal, const Vec3& edge, const Vec3& other)
      : mean(normal),
        first(edge - normal * glm::dot(normal, edge)),
        second(other - normal * glm::dot(normal, other)) {}
  [[nodiscard]] double area() const { return glm::length(glm::cross(first, second)); }
};

/// A normal as it leans from the mean: so it leans along the edges, as far as these became no longer. Of what
/// turns, is mirrored, or grows all ways alike, exactly as that does.
Vec3 turned(const Vec3& normal, const Surrounding& rest, const Surrounding& now) {
  const double along = glm::dot(normal, rest.mean);
  const double grown = std::sqrt(now.area() / rest.area());
  if (glm::length(normal - rest.mean) < kSameDirection || !(std::abs(along) > kAslant) ||
      !std::isfinite(grown) || !(grown > 0))
    return now.mean == Vec3(0) ? normal : now.mean;
  const Vec3 leans = normal / along - rest.mean;
  const Vec3 ofFirst = glm::cross(now.second, now.mean), ofSecond = glm::cross(now.mean, now.first);
  const Vec3 leansNow = grown *
                        (glm::dot(leans, rest.first) * ofFirst + glm::dot(leans, rest.second) * ofSecond) /
                        glm::dot(now.first, ofFirst);
  return std::copysign(1.0, along) * unit(now.mean + leansNow);
}

/// Six times what the triangles bound.
template <class At>
double volume(std::span<const std::uint32_t> indices, const At& at) {
  const Vec3 from = at(indices.front());
  double sum = 0;
  for (std::size_t i = 0; i < indices.size(); i += 3)
    sum += glm::dot(at(indices[i]) - from, glm::cross(at(indices[i + 1]) - from, at(indices[i + 2]) - from));
  return sum;
}

TriangleMesh movedMesh(const SurfaceTriangles& triangles, Part part, VerticesAtRest rest,
                       std::span<const Vec4f> positions, const Surface& surface, const Material& material) {
  const TriangleMesh& mesh = triangles.mesh;
  MeshArrays arrays{.indices = std::move(part.indices)};
  // By as much as the program moves what it was given, which floats had rounded.
  for (std::size_t i = 0; i < positions.size(); ++i)
    arrays.positions.push_back(
        mesh.point(part.vertices[i]) +
        (placeOf(positions[i], rest.positions[i], mesh, *material.shader) - Vec3(rest.positions[i])));
  const auto before = [&](std::uint32_t vertex) { return mesh.point(part.vertices[vertex]); };
  const auto now = [&](std::uint32_t vertex) { return arrays.positions[vertex]; };
  const MeanNormals means(rest, arrays.indices);
  const std::vector<Vec3> meansBefore = means.of(before);
  const std::vector<std::array<std::uint32_t, 2>> beside = verticesBeside(arrays.indices, positions.size());
  if (surface.closed() && volume(arrays.indices, before) * volume(arrays.indices, now) < 0)
    for (std::size_t i = 0; i < arrays.indices.size(); i += 3)
      std::swap(arrays.indices[i + 1], arrays.indices[i + 2]);
  const std::vector<Vec3> meansNow = means.of(now);
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const auto around = [&](const Vec3& mean, const auto& at) {
      return Surrounding(mean, at(beside[i][0]) - at(i), at(beside[i][1]) - at(i));
    };
    arrays.normals.emplace_back(
        turned(Vec3(rest.normals[i]), around(meansBefore[i], before), around(meansNow[i], now)));
  }
  if (!hasArea(arrays))
    refuseMovement(
        *material.shader,
        fmt::format("of mesh '{}' no triangle has an area once its vertices are moved", mesh.name()),
        "move them less alike, or hide the node");
  if (!mesh.uvs().empty()) arrays.uvs = std::move(rest.uvs);
  arrays.rest = std::move(rest.positions);
  arrays.restNormals = std::move(rest.normals);
  return triangleMesh(std::move(arrays), mesh.name(), {.tangents = !mesh.tangents().empty()});
}

}  // namespace

void refuseMovement(const MaterialShader& shader, const std::string& why, const std::string& advice) {
  for (const MaterialShader::File& file : std::span(shader.files).subspan(shader.vertex))
    if (const auto place = placeOf("gl_Position", file.text))
      throw Error(ErrorKind::Scene, describe(file.name, file.text, {*place, why, advice}));
  throw Error(ErrorKind::Scene, fmt::format("{}: {}", shader.files[shader.vertex].name, why), advice);
}

VertexMovement::~VertexMovement() = default;

std::vector<Vec4f> VertexMovement::run(const VerticesAtRest&, const Material& material) {
  refuseMovement(*material.shader, "vertex programs move meshes on a device, and the scene was given none",
                 "scene.set(std::make_shared<DeviceVertexMovement>()), or render it with "
                 "Renderer::render(scene)");
}

Surface VertexMovement::moved(const Surface& surface, const Material& material) {
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find_if(held_, [&](const Held& held) {
    return held.surface.identity() == surface.identity() && held.material == material;
  });
  if (known != held_.end()) {
    held_.splice(held_.begin(), held_, known);
    return held_.front().moved;
  }
  const SurfaceTriangles& triangles = *surface.triangles();
  Part part = partOf(triangles);
  VerticesAtRest rest = atRest(triangles.mesh, part);
  const std::vector<Vec4f> positions = run(rest, material);
  Surface moved = surface;
  if (!positions.empty())
    moved = Surface(movedMesh(triangles, std::move(part), std::move(rest), positions, surface, material));
  held_.push_front({surface, material, std::move(moved)});
  std::size_t count = 0, sum = 0;
  for (auto i = held_.begin(); i != held_.end(); ++count) {
    sum += i->moved.triangles()->count;
    const bool stays = count < kAlwaysHeld || (count < kHeldMeshes && sum <= kHeldTriangles);
    i = stays ? std::next(i) : held_.erase(i);
  }
  return held_.front().moved;
}

}  // namespace luxo
