// SPDX-License-Identifier: Apache-2.0
// Which meshes bound a solid: known ones, and random ones against rays that begin outside.
#include "mesh/mesh_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>

namespace luxo {
namespace {

/// A grid that is closed along u, and closed or of single points along v.
MeshArrays gridOf(int u, int v, bool closed, const std::function<Vec3(double, double)>& at) {
  MeshArrays arrays;
  const int rows = closed ? v : v + 1;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < u; ++i) arrays.positions.push_back(at(kTau * i / u, double(j) / v));
  const auto vertex = [&](int i, int j) { return std::uint32_t(j % rows * u + i % u); };
  for (int j = 0; j < v; ++j)
    for (int i = 0; i < u; ++i)
      arrays.indices.insert(arrays.indices.end(), {vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1),
                                                   vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)});
  return arrays;
}

using Radius = std::function<double(double, double)>;

/// Whatever the radius, no two of its triangles are in the same direction: it bounds a solid. Poles are
/// points.
MeshArrays starOf(int u, int v, const Radius& radius, const Vec3& middle = Vec3(0)) {
  return gridOf(u, v, false, [&](double a, double t) {
    const double sine = t == 0 || t == 1 ? 0 : std::sin(kPi * t), r = radius(sine == 0 ? 0 : a, t);
    return middle + r * Vec3(sine * std::cos(a), std::cos(kPi * t), -sine * std::sin(a));
  });
}
MeshArrays torusOf(double major, double minor) {
  return gridOf(48, 24, true, [=](double a, double t) {
    const double r = major - minor * std::cos(kTau * t);
    return Vec3(r * std::cos(a), minor * std::sin(kTau * t), -r * std::sin(a));
  });
}
MeshArrays together(MeshArrays a, const MeshArrays& b) {
  const auto first = std::uint32_t(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const std::uint32_t index : b.indices) a.indices.push_back(first + index);
  return a;
}
MeshArrays turned(MeshArrays arrays) {
  for (std::size_t i = 0; i < arrays.indices.size(); i += 3)
    std::swap(arrays.indices[i], arrays.indices[i + 1]);
  return arrays;
}
bool isSolid(const MeshArrays& arrays) { return boundsSolid(triangleMesh(arrays)); }

MeshArrays ball(double radius, const Vec3& middle = Vec3(0)) {
  return starOf(
      32, 16, [=](double, double) { return radius; }, middle);
}

/// A cube whose faces are grids: flat fans around every point.
MeshArrays griddedCube(int n) {
  MeshArrays arrays;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto first = std::uint32_t(arrays.positions.size());
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          Vec3 p;
          p[axis] = side;
          p[(axis + 1) % 3] = -1 + 2.0 * i / n;
          p[(axis + 2) % 3] = -1 + 2.0 * j / n;
          arrays.positions.push_back(p);
        }
      const auto vertex = [&](int i, int j) { return first + std::uint32_t(j * (n + 1) + i); };
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const auto a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
          if (side > 0)
            arrays.indices.insert(arrays.indices.end(), {a, b, c, a, c, d});
          else
            arrays.indices.insert(arrays.indices.end(), {a, c, b, a, d, c});
        }
    }
  return arrays;
}

TEST(MeshSolid, OfKnownMeshes) {
  EXPECT_TRUE(isSolid(ball(1)));
  EXPECT_TRUE(isSolid(ball(1, Vec3(1e6, -3e5, 2e4))));
  EXPECT_TRUE(isSolid(griddedCube(1)));
  EXPECT_TRUE(isSolid(griddedCube(7)));
  EXPECT_TRUE(isSolid(torusOf(1, 0.3)));
  EXPECT_TRUE(isSolid(together(ball(1), ball(0.8, Vec3(1, 0.2, 0))))) << "through each other";
  EXPECT_TRUE(isSolid(together(ball(1), ball(0.5)))) << "within another, both outward";

  EXPECT_FALSE(isSolid(turned(ball(1))));
  EXPECT_FALSE(isSolid(together(ball(1), turned(ball(0.5)))));
  EXPECT_FALSE(isSolid(together(ball(1), turned(ball(0.1, Vec3(5, 0, 0))))));
  EXPECT_FALSE(isSolid(torusOf(0.5, 0.8))) << "passes through itself";
  MeshArrays open = ball(1);
  open.indices.resize(open.indices.size() - 3);
  EXPECT_FALSE(isSolid(open));
}

TEST(MeshSolid, AStarIsSolidWhateverItsRadii) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0.2, 2);
  for (int i = 0; i < 20; ++i) {
    std::vector<double> radii(64);
    std::ranges::generate(radii, [&] { return any(random); });
    EXPECT_TRUE(isSolid(starOf(20 + i, 10 + i, [&](double a, double t) {
      return radii[std::size_t(1000 * a + 777 * t) % radii.size()];
    }))) << i;
  }
}

/// Whether the nearest triangle that a ray meets shows its front; true where it meets none.
bool meetsFront(const TriangleMesh& mesh, const Vec3& from, const Vec3& along) {
  double nearest = std::numeric_limits<double>::infinity();
  bool front = true;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const Vec3 a = mesh.point(mesh.indices()[3 * t]), b = mesh.point(mesh.indices()[3 * t + 1]) - a,
               c = mesh.point(mesh.indices()[3 * t + 2]) - a, normal = glm::cross(b, c);
    const double facing = glm::dot(normal, along);
    const Vec3 q = glm::cross(from - a, along);
    const double u = glm::dot(c, q) / -facing, v = -glm::dot(b, q) / -facing,
                 distance = glm::dot(normal, a - from) / facing;
    if (u < 0 || v < 0 || u + v > 1 || !(distance > 0) || distance >= nearest) continue;
    nearest = distance;
    front = facing < 0;
  }
  return front;
}

TEST(MeshSolid, FromOutsideOfASolidEveryRayMeetsAFrontFirst) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto direction = [&] { return unit(Vec3(any(random), any(random), any(random))); };
  int solids = 0, others = 0, backs = 0;
  for (int i = 0; i < 80; ++i) {
    MeshArrays arrays = i % 2 ? torusOf(1, 0.4) : ball(1);
    // Corners that move apart by about as much as triangles are wide pass through others.
    const double most = 0.02 + 0.2 * std::abs(any(random));
    if (i % 4 < 2)
      for (Vec3& p : arrays.positions) p += most * any(random) * direction();
    else
      for (Vec3& p : arrays.positions)
        if (p.y > 0.5 - most) p.y -= 4 * most * (p.y - 0.5 + most) / most;  // pushed in, perhaps through
    if (i % 2 == 0)                                                         // poles stay points
      for (const std::size_t row : {std::size_t(0), std::size_t(16)})
        std::fill_n(arrays.positions.begin() + std::ptrdiff_t(32 * row), 32, arrays.positions[32 * row]);
    const TriangleMesh mesh = triangleMesh(arrays);
    const bool solid = boundsSolid(mesh);
    ++(solid ? solids : others);
    for (int k = 0; k < 300; ++k) {
      const Vec3 from = 4.0 * direction(), to = 1.2 * direction();
      const bool front = meetsFront(mesh, from, to - from);
      if (solid) {
        ASSERT_TRUE(front) << i;
      }
      backs += !front;
    }
  }
  EXPECT_GT(solids, 10);
  EXPECT_GT(others, 10);
  EXPECT_GT(backs, 50) << "of the others";
}

/// By the solid angles of triangles, all of which are 4 pi (van Oosterom, Strackee, The solid angle of a
/// plane triangle, 1983).
double windingBySolidAngles(const TriangleMesh& mesh, const Transform& place, const Vec3& point) {
  double sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    std::array<Vec3, 3> c;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = transformPoint(place, mesh.point(mesh.indices()[3 * t + k])) - point;
    const double a = glm::length(c[0]), b = glm::length(c[1]), d = glm::length(c[2]);
    sum += 2 * std::atan2(glm::dot(c[0], glm::cross(c[1], c[2])), a * b * d + glm::dot(c[0], c[1]) * d +
                                                                      glm::dot(c[1], c[2]) * a +
                                                                      glm::dot(c[2], c[0]) * b);
  }
  return (mirrors(place) ? -1 : 1) * sum / (4 * kPi);
}

TEST(MeshSolid, ItsWindingNumberIsThatOfSolidAngles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto anywhere = [&] { return Vec3(any(random), any(random), any(random)); };
  const std::array meshes{triangleMesh(torusOf(0.7, 0.3)), triangleMesh(griddedCube(5)),
                          triangleMesh(together(ball(1), ball(0.7, Vec3(0.6, 0.1, 0)))),
                          triangleMesh(together(ball(1), turned(ball(0.6)))),
                          triangleMesh(torusOf(0.5, 0.8))};
  std::map<int, int> times;
  int open = 0;
  for (int i = 0; i < 3000; ++i) {
    const TriangleMesh& mesh = meshes[std::size_t(i) % meshes.size()];
    const Transform place = compose(3.0 * anywhere(), rotation(anywhere(), any(random)),
                                    Vec3(any(random) < 0 ? -0.7 : 1.3, 1 + 0.5 * any(random), 1));
    const Vec3 point = transformPoint(place, 1.3 * anywhere());
    const std::optional<int> number = windingNumber(mesh, place, point, 1e-9);
    open += !number;
    if (!number) continue;
    ASSERT_NEAR(*number, windingBySolidAngles(mesh, place, point), 1e-6) << i;
    ++times[*number];
  }
  EXPECT_LT(open, 5) << "lines that meet edges are rare";
  for (const int number : {0, 1, 2}) EXPECT_GT(times[number], 20) << number;
}

TEST(MeshSolid, ItsWindingNumberIsOpenWhereCornersMayMoveAcross) {
  const TriangleMesh mesh = triangleMesh(griddedCube(3));
  for (const double apart : {1e-3, 1e-5, 0.0, -1e-5, -1e-3}) {
    const Vec3 point(1 + apart, 0.1, 0.2);  // a face is at 1
    const std::optional<int> number = windingNumber(mesh, {}, point, 1e-4);
    if (std::abs(apart) < 1e-4)
      EXPECT_FALSE(number) << apart;
    else
      EXPECT_EQ(number, apart > 0 ? 0 : 1) << apart;
  }
  EXPECT_FALSE(windingNumber(mesh, {}, Vec3(1), 1e-4)) << "a corner";
  EXPECT_EQ(windingNumber(mesh, {}, Vec3(0.1, 0.03, 0.2), 1e-4), 1);
}

}  // namespace
}  // namespace luxo
