// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "tessellate/tessellator.h"

namespace luxo::test {

TriangleMesh quadMesh() {
  return triangleMesh({.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                       .uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                       .indices = {0, 1, 2, 0, 2, 3}},
                      "quad");
}

TriangleMesh cubeMesh() {
  MeshArrays arrays;
  for (int i = 0; i < 8; ++i)
    arrays.positions.emplace_back((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
  arrays.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return triangleMesh(std::move(arrays), "cube", {.normals = NormalRule::Flat});
}

TriangleMesh repeatedCube(std::uint32_t times, bool parameters) {
  const TriangleMesh cube = cubeMesh();
  MeshArrays arrays;
  for (std::uint32_t i = 0; i < times; ++i)
    for (const std::uint32_t corner : cube.indices()) {
      const auto number = static_cast<std::uint32_t>(arrays.positions.size());
      arrays.positions.push_back(cube.point(corner));
      arrays.uvs.emplace_back(parameters ? Vec2f(static_cast<float>(number), static_cast<float>(number % 3))
                                         : Vec2f(0));
      arrays.indices.push_back(number);
    }
  return triangleMesh(std::move(arrays), "repeated cube", {.normals = NormalRule::Flat});
}

TriangleMesh icosphere(int cuts) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  MeshArrays arrays{.positions = {{-1, g, 0},
                                  {1, g, 0},
                                  {-1, -g, 0},
                                  {1, -g, 0},
                                  {0, -1, g},
                                  {0, 1, g},
                                  {0, -1, -g},
                                  {0, 1, -g},
                                  {g, 0, -1},
                                  {g, 0, 1},
                                  {-g, 0, -1},
                                  {-g, 0, 1}},
                    .indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1}};
  for (Vec3& p : arrays.positions) p = unit(p);
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, isNew] = middles.try_emplace(std::minmax(a, b), arrays.positions.size());
      if (isNew) arrays.positions.push_back(unit(arrays.positions[a] + arrays.positions[b]));
      return entry->second;
    };
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < arrays.indices.size(); i += 3) {
      const std::uint32_t a = arrays.indices[i], b = arrays.indices[i + 1], c = arrays.indices[i + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      indices.insert(indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    arrays.indices = std::move(indices);
  }
  for (const Vec3& p : arrays.positions) arrays.normals.emplace_back(p);
  return triangleMesh(std::move(arrays), "icosphere");
}

TriangleMesh headMesh(int columns, int rows) {
  // A ball that is narrowed to a neck, with bumps and pits where a face has them: from its middle on the
  // point's distance.
  struct Feature {
    double across, height, width, tallness, out;
  };
  constexpr std::array<Feature, 8> kFeatures = {{{0, -0.1, 0.13, 0.25, 0.3},       // nose
                                                 {0.38, 0.15, 0.17, 0.12, -0.12},  // sockets
                                                 {-0.38, 0.15, 0.17, 0.12, -0.12},
                                                 {0, 0.36, 0.6, 0.07, 0.06},   // brows
                                                 {0, -0.45, 0.22, 0.06, 0.1},  // lips
                                                 {0, -0.75, 0.25, 0.15, 0.1},  // chin
                                                 {1.57, 0, 0.1, 0.25, 0.22},   // ears
                                                 {-1.57, 0, 0.1, 0.25, 0.22}}};
  MeshArrays arrays;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const double u = double(column) / columns, v = double(row) / rows;
      const double around = kTau * u - kPi, down = 0.02 + 2.75 * v;  // not to the pole, nor below the neck
      double radius = 0.9 + 0.25 * std::pow(std::max(0.0, -std::cos(down)), 6);
      for (const Feature& f : kFeatures)
        radius += f.out * std::exp(-std::pow((around - f.across) / f.width, 2) -
                                   std::pow((std::cos(down) - f.height) / f.tallness, 2));
      arrays.positions.emplace_back(0.75 * radius * std::sin(down) * std::sin(around),
                                    radius * std::cos(down),
                                    0.9 * radius * std::sin(down) * std::cos(around));
      arrays.uvs.emplace_back(u, v);
    }
  const auto corner = [&](int column, int row) {
    return static_cast<std::uint32_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = corner(column, row), b = corner(column + 1, row), c = corner(column, row + 1),
                          d = corner(column + 1, row + 1);
      arrays.indices.insert(arrays.indices.end(), {a, c, b, b, c, d});
    }
  return triangleMesh(std::move(arrays), "head");
}

TriangleMesh meshOf(const Surface& surface, double tolerance) {
  const Mesh mesh = tessellate(surface, {}, {.tolerance = tolerance});
  return triangleMesh({.positions = mesh.positions,
                       .normals = {mesh.normals.begin(), mesh.normals.end()},
                       .uvs = {mesh.parameters.begin(), mesh.parameters.end()},
                       .indices = mesh.indices},
                      surface.name());
}

TriangleMesh soup(std::mt19937& random, std::uint32_t triangles, double size) {
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  MeshArrays arrays;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Vec3 middle = vector();
    for (int k = 0; k < 3; ++k) {
      arrays.indices.push_back(static_cast<std::uint32_t>(arrays.positions.size()));
      arrays.positions.push_back(middle + size * vector());
      arrays.normals.emplace_back(vector());
      arrays.uvs.emplace_back(any(random), any(random));
    }
  }
  return triangleMesh(std::move(arrays), "soup");
}

}  // namespace luxo::test
