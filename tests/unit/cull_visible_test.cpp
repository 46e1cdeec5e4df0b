// SPDX-License-Identifier: Apache-2.0
// What is skipped must be provably invisible; what is kept carries the right tolerance and comes in the right
// order.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cull/cull.h"
#include "scene_test_support.h"

namespace luxo {
namespace {

constexpr CullOptions kNothingSkipped{.frustum = false, .small = false, .backface = false, .lights = false};
constexpr PixelSize kViewSize{160, 90};

Camera someCamera(test::Random& random) {
  return {.eye = random.inCube(8),
          .lookAt = random.inCube(4),
          .fovY = radians(random.uniform(5, 140)),
          .projection = random.below(4) ? Projection::Perspective : Projection::Orthographic,
          .height = random.uniform(1, 20)};
}

/// Nodes anywhere, of any shape, uneven, mirrored.
Scene someScene(test::Random& random, int nodes, double spread, double size = 1) {
  Scene scene;
  for (int i = 0; i < nodes; ++i)
    scene.add(Node{.translation = random.inCube(spread),
                   .rotation = random.rotation(),
                   .scale = size * random.scale(),
                   .surface = random.surface()});
  return scene;
}

std::vector<bool> keptNodes(const Snapshot& snapshot, const VisibleList& list) {
  std::vector<bool> kept(snapshot.nodes.size());
  for (const auto* nodes : {&list.opaque, &list.transparent})
    for (const VisibleNode& node : *nodes) kept[node.node] = true;
  return kept;
}

TEST(Cull, NoNodeWithAPointInThePictureIsOutsideTheFrustum) {
  test::Random random(21);
  std::uint32_t culled = 0, drawn = 0;
  for (int i = 0; i < 200; ++i) {
    const Snapshot snapshot = takeSnapshot(someScene(random, 10, 15), 0, kViewSize, someCamera(random));
    CullOptions options = kNothingSkipped;
    options.frustum = true;
    const VisibleList list = cull(snapshot, options);
    culled += list.counts.culledFrustum;
    drawn += list.counts.drawn;
    ASSERT_EQ(list.counts.nodes, list.counts.drawn + list.counts.culledFrustum);
    const std::vector<bool> kept = keptNodes(snapshot, list);
    for (std::size_t n = 0; n < kept.size(); ++n) {
      if (kept[n]) continue;
      const Transform place = eyeFromObject(snapshot.view, snapshot.nodes[n].worldFromObject);
      for (const Vec3& p : test::sample(snapshot.nodes[n].surface, 24)) {
        const Vec3 eye = transformPoint(place, p);
        if (-eye.z < snapshot.view.near) continue;
        const Vec2 pixel = pixelFromEye(snapshot.view, eye);
        ASSERT_FALSE(pixel.x >= 0 && pixel.x <= kViewSize.width && pixel.y >= 0 &&
                     pixel.y <= kViewSize.height);
      }
    }
  }
  EXPECT_GT(culled, 500u);
  EXPECT_GT(drawn, 300u);
}

bool holds(const std::array<Vec2, 3>& t, const Vec2& p) {
  const auto side = [&](int i) {
    const Vec2 edge = t[(i + 1) % 3] - t[i], to = p - t[i];
    return edge.x * to.y - edge.y * to.x;
  };
  const double a = side(0), b = side(1), c = side(2);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

/// Whether a triangle of a grid on the surface covers a sample position of any pixel.
bool coversASample(const View& view, const SnapshotNode& node, std::span<const Vec2> positions) {
  constexpr int kCells = 8;
  const Transform place = eyeFromObject(view, node.worldFromObject);
  std::vector<Vec2> pixels;
  for (const Vec3& p : test::sample(node.surface, kCells))
    pixels.push_back(pixelFromEye(view, transformPoint(place, p)));
  const auto covers = [&](const std::array<Vec2, 3>& t) {
    const Vec2 low = glm::floor(glm::min(glm::min(t[0], t[1]), t[2])),
               high = glm::max(glm::max(t[0], t[1]), t[2]);
    for (double y = low.y; y <= high.y; ++y)
      for (double x = low.x; x <= high.x; ++x)
        for (const Vec2& position : positions)
          if (holds(t, Vec2(x, y) + position)) return true;
    return false;
  };
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column) {
      const int a = row * (kCells + 1) + column, b = a + 1, c = a + kCells + 1, d = c + 1;
      if (covers({pixels[a], pixels[b], pixels[d]}) || covers({pixels[a], pixels[d], pixels[c]})) return true;
    }
  return false;
}

TEST(Cull, NoNodeThatCoversASampleIsTooSmall) {
  const std::array<Vec2, 1> one = {Vec2(0.5, 0.5)};
  const std::array<Vec2, 4> four = {Vec2(0.375, 0.125), Vec2(0.875, 0.375), Vec2(0.125, 0.625),
                                    Vec2(0.625, 0.875)};
  test::Random random(22);
  std::uint32_t culledOne = 0, culledFour = 0, coveringOne = 0;
  for (int i = 0; i < 400; ++i) {
    // About 60 pixels per metre at the middle of the scene: shapes of a few hundredths to a few pixels.
    const Scene scene = someScene(random, 10, 1, 0.012);
    const Camera camera{.eye = Vec3(0, 0, 4),
                        .fovY = radians(20),
                        .projection = i % 4 ? Projection::Perspective : Projection::Orthographic,
                        .height = 1.5};
    const Snapshot snapshot = takeSnapshot(scene, 0, kViewSize, camera);
    for (const int samples : {1, 4}) {
      CullOptions options = kNothingSkipped;
      options.small = true;
      options.samples = samples;
      const VisibleList list = cull(snapshot, options);
      (samples == 1 ? culledOne : culledFour) += list.counts.culledSmall;
      const std::vector<bool> kept = keptNodes(snapshot, list);
      for (std::size_t n = 0; n < kept.size(); ++n) {
        const bool covers =
            coversASample(snapshot.view, snapshot.nodes[n],
                          samples == 1 ? std::span<const Vec2>(one) : std::span<const Vec2>(four));
        ASSERT_TRUE(kept[n] || !covers);
        coveringOne += samples == 1 && covers;
      }
    }
  }
  EXPECT_GT(culledOne, 300u);
  EXPECT_GT(coveringOne, 300u);
  EXPECT_LT(culledFour, culledOne);  // four samples see more
  EXPECT_GT(culledFour, 0u);
}

TEST(Cull, SmallDependsOnWhereTheSamplesAre) {
  // f = 50 pixels per metre at depth 1, the picture's centre (50, 50) is a corner of four pixels.
  const auto keeps = [](const Vec2& pixel, int samples, Shading shading = Shading::Phong) {
    Scene scene;
    scene.add(Node{.translation = Vec3((pixel.x - 50) / 5, (50 - pixel.y) / 5, -5), .surface = sphere(0.01)});
    const Camera camera{.eye = Vec3(0, 0, 5), .fovY = radians(90)};
    return cull(takeSnapshot(scene, 0, {100, 100}, camera), {.samples = samples, .shading = shading})
               .counts.drawn == 1;
  };
  // The sphere covers 0.05 pixel to each side; 1/32 pixel of margin comes on top.
  EXPECT_TRUE(keeps({50.5, 50.5}, 1));
  EXPECT_TRUE(keeps({50.43, 50.5}, 1));
  EXPECT_FALSE(keeps({50.4, 50.5}, 1));
  EXPECT_FALSE(keeps({50.5, 50.4}, 1));
  EXPECT_TRUE(keeps({30.375, 62.125}, 4));
  EXPECT_TRUE(keeps({30.625, 62.875}, 4));
  EXPECT_FALSE(keeps({30.125, 62.125}, 4));                 // the column of one sample in the row of another
  EXPECT_TRUE(keeps({50.1, 50.1}, 1, Shading::Wireframe));  // a line is a pixel wide
}

TEST(Cull, OffCentreSamplesSeeOtherThingsAndBeyondTheBorder) {
  const auto keeps = [](const Vec2& pixel, const Vec2& offset) {
    Scene scene;
    scene.add(Node{.translation = Vec3((pixel.x - 50) / 5, (50 - pixel.y) / 5, -5), .surface = sphere(0.01)});
    Snapshot snapshot = takeSnapshot(scene, 0, {100, 100}, Camera{.eye = Vec3(0, 0, 5), .fovY = radians(90)});
    snapshot.view = sampledAt(snapshot.view, offset);
    return cull(snapshot).counts.drawn == 1;
  };
  EXPECT_TRUE(keeps({50.75, 50.25}, {0.25, -0.25}));
  EXPECT_FALSE(keeps({50.75, 50.25}, {0.25, 0.25}));
  EXPECT_FALSE(keeps({50.5, 50.5}, {0.25, -0.25}));
  // The samples of the last column may lie beyond the border.
  EXPECT_TRUE(keeps({100.25, 50.5}, {0.75, 0}));
  EXPECT_FALSE(keeps({100.25, 50.5}, {0.5, 0}));
}

TEST(Cull, LinesReachBeyondTheFrustum) {
  const auto drawn = [](double pixel, Shading shading) {
    Scene scene;
    scene.add(Node{.translation = Vec3((pixel - 50) / 5, 0, -5), .surface = sphere(0.05)});
    const Camera camera{.eye = Vec3(0, 0, 5), .fovY = radians(90)};
    return cull(takeSnapshot(scene, 0, {100, 100}, camera), {.shading = shading, .small = false})
        .counts.drawn;
  };
  EXPECT_EQ(drawn(100.4, Shading::Phong), 1u);  // the sphere covers a quarter of a pixel to each side
  EXPECT_EQ(drawn(101.0, Shading::Phong), 0u);
  EXPECT_EQ(drawn(101.0, Shading::Wireframe), 1u);
  EXPECT_EQ(drawn(103.0, Shading::Wireframe), 0u);
}

TEST(Cull, WhateverIsWithinTheToleranceMovesNoFurtherOnTheScreen) {
  test::Random random(23);
  int checked = 0;
  double tightest = 0;
  for (int i = 0; i < 400; ++i) {
    const Snapshot snapshot = takeSnapshot(someScene(random, 6, 6), 0, kViewSize, someCamera(random));
    const View& view = snapshot.view;
    const double tolerance = std::exp(random.uniform(std::log(0.01), std::log(20.0)));
    CullOptions options = kNothingSkipped;
    options.tolerancePx = tolerance;
    for (const VisibleNode& visible : cull(snapshot, options).opaque) {
      const SnapshotNode& node = snapshot.nodes[visible.node];
      const Transform place = eyeFromObject(view, node.worldFromObject);
      // The bound of the tolerance is the tolerance.
      ASSERT_NEAR(boundPx(view, visible, visible.toleranceObject), tolerance, 1e-9 * tolerance);
      for (int k = 0; k < 40; ++k) {
        const Vec3 part(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
        const Vec3 surface = node.boundsObject.min + part * node.boundsObject.extent();
        const Vec3 mesh = surface + visible.toleranceObject * random.direction();
        const Vec3 a = transformPoint(place, surface), b = transformPoint(place, mesh);
        // A point of the mesh is seen when it is in the picture.
        const Vec2 seen = pixelFromEye(view, b);
        if (-b.z < view.near || seen.x < 0 || seen.y < 0 || seen.x > kViewSize.width ||
            seen.y > kViewSize.height)
          continue;
        if (-a.z < visible.nearestDepth)
          continue;  // beyond the near plane the surface has no place on the screen
        const double moved = glm::length(pixelFromEye(view, a) - seen);
        ASSERT_LE(moved, tolerance * (1 + 1e-9));
        tightest = std::max(tightest, moved / tolerance);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 3000);
  EXPECT_GT(tightest, 0.9);  // and it is not a fantasy
}

TEST(Cull, ToleranceMatchesTheFormulaByHand) {
  // A unit sphere 10 m ahead, f = 50: z = 9, its bounds reach 1 m aside at depth 9, so tan phi = sqrt(2) / 9.
  Scene scene;
  scene.add(Node{.scale = Vec3(2, 1, 1), .surface = rectangle(1, 2)});
  const Camera camera{.eye = Vec3(0, 0, 10), .up = Vec3(0, 1, 0), .fovY = radians(90)};
  const VisibleNode node = cull(takeSnapshot(scene, 0, {100, 100}, camera), kNothingSkipped).opaque.at(0);
  // x from -1 to 1, y = 0, z from -1 to 1: nearest depth 9, tan phi = 1/9, stretch 2.
  EXPECT_NEAR(node.nearestDepth, 9, 1e-4);
  EXPECT_NEAR(node.stretch, 2, 1e-11);
  const double f = 50 * std::sqrt(1 + 1.0 / 81);
  EXPECT_NEAR(node.pixelsPerUnit, f, 1e-3);
  EXPECT_NEAR(node.toleranceObject, 0.5 * 9 / (f + 0.5) / 2, 1e-5);
  EXPECT_EQ(boundPx(View{}, node, 9), std::numeric_limits<double>::infinity());  // it could reach the eye
}

TEST(Cull, ToleranceNextToTheEyeIsThatOfTheNearPlane) {
  Scene scene;
  scene.add(Node{.surface = sphere(3)});
  const Camera camera{.eye = Vec3(0, 0, 2), .fovY = radians(90), .near = 0.1};
  const VisibleNode node = cull(takeSnapshot(scene, 0, {100, 100}, camera)).opaque.at(0);
  EXPECT_EQ(node.nearestDepth, 0.1);
  EXPECT_NEAR(node.pixelsPerUnit, 50 * std::sqrt(3.0),
              1e-9);  // up to the corner of the picture, tan phi = sqrt 2
  EXPECT_GT(node.toleranceObject, 0);
}

TEST(Cull, WhatHasNoBoundsIsKeptAtTheQualityOfWhatIsSeen) {
  // Most of 1 / u is within 40 of the origin, seen from 1000 away; some of it may be anywhere.
  Scene scene;
  scene.add(Node{.surface = surface([](auto u, auto v) { return point(u, 1 / u, v); }, {{-1, 1}, {0, 1}})});
  const Camera camera{.eye = Vec3(0, 0, 1000), .lookAt = Vec3(0)};
  const Camera away{.eye = Vec3(0, 0, 1000), .lookAt = Vec3(0, 0, 2000)};
  EXPECT_EQ(cull(takeSnapshot(scene, 0, kViewSize, away), {}).counts.drawn, 1u);
  const Snapshot snapshot = takeSnapshot(scene, 0, kViewSize, camera);
  const VisibleNode visible = cull(snapshot, {.tolerancePx = 0.5}).opaque.at(0);
  const double pixel = 1000 / snapshot.view.pixelsPerUnit;
  EXPECT_LE(visible.toleranceObject, 0.5 * pixel);
  EXPECT_GE(visible.toleranceObject, 0.25 * pixel);
  EXPECT_TRUE(std::isinf(boundPx(snapshot.view, visible, 1))) << "and nothing is claimed";
}

TEST(Cull, OpaqueFrontToBackTransparentAsGiven) {
  test::Random random(24);
  Scene scene;
  const MaterialId glass = scene.add(Material{.opacity = 0.5});
  for (int i = 0; i < 60; ++i)
    scene.add(Node{
        .translation = random.inCube(5), .surface = sphere(0.3), .material = i % 2 ? glass : MaterialId{}});
  const Snapshot snapshot =
      takeSnapshot(scene, 0, kViewSize, Camera{.eye = Vec3(0, 0, 20), .fovY = radians(60)});
  const VisibleList list = cull(snapshot);
  EXPECT_EQ(list.opaque.size(), 30u);
  EXPECT_EQ(list.transparent.size(), 30u);
  EXPECT_TRUE(std::ranges::is_sorted(list.opaque, std::less{}, &VisibleNode::nearestDepth));
  EXPECT_TRUE(std::ranges::is_sorted(list.transparent, std::less{}, &VisibleNode::node));
  // Of geometry the nearest surface counts, and a material that nothing is seen of is not drawn.
  EXPECT_EQ(cull(snapshot, {.ofGeometry = true}).opaque.size(), 60u);
  Scene clear;
  clear.add(Node{.surface = sphere(0.3), .material = clear.add(Material{.opacity = 0})});
  const Snapshot nothing =
      takeSnapshot(clear, 0, kViewSize, Camera{.eye = Vec3(0, 0, 20), .fovY = radians(60)});
  EXPECT_EQ(cull(nothing).counts.drawn, 0u);
  EXPECT_EQ(cull(nothing, {.ofGeometry = true}).counts.drawn, 0u);
  EXPECT_EQ(cull(nothing, {.shading = Shading::Normal}).counts.drawn, 0u);
}

TEST(Cull, OrderDoesNotDependOnInsertion) {
  // Two rows of equal depth, so that ties are broken all the time.
  std::vector<Vec3> places;
  for (int i = 0; i < 12; ++i) places.emplace_back(i % 6 - 2.5, i % 4, i / 6);
  test::Random random(25);
  std::vector<Vec3> expected;
  for (int round = 0; round < 50; ++round) {
    Scene scene;
    for (const Vec3& place : places) scene.add(Node{.translation = place, .surface = sphere(0.3)});
    const Snapshot snapshot =
        takeSnapshot(scene, 0, kViewSize, Camera{.eye = Vec3(0, 0, 20), .fovY = radians(60)});
    const VisibleList list = cull(snapshot);
    const auto placesOf = [&](const std::vector<VisibleNode>& nodes) {
      std::vector<Vec3> found;
      for (const VisibleNode& node : nodes)
        found.push_back(snapshot.nodes[node.node].worldFromObject.translation);
      return found;
    };
    if (round == 0) expected = placesOf(list.opaque);
    ASSERT_EQ(placesOf(list.opaque), expected);
    for (std::size_t i = places.size(); i > 1; --i)
      std::swap(places[i - 1], places[random.below(static_cast<int>(i))]);
  }
}

VisibleNode only(const Node& node, const Camera& camera, const Material& material,
                 const CullOptions& options = {}) {
  Scene scene;
  Node copy = node;
  copy.material = scene.add(material);
  scene.add(copy);
  const VisibleList list = cull(takeSnapshot(scene, 0, {100, 100}, camera), options);
  return list.opaque.empty() ? list.transparent.at(0) : list.opaque[0];
}

TEST(Cull, ClosedSurfacesHaveAnInsideOnlyForThoseOutside) {
  const Camera outside{.eye = Vec3(0, 0, 5), .fovY = radians(60)};
  const Node ball{.surface = sphere(1)};
  EXPECT_TRUE(only(ball, outside, {}).closedFromOutside);
  EXPECT_FALSE(only(ball, outside, {}, kNothingSkipped).closedFromOutside);
  EXPECT_FALSE(only(ball, outside, {.opacity = 0.5}).closedFromOutside);  // the back shines through
  EXPECT_FALSE(only(ball, outside, {.shading = Shading::Wireframe}).closedFromOutside);
  EXPECT_FALSE(only({.surface = cylinder(1, 1)}, outside, {}).closedFromOutside);  // open
  EXPECT_TRUE(only({.surface = cylinder(1, 1)}, outside, {.twoSided = TwoSided::No}).hideBackFaces);
  EXPECT_TRUE(
      only({.surface = cylinder(1, 1)}, outside, {.twoSided = TwoSided::No}, kNothingSkipped).hideBackFaces);

  Camera inside = outside;
  inside.eye = Vec3(0.2, 0, 0), inside.lookAt = Vec3(1, 0, 0);
  EXPECT_FALSE(only(ball, inside, {}).closedFromOutside);
  Camera cutting = outside;  // the near plane opens the sphere
  cutting.near = 4.5;
  EXPECT_FALSE(only(ball, cutting, {}).closedFromOutside);
  Camera beside = outside;  // the near plane passes the sphere, but beside the picture's window
  beside.near = 4.5, beside.fovY = radians(1), beside.lookAt = Vec3(1.5, 0, 0);
  EXPECT_TRUE(only(ball, beside, {}, {.frustum = false, .small = false}).closedFromOutside);
}

TEST(Cull, TwoSidedAndMirroredAreResolved) {
  const Camera camera{.eye = Vec3(0, 1, 5), .fovY = radians(60)};
  EXPECT_FALSE(only({.surface = sphere(1)}, camera, {}).twoSided);
  EXPECT_TRUE(only({.surface = disk(1)}, camera, {}).twoSided);
  EXPECT_TRUE(only({.surface = sphere(1)}, camera, {.twoSided = TwoSided::Yes}).twoSided);
  EXPECT_FALSE(only({.surface = disk(1)}, camera, {.twoSided = TwoSided::No}).twoSided);
  EXPECT_FALSE(only({.surface = sphere(1)}, camera, {}).mirrored);
  EXPECT_TRUE(only({.scale = Vec3(-1, 1, 1), .surface = sphere(1)}, camera, {}).mirrored);
  EXPECT_FALSE(only({.scale = Vec3(-1, 1, -1), .surface = sphere(1)}, camera, {}).mirrored);
}

TEST(Cull, FlatNodesAreSkippedFromBehind) {
  const auto culled = [](const Camera& camera, Node node, TwoSided twoSided = TwoSided::No,
                         CullOptions options = {}) {
    Scene scene;
    node.material = scene.add(Material{.twoSided = twoSided});
    scene.add(std::move(node));
    return cull(takeSnapshot(scene, 0, {100, 100}, camera), options).counts.culledBackface;
  };
  const Node plate{.surface = rectangle(1, 1)};  // faces +Y
  const Camera above{.eye = Vec3(0, 2, 2)}, below{.eye = Vec3(0, -2, 2)}, edgeOn{.eye = Vec3(0, 0, 2)};
  EXPECT_EQ(culled(below, plate), 1u);
  EXPECT_EQ(culled(above, plate), 0u);
  EXPECT_EQ(culled(edgeOn, plate), 0u);
  EXPECT_EQ(culled(below, plate, TwoSided::Auto), 0u);
  EXPECT_EQ(culled(below, plate, TwoSided::No, kNothingSkipped), 0u);
  EXPECT_EQ(culled(below, {.scale = Vec3(1, -1, 1), .surface = rectangle(1, 1)}),
            0u);  // turned over by a mirror
  EXPECT_EQ(culled(above, {.scale = Vec3(1, -1, 1), .surface = rectangle(1, 1)}), 1u);
  EXPECT_EQ(culled(below, {.surface = rectangle(1, 1), .segments = Segments{500, 500}}),
            0u);  // specks may turn over
  Camera map = below;
  map.projection = Projection::Orthographic, map.height = 3;
  EXPECT_EQ(culled(map, plate), 1u);
}

TEST(Cull, FacingIsDecidedLikeTheRasterDoes) {
  test::Random random(26);
  int back = 0, front = 0;
  for (int i = 0; i < 4000; ++i) {
    Scene scene;
    const MaterialId material = scene.add(Material{.twoSided = TwoSided::No});
    scene.add(Node{.translation = random.inCube(2),
                   .rotation = random.rotation(),
                   .scale = random.scale(),
                   .surface = rectangle(2, 1),
                   .material = material});
    const Snapshot snapshot = takeSnapshot(scene, 0, {400, 300}, someCamera(random));
    CullOptions options = kNothingSkipped;
    options.backface = true;
    const bool culled = cull(snapshot, options).counts.culledBackface == 1;
    // The sign of the area on the screen of Su, Sv, mirrored or not: y counts down, so counter-clockwise is
    // negative.
    const SnapshotNode& node = snapshot.nodes[0];
    const Transform place = eyeFromObject(snapshot.view, node.worldFromObject);
    std::array<Vec2, 3> p;
    bool ahead = true;
    for (int k = 0; k < 3; ++k) {
      const Vec3 eye = transformPoint(place, node.surface.position(k == 1, k == 2));
      ahead = ahead && -eye.z > snapshot.view.near;
      p[k] = pixelFromEye(snapshot.view, eye);
    }
    if (!ahead) continue;
    const Vec2 a = p[1] - p[0], b = p[2] - p[0];
    const double counterClockwise = -(a.x * b.y - a.y * b.x) * (mirrors(place) ? -1 : 1);
    ASSERT_FALSE(culled && counterClockwise > 0);
    ++(culled ? back : front);
  }
  EXPECT_GT(back, 300);
  EXPECT_GT(front, 300);
}

TEST(Cull, BoundsThatReachTheEyeKeepEverythingDefined) {
  Scene scene;
  scene.add(Node{.surface = sphere(1)});
  scene.add(Node{.scale = Vec3(1, 0, 1), .surface = sphere(1)});  // flattened
  scene.add(Node{.scale = Vec3(0), .surface = sphere(1)});        // a point at the eye
  scene.add(Node{.light = Light{}});
  const VisibleList list = cull(
      takeSnapshot(scene, 0, kViewSize, Camera{.eye = Vec3(0), .lookAt = Vec3(0, 0, -1)}), kNothingSkipped);
  EXPECT_EQ(list.counts.drawn, 3u);
  for (const VisibleNode& node : list.opaque) {
    EXPECT_GT(node.toleranceObject, 0);
    EXPECT_EQ(node.nearestDepth, 0.1);
    EXPECT_TRUE(std::isfinite(node.centerDepth));
  }
}

}  // namespace
}  // namespace luxo
