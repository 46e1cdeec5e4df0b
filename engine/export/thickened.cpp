// SPDX-License-Identifier: Apache-2.0
#include "export/thickened.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace luxo {
namespace {

constexpr double kFarthest = 2;  ///< how far edges reach, in thicknesses

using Bits = std::array<double, 3>;

/// Equal positions, to the bit, are one point.
std::vector<std::uint32_t> pointsOf(const Mesh& sheet, std::uint32_t& count) {
  std::map<Bits, std::uint32_t> numbers;
  std::vector<std::uint32_t> points;
  points.reserve(sheet.positions.size());
  for (const Vec3& p : sheet.positions)
    points.push_back(
        numbers.try_emplace(Bits{p.x, p.y, p.z}, static_cast<std::uint32_t>(numbers.size())).first->second);
  count = static_cast<std::uint32_t>(numbers.size());
  return points;
}

/// From each vertex to the face that its normal points to, for a thickness of 2.
std::vector<Vec3> waysOut(const Mesh& sheet, const std::vector<std::uint32_t>& points, std::uint32_t count,
                          bool oneSided) {
  std::vector<std::vector<Vec3>> normals(count);  // different ones, of a one-sided sheet all to one side
  const auto alike = [&](const Vec3& n, std::uint32_t point) {
    return oneSided && !normals[point].empty() && glm::dot(n, normals[point][0]) < 0 ? -n : n;
  };
  for (std::size_t v = 0; v < points.size(); ++v) {
    std::vector<Vec3>& here = normals[points[v]];
    const Vec3 n = alike(sheet.normals[v], points[v]);
    if (std::ranges::find(here, n) == here.end()) here.push_back(n);
  }
  std::vector<Vec3> middles(count);
  for (std::uint32_t p = 0; p < count; ++p) {
    if (normals[p].size() == 1) {
      middles[p] = normals[p][0];
      continue;
    }
    Vec3 sum(0);
    for (const Vec3& n : normals[p]) sum += n;
    const Vec3 middle = sum == Vec3(0) ? normals[p][0] : unit(sum);
    double least = 1;
    for (const Vec3& n : normals[p]) least = std::min(least, glm::dot(n, middle));
    middles[p] = middle / std::max(least, 1 / kFarthest);
  }
  std::vector<Vec3> ways;
  ways.reserve(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vec3& middle = middles[points[v]];
    ways.push_back(oneSided && glm::dot(sheet.normals[v], middle) < 0 ? -middle : middle);
  }
  return ways;
}

/// The sides of triangles along which there is no other triangle, from one vertex to the next.
std::vector<std::array<std::uint32_t, 2>> bordersOf(const Mesh& sheet,
                                                    const std::vector<std::uint32_t>& points) {
  struct Use {
    std::array<std::uint32_t, 2> vertices;
    std::uint32_t count = 0;
  };
  std::map<std::array<std::uint32_t, 2>, Use> edges;
  for (std::size_t i = 0; i < sheet.indices.size(); ++i) {
    const std::uint32_t a = sheet.indices[i], b = sheet.indices[i % 3 == 2 ? i - 2 : i + 1];
    if (points[a] == points[b]) continue;
    Use& use = edges[{std::min(points[a], points[b]), std::max(points[a], points[b])}];
    if (use.count++ == 0) use.vertices = {a, b};
  }
  std::vector<std::array<std::uint32_t, 2>> borders;
  for (const auto& [edge, use] : edges)
    if (use.count == 1) borders.push_back(use.vertices);
  return borders;
}

}  // namespace

Plate thickened(const Mesh& sheet, double thickness, bool oneSided) {
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> points = pointsOf(sheet, count);
  const std::vector<Vec3> ways = waysOut(sheet, points, count, oneSided);
  Plate plate;
  MeshArrays& arrays = plate.arrays;
  const auto vertices = static_cast<std::uint32_t>(sheet.positions.size());
  for (const double side : {0.5, -0.5})
    for (std::uint32_t v = 0; v < vertices; ++v) {
      arrays.positions.push_back(sheet.positions[v] + side * thickness * ways[v]);
      arrays.normals.emplace_back(side * sheet.normals[v]);
    }
  const auto point = [&](std::uint32_t v) { return arrays.positions[v]; };
  for (std::size_t i = 0; i < sheet.indices.size(); i += 3) {
    const std::uint32_t a = sheet.indices[i], b = sheet.indices[i + 1], c = sheet.indices[i + 2];
    arrays.indices.insert(arrays.indices.end(), {a, b, c, vertices + a, vertices + c, vertices + b});
    const auto area = [](const Vec3& p, const Vec3& q, const Vec3& r) { return glm::cross(q - p, r - p); };
    const Vec3 whole = area(sheet.positions[a], sheet.positions[b], sheet.positions[c]);
    for (const std::uint32_t face : {0U, vertices})
      plate.folded += glm::dot(area(point(face + a), point(face + b), point(face + c)), whole) < 0;
  }
  for (const auto& [a, b] : bordersOf(sheet, points)) {
    const auto first = static_cast<std::uint32_t>(arrays.positions.size());
    for (const std::uint32_t v : {a, b, vertices + a, vertices + b}) {
      const Vec3 position = arrays.positions[v];
      arrays.positions.push_back(position);
      arrays.normals.emplace_back(0);
    }
    const std::uint32_t outerA = first, outerB = first + 1, innerA = first + 2, innerB = first + 3;
    arrays.indices.insert(arrays.indices.end(), {outerB, outerA, innerA, outerB, innerA, innerB});
  }
  return plate;
}

}  // namespace luxo
