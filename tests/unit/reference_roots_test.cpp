// SPDX-License-Identifier: Apache-2.0
// Certified ray casting against shapes whose answer is known without it: the sphere by its quadratic, the
// torus by sphere tracing of its exact distance function, planes by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reference/roots.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/snapshot.h"
#include "surface/catalogue.h"
#include "surface/library.h"
#include "surface/spread.h"

namespace luxo::reference {
namespace {

class RandomRays {
 public:
  explicit RandomRays(unsigned seed) : random_(seed) {}

  /// From a point at `distance` toward one within `spread` of the origin.
  Ray next(double distance, double spread) {
    const Vec3 origin = distance * direction(), target = spread * direction();
    return {origin, unit(target - origin)};
  }

  Vec3 direction() {
    std::normal_distribution<double> normal;
    return unit(Vec3(normal(random_), normal(random_), normal(random_)));
  }

 private:
  std::mt19937 random_;
};

Roots cast(const CellTree& tree, const Ray& ray, Facing facing = Facing::Both) {
  return nearestRoot(tree, {ray, Transform{}}, {0, 1e9, facing, false});
}

/// Corrugated boards, y = A cos(k (x + 1/2)), seen along their flanks: cells as large as a wave hold one
/// root, toward which Newton's method does not find from everywhere. The truth is where the height of the ray
/// over the board first changes its sign, in steps of a thousandth of a wave.
TEST(ReferenceRoots, OfCorrugatedBoardsAreOnTheRay) {
  std::mt19937 random(50);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int hits = 0;
  for (int board = 0; board < 12; ++board) {
    const double waves = std::exp(between(3, 7.5)), k = 2 * kPi * waves, slope = between(0.6, 2),
                 height = slope / k;
    const Surface wave = surface([=](auto u, auto v) { return point(u - 0.5, height * cos(k * u), 0.5 - v); },
                                 {{0, 1}, {0, 1}});
    const CellTree tree(wave, {});
    for (int i = 0; i < 400; ++i) {
      const double elevation = std::atan(slope) * between(0.9, 1.1);
      const Vec3 target(between(-0.4, 0.4), height * between(-1, 1), between(-0.4, 0.4));
      const double azimuth = between(-0.2, 0.2);
      const Vec3 back(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                      std::cos(elevation) * std::sin(azimuth));
      const double away = 2 * height / back.y;  // from where the ray is above the board
      const Ray ray{target + away * back, -back};
      const auto above = [&](double t) {
        const Vec3 p = ray.origin + t * ray.direction;
        return p.y - height * std::cos(k * (p.x + 0.5));
      };
      const double step = 1e-3 / waves;
      double low = 0;
      while (above(low + step) > 0) low += step;
      const Roots roots = cast(tree, ray);
      ASSERT_TRUE(roots.nearest.has_value());
      if (!roots.certified) continue;
      ++hits;
      EXPECT_NEAR(above(roots.nearest->t), 0, 1e-14) << waves << " waves, ray " << i;
      // A ray that grazes a crest may have met it between two steps.
      EXPECT_LE(roots.nearest->t, low + step + 1e-12) << waves << " waves, ray " << i;
    }
  }
  EXPECT_GT(hits, 4700);
}

TEST(ReferenceRoots, SphereByItsQuadratic) {
  const double radius = 1.3;
  const CellTree tree(sphere(radius), {});
  RandomRays rays(1);
  int hits = 0, certified = 0;
  constexpr int kRays = 4000;
  for (int i = 0; i < kRays; ++i) {
    const Ray ray = rays.next(5, 1.8);
    const double b = glm::dot(ray.origin, ray.direction);
    const double discriminant = b * b - (glm::dot(ray.origin, ray.origin) - radius * radius);
    const Roots roots = cast(tree, ray);
    certified += roots.certified;
    ASSERT_EQ(roots.nearest.has_value(), discriminant >= 0) << i << " discriminant " << discriminant;
    if (!roots.nearest) continue;
    ++hits;
    // The distance is as ill-conditioned as the discriminant is small: d t = d disc / (2 sqrt(disc)).
    EXPECT_NEAR(roots.nearest->t, -b - std::sqrt(discriminant), 1e-13 * 5 + 1e-14 / std::sqrt(discriminant))
        << i;
  }
  EXPECT_EQ(certified, kRays);  // a random ray is never within rounding of the silhouette
  EXPECT_GT(hits, kRays / 4);
  EXPECT_LT(hits, kRays);
}

/// Distance along the ray to the torus around Y, or nothing: steps of the exact distance to it.
std::optional<double> traceTorus(const Ray& ray, double major, double minor) {
  double t = 0;
  for (int step = 0; step < 100'000 && t < 100; ++step) {
    const Vec3 p = ray.origin + t * ray.direction;
    const double ring = std::hypot(p.x, p.z) - major;
    const double distance = std::hypot(ring, p.y) - minor;
    if (distance < 1e-13) return t;
    t += distance;
  }
  return std::nullopt;
}

TEST(ReferenceRoots, TorusBySphereTracing) {
  const CellTree tree(torus(1, 0.4), {});
  RandomRays rays(2);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = rays.next(4, 1.6);
    const auto truth = traceTorus(ray, 1, 0.4);
    const Roots roots = cast(tree, ray);
    EXPECT_TRUE(roots.certified) << i;
    ASSERT_EQ(roots.nearest.has_value(), truth.has_value()) << i;
    if (!truth) continue;
    ++hits;
    // Tracing stops 1e-13 short of the surface, which is up to 1e-13 / cosine along the ray.
    EXPECT_NEAR(roots.nearest->t, *truth, 1e-7) << i;
    const Vec3 p = ray.origin + roots.nearest->t * ray.direction;
    EXPECT_NEAR(std::hypot(std::hypot(p.x, p.z) - 1, p.y), 0.4, 1e-13) << i;
  }
  EXPECT_GT(hits, 500);
}

// From inside only the far wall is there; of a closed surface seen from outside the front is the nearer of
// two.
TEST(ReferenceRoots, FrontsAndBacks) {
  const CellTree tree(sphere(1), {});
  RandomRays rays(3);
  for (int i = 0; i < 200; ++i) {
    const Ray inside{0.5 * rays.direction(), rays.direction()};
    EXPECT_TRUE(cast(tree, inside).nearest);
    EXPECT_FALSE(cast(tree, inside, Facing::Front).nearest);
    const Ray outside = rays.next(3, 0.9);
    const Roots both = cast(tree, outside), front = cast(tree, outside, Facing::Front);
    ASSERT_TRUE(both.nearest && front.nearest);
    EXPECT_EQ(both.nearest->t, front.nearest->t);
  }
}

// Straight down on the pole and along the seam: what is hit is a line or a point of the (u,v) rectangle's
// edge.
TEST(ReferenceRoots, PolesAndSeams) {
  const CellTree tree(sphere(1), {});
  const Roots pole = cast(tree, {{0, 3, 0}, {0, -1, 0}});
  ASSERT_TRUE(pole.nearest);
  EXPECT_NEAR(pole.nearest->t, 2, 1e-12);
  // The seam of the sphere lies in the half plane of +X.
  const Roots seam = cast(tree, {{5, 0.3, 0}, {-1, 0, 0}});
  ASSERT_TRUE(seam.nearest);
  EXPECT_NEAR(seam.nearest->t, 5 - std::sqrt(1 - 0.09), 1e-12);
  EXPECT_TRUE(seam.certified);
}

// A unit square flattened into a plane by a singular transform is still where it was put.
TEST(ReferenceRoots, AFormulaThatEndsInsideOfItsRectangleEndsThere) {
  // Half a ball over a square: the rays that meet the whole ball above y = 0 meet it, and no others.
  const Surface dome =
      surface([](auto u, auto v) { return point(u, sqrt(1.0 - u * u - v * v), -v); }, {{-2, 2}, {-2, 2}});
  const CellTree tree(dome, {});
  EXPECT_LT(tree.size(), 4);
  RandomRays rays(11);
  int hits = 0, nearTheRim = 0, undecided = 0;
  for (int i = 0; i < 4000; ++i) {
    const Ray ray = rays.next(5, 1.2);
    const double b = glm::dot(ray.origin, ray.direction), d = b * b - glm::dot(ray.origin, ray.origin) + 1;
    std::optional<double> expected;
    bool close = std::abs(d) < 1e-6;
    for (const double t : {-b - std::sqrt(d), -b + std::sqrt(d)}) {
      const double y = (ray.origin + t * ray.direction).y;
      close = close || std::abs(y) < 2e-6;  // as high as 1e-13 of the square are wide there
      nearTheRim += std::abs(y) < 1e-2;
      if (d > 0 && y > 0 && !expected) expected = t;
    }
    if (close) continue;
    const Roots found = cast(tree, ray);
    undecided += !found.certified;
    if (!found.certified) continue;
    ASSERT_EQ(found.nearest.has_value(), expected.has_value()) << i;
    if (!expected) continue;
    EXPECT_NEAR(found.nearest->t, *expected, 1e-9);
    ++hits;
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(nearTheRim, 20);
  EXPECT_LE(undecided, 2) << "rays along the rim, a ten-thousandth above it";
}

TEST(ReferenceRoots, AFormulaThatGoesDownWithoutEndIsMet) {
  const Surface well =
      surface([](auto u, auto v) { return point(u, log(1.0 - u * u - v * v), -v); }, {{-2, 2}, {-2, 2}});
  const CellTree tree(well, {});
  for (double x = -0.97; x < 1; x += 0.03) {  // from above, and from the side
    const Roots down = cast(tree, {Vec3(x, 5, 0.1), Vec3(0, -1, 0)});
    ASSERT_EQ(down.nearest.has_value(), x * x + 0.01 < 1);
    EXPECT_TRUE(down.certified);
    EXPECT_NEAR(down.nearest->t, 5 - std::log(1 - x * x - 0.01), 1e-9);
    const double y = 4 * x - 4.5, z = 0.137, u = std::sqrt(1 - std::exp(y) - z * z);
    const Roots across = cast(tree, {Vec3(-7, y, z), Vec3(1, 0, 0)});
    ASSERT_TRUE(across.nearest);
    EXPECT_TRUE(across.certified);
    EXPECT_NEAR(across.nearest->t, 7 - u, 1e-9);
  }
  EXPECT_FALSE(cast(tree, {Vec3(1.5, 5, 0.1), Vec3(0, -1, 0)}).nearest);
}

TEST(ReferenceRoots, ARemovablePointIsThere) {
  const Surface hat = surface(
      [](auto u, auto v) {
        const auto r = sqrt(u * u + v * v);
        return point(u, sin(r) / r, -v);
      },
      {{-8, 8}, {-8, 8}});
  const CellTree tree(hat, {});
  for (const double x : {1e-6, 1e-3, 0.1, 1.0, 3.0}) {
    const double r = std::hypot(x, 0.3 * x);
    const Roots down = cast(tree, {Vec3(x, 5, 0.3 * x), Vec3(0, -1, 0)});
    ASSERT_TRUE(down.nearest && down.certified) << x << " " << down.cells;
    EXPECT_NEAR(down.nearest->t, 5 - std::sin(r) / r, 1e-9);
  }
  const Roots besides = cast(tree, {Vec3(-20, 1.001, 0), Vec3(1, 0, 0)});
  EXPECT_TRUE(besides.certified && !besides.nearest) << "just over the top";
}

// Around the axis bounds exclude nothing up to a height of 1e9, and what a ray there meets stays open; what
// is behind it is found all the same.
TEST(ReferenceRoots, WhatIsBehindAnUndecidedPlaceIsFound) {
  const auto height = [](double x) { return 3 * std::sin(6 * x) / (6 * x + 1e-9); };
  const Surface ripple = surface(
      [](auto x, auto y) {
        const auto r = 6.0 * sqrt(x * x + y * y);
        return point(x, 3.0 * sin(r) / (r + 1e-9), -y);
      },
      {{-6, 6}, {-6, 6}});
  const CellTree tree(ripple, {});
  for (const double above : {3.05, 3.2, 3.5}) {
    const Vec3 eye(2, 2 * above, 0);
    const Ray ray{eye, unit(Vec3(0, above, 0) - eye)};  // just over the tip, which is 3 high
    const Roots roots = cast(tree, ray);
    EXPECT_FALSE(roots.certified);
    ASSERT_TRUE(roots.nearest) << above;
    const Vec3 hit = ray.origin + roots.nearest->t * ray.direction;
    EXPECT_LT(hit.x, -0.5);
    EXPECT_NEAR(hit.y, height(-hit.x), 1e-9);
  }
}

TEST(ReferenceRoots, OfAFormulaWithoutAnyValueNothingIsMet) {
  const Scene scene = buildScene(parseScene(
      R"_({"luxo": 1, "surfaces": {"s": {"type": "formula", "position": ["u", "sqrt(1 - t - u^2)", "v"],
          "u": [-1, 1], "v": [-1, 1]}}, "nodes": [{"surface": "s"}]})_",
      "ended.luxo.json"));
  const Snapshot ended = takeSnapshot(scene, 3, {8, 8});
  ASSERT_EQ(ended.nodes.size(), 1U);
  const CellTree tree(ended.nodes[0].surface, ended.nodes[0].parameters);
  const Roots roots = cast(tree, {Vec3(0, 5, 0), Vec3(0, -1, 0)});
  EXPECT_FALSE(roots.nearest);
  EXPECT_TRUE(roots.certified);
}

// A line through a point of a box meets it; one moved aside, across an edge and across the line, by more than
// the box reaches does not.
TEST(RayFunctions, TellBoxesThatTheyMissWhateverTheirShape) {
  std::mt19937_64 random(7);  // NOLINT: the same numbers every time
  std::uniform_real_distribution<double> number(-1, 1), size(-9, 3);
  const auto vector = [&] { return Vec3(number(random), number(random), number(random)); };
  const auto turned = [&] { return unit(vector()); };
  for (int i = 0; i < 20'000; ++i) {
    const Transform placed{rotation(turned(), 3 * number(random)) * std::exp2(number(random)),
                           5.0 * vector()};
    const Enclosure box{3.0 * vector(), glm::pow(Vec3(10), Vec3(size(random), size(random), size(random)))};
    const Vec3 inside = box.center + 0.999 * vector() * box.radius, direction = turned();
    const auto misses = [&](const Vec3& through) {
      const Vec3 world = transformPoint(placed, through);
      return RayFunctions({world - 7.0 * unit(placed.linear * direction), unit(placed.linear * direction)},
                          placed)
          .misses(box);
    };
    EXPECT_FALSE(misses(inside)) << i;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 edge(0);
      edge[axis] = 1;
      const Vec3 aside = unit(glm::cross(direction, edge));
      const double reach = glm::dot(glm::abs(aside), box.radius);
      EXPECT_TRUE(misses(box.center + aside * (1.001 * reach + 1e-12))) << i << " " << axis;
    }
  }
}

TEST(ReferenceRoots, SingularTransforms) {
  const CellTree tree(sphere(1), {});
  const Transform flat{Mat3(2, 0, 0, 0, 3, 0, 0, 0, 0), {0, 0, -1}};
  const Ray ray{{1, 1, 4}, {0, 0, -1}};
  const Roots roots = nearestRoot(tree, {ray, flat}, {0, 100, Facing::Both, false});
  ASSERT_TRUE(roots.nearest);
  EXPECT_NEAR(roots.nearest->t, 5, 1e-12);
  const Ray beside{{1.9, 1.5, 4}, {0, 0, -1}};  // (1.9/2)^2 + (1.5/3)^2 > 1
  EXPECT_FALSE(nearestRoot(tree, {beside, flat}, {0, 100, Facing::Both, false}).nearest);
}

// Near and far roots outside the asked range do not count; the next one within it does.
TEST(ReferenceRoots, OnlyTheAskedRangeCounts) {
  const CellTree tree(sphere(1), {});
  const Ray ray{{0.1, 0.2, 5}, {0, 0, -1}};
  const double half = std::sqrt(1 - 0.05);
  const RayFunctions functions(ray, Transform{});
  EXPECT_NEAR(nearestRoot(tree, functions, {5, 100, Facing::Both, false}).nearest->t, 5 + half, 1e-12);
  EXPECT_FALSE(nearestRoot(tree, functions, {0, 3, Facing::Both, false}).nearest);
  EXPECT_FALSE(nearestRoot(tree, functions, {7, 100, Facing::Both, false}).nearest);
}

// Every named surface, from near, and a sum of sines that passes through itself a dozen times on a ray: the
// roots that one traversal finds are those that are found one by one.
TEST(ReferenceRoots, AllInOrderAreThoseFoundOneByOne) {
  RandomRays rays(11);
  int met = 0;
  const auto compare = [&](const Surface& surface, const std::string& name, int count) {
    const Box box = surface.framing({});
    if (!isFinite(box) || box.empty()) return;
    const CellTree tree(surface, {});
    const double size = glm::length(box.extent());
    for (int i = 0; i < count; ++i) {
      const Ray at = rays.next(0.4 * size, 0.5 * size);
      const Ray ray{at.origin + box.center(), at.direction};
      const RayFunctions functions(ray, Transform{});
      RootQuery query{0, 10 * size, i % 2 == 0 ? Facing::Both : Facing::Front, false};
      const RootsInOrder all(tree, functions, query);
      for (int layer = 0; layer < 64; ++layer) {
        const Roots one = nearestRoot(tree, functions, query), same = all.from(query.nearest);
        // Where rays graze another search may leave less undecided.
        if (!one.certified || !same.certified) break;
        ASSERT_EQ(one.nearest.has_value(), same.nearest.has_value()) << name << " " << i << " " << layer;
        if (!one.nearest) break;
        ++met;
        EXPECT_NEAR(one.nearest->t, same.nearest->t, 1e-8 * size) << name << " " << i << " " << layer;
        EXPECT_EQ(one.nearest->patch, same.nearest->patch) << name << " " << i << " " << layer;
        query.nearest = one.nearest->t * (1 + 1e-9) + 1e-8 * size;
      }
    }
  };
  for (const CatalogueEntry& entry : catalogue()) compare(makeSurface(entry), std::string(entry.name), 60);
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const ExprPoint sines{cos(3 * u) + cos(5 * v + u), sin(4 * u + 2 * v) + cos(v), sin(5 * u) + sin(3 * v)};
  compare(Surface({Patch{compileSurface(graph, sines), {{0, 6}, {0, 6}}}}), "sines", 200);
  EXPECT_GT(met, 2000);
}

// A ray along a sheet, which it never leaves, and through another part of it: that it does not end is told,
// and it ends.
TEST(ReferenceRoots, AllOfARayAlongItsSurfaceAreNotDecided) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const CellTree tree(Surface({Patch{compileSurface(graph, {u, v * v, v * (v - 1)}), {{0, 1}, {-2, 2}}}}),
                      {});
  const RayFunctions along({{-1, 0, 0}, {1, 0, 0}}, Transform{});
  const RootsInOrder all(tree, along, {0, 100, Facing::Both, false});
  const Roots roots = all.from(0);
  EXPECT_FALSE(roots.certified);
  EXPECT_TRUE(roots.nearest.has_value());
  EXPECT_LT(roots.cells, 1'000'000);
}

// Beside the rim of a supertoroid (exponent 0.38) a parameter's last bit is worth 1e-6 of the size, and
// derivatives are unbounded: boxes of where the formula has values decide the rays there that no number of
// unbounded ones did (20,000 cells, half an hour a picture).
TEST(ReferenceRoots, ASteepRimIsDecided) {
  const CellTree tree(makeSurface("supertoroid", {{.name = "exponents", .components = {0.3796, 0.9032}}}),
                      {});
  const Vec3 eye{2.15260764, 0.82355424, -0.36882863}, target{1.33230655, -0.32995402, -0.37100425};
  const Vec3 right = unit(glm::cross(target - eye, Vec3(-0.9619, -0.2603, -0.08416)));
  for (int i = 0; i < 40; ++i) {
    const Roots roots = cast(tree, {eye, unit(unit(target - eye) + (i - 20) * 1e-4 * right)});
    EXPECT_TRUE(roots.certified) << i;
    EXPECT_EQ(roots.nearest.has_value(), i < 23) << i;
    EXPECT_LE(roots.cells, 100);
  }
}

}  // namespace
}  // namespace luxo::reference
