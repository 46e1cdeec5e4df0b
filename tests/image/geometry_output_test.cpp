// SPDX-License-Identifier: Apache-2.0
// Auxiliary outputs (depth, position, normal, uv, id) against closed forms, and the debug views made of them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "support/picture.h"
#include "tessellate/tessellator.h"

namespace luxo::test {
namespace {

using GeometryOutput = PictureTest;

constexpr PixelSize kGeometryOutputSize{160, 120};

Image output(Renderer& renderer, const Scene& scene, const Camera& camera, Output what,
             PixelSize size = kGeometryOutputSize) {
  return renderer.render(takeSnapshot(scene, 0, size, camera), {.output = what}).image;
}

TEST_F(GeometryOutput, PlateAt725) {
  Scene scene;
  scene.add(plate(Vec3(0.25, 0, -7.25), {8, 4}, {}));
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    const Camera camera{
        .eye = Vec3(0), .lookAt = Vec3(0, 0, -1), .fovY = radians(50), .projection = projection, .height = 6};
    const CameraModel model(camera, kGeometryOutputSize);
    const Image depth = output(renderer(), scene, camera, Output::Depth);
    const Image position = output(renderer(), scene, camera, Output::Position);
    const Image normal = output(renderer(), scene, camera, Output::Normal);
    const Image uv = output(renderer(), scene, camera, Output::Uv);
    const Image id = output(renderer(), scene, camera, Output::Id);
    ASSERT_EQ(depth.channels(), 1);
    ASSERT_EQ(position.channels(), 3);
    ASSERT_EQ(id.channels(), 1);
    int hit = 0, missed = 0;
    for (int y = 0; y < kGeometryOutputSize.height; ++y)
      for (int x = 0; x < kGeometryOutputSize.width; ++x) {
        const Vec3 p = model.through(centerOf(x, y)).at(7.25);
        const auto inside = settled(
            [&](const Vec2& pixel) {
              const Vec3 q = model.through(pixel).at(7.25) - Vec3(0.25, 0, -7.25);
              return std::abs(q.x) <= 4 && std::abs(q.y) <= 2;
            },
            centerOf(x, y), kSnapPx);
        if (!inside) continue;
        if (*inside) {
          ++hit;
          ASSERT_NEAR(depth.pixel(x, y)[0], 7.25, 1e-5);
          // Vertices snap to 1/256 px of 7.25 / f = 0.06 m.
          const double snap = 7.25 / model.pixelsPerUnit() / 256 + 1e-5;
          ASSERT_TRUE(near(colorAt(position, x, y), p, snap));
          ASSERT_TRUE(near(colorAt(normal, x, y), {0, 0, 1}, 1e-6));
          ASSERT_TRUE(near(colorAt(uv, x, y), {(p.x - 0.25) / 8 + 0.5, p.y / 4 + 0.5, 0}, snap / 4));
          ASSERT_EQ(id.pixel(x, y)[0], 1);
        } else {
          ++missed;
          ASSERT_EQ(depth.pixel(x, y)[0], std::numeric_limits<float>::infinity());
          ASSERT_EQ(colorAt(position, x, y), Vec3(0));
          ASSERT_EQ(colorAt(normal, x, y), Vec3(0));
          ASSERT_EQ(colorAt(uv, x, y), Vec3(0));
          ASSERT_EQ(id.pixel(x, y)[0], 0);
        }
      }
    EXPECT_GT(hit, 3000);
    EXPECT_GT(missed, 1000);
  }
}

struct Body {
  const char* name;
  Surface surface;
  /// Distance of a point from the surface and its outward normal there.
  double (*distance)(const Vec3&);
  Vec3 (*normal)(const Vec3&);
};

const Body kSphere{"sphere", sphere(1.2), [](const Vec3& p) { return std::abs(glm::length(p) - 1.2); },
                   [](const Vec3& p) { return glm::normalize(p); }};

Vec3 ringPoint(const Vec3& p) { return glm::normalize(Vec3(p.x, 0, p.z)); }
const Body kTorusBody{"torus", torus(1, 0.4),
                      [](const Vec3& p) { return std::abs(glm::distance(p, ringPoint(p)) - 0.4); },
                      [](const Vec3& p) { return glm::normalize(p - ringPoint(p)); }};

/// Exactly the parametrisation that is documented: u around +Y from +X toward -Z, v along or around the tube.
Vec3 documentedPoint(const Body& body, const Vec2& uv) {
  const double around = kTau * uv.x;
  const Vec3 radial(std::cos(around), 0, -std::sin(around));
  if (body.surface.name() == "sphere") {
    const double latitude = kPi * (uv.y - 0.5);
    return 1.2 * (std::cos(latitude) * radial + std::sin(latitude) * Vec3(0, 1, 0));
  }
  const double tube = kTau * uv.y;
  return (1 + 0.4 * std::cos(tube)) * radial + 0.4 * std::sin(tube) * Vec3(0, 1, 0);
}

TEST_F(GeometryOutput, CurvedBodies) {
  constexpr Segments kFine{256, 128};
  for (const Body& body : {kSphere, kTorusBody}) {
    Scene scene;
    scene.add(Node{.surface = body.surface, .segments = kFine});
    // The proven distance of the mesh from the surface at equal (u, v), and single precision at 4 m.
    const double bound = deviationBound(body.surface, {}, kFine) + 4e-6;
    // Toward the seam of u (+X), the seam of v, the north pole, the south pole.
    for (const Vec3& eye : {Vec3(4, 0.3, 0.2), Vec3(-2, 1, 3), Vec3(0.1, 4, 0.2), Vec3(0.5, -3.5, -0.5)}) {
      SCOPED_TRACE(testing::Message() << body.name << " seen from x = " << eye.x << ", y = " << eye.y);
      const Camera camera{.eye = eye, .fovY = radians(50)};
      const CameraModel model(camera, kGeometryOutputSize);
      const Image depth = output(renderer(), scene, camera, Output::Depth);
      const Image position = output(renderer(), scene, camera, Output::Position);
      const Image normal = output(renderer(), scene, camera, Output::Normal);
      const Image uv = output(renderer(), scene, camera, Output::Uv);
      int hit = 0;
      for (int y = 0; y < kGeometryOutputSize.height; ++y)
        for (int x = 0; x < kGeometryOutputSize.width; ++x) {
          if (std::isinf(depth.pixel(x, y)[0])) continue;
          ++hit;
          const Vec3 p = colorAt(position, x, y), n = body.normal(p);
          const Vec2 parameters(uv.pixel(x, y)[0], uv.pixel(x, y)[1]);
          ASSERT_LE(body.distance(p), bound) << x << ", " << y;
          // The pixel's own ray: position is where it says it is, to the snap of 1/256 px.
          const double pixel = model.depthOf(p) / model.pixelsPerUnit();
          const double slope = std::max(0.02, glm::dot(n, model.towardViewer(p)));
          ASSERT_LE(glm::distance(model.pixelOf(p), centerOf(x, y)), kSnapPx) << x << ", " << y;
          ASSERT_NEAR(depth.pixel(x, y)[0], model.depthOf(p), 4e-6) << x << ", " << y;
          // Mixed normals of a cell's corners leave the true one by the square of the cell's angle at most.
          const double cell = kTau / kFine.u;
          ASSERT_TRUE(near(colorAt(normal, x, y), n, cell * cell + (bound + pixel / 256 / slope)))
              << x << ", " << y;
          // The bound holds at equal (u, v), so it says how wrong (u, v) can be: nothing jumps at seams or
          // poles.
          ASSERT_LE(glm::distance(documentedPoint(body, parameters), p), bound + pixel / 256 / slope)
              << "(" << parameters.x << ", " << parameters.y << ") at " << x << ", " << y;
        }
      EXPECT_GT(hit, 2000);
    }
  }
}

TEST_F(GeometryOutput, NormalsTurnTowardTheViewerWhereTwoSided) {
  Scene scene;
  scene.add(Node{.surface = rectangle(9, 9)});
  for (const double side : {1.0, -1.0}) {
    const Camera camera{.eye = Vec3(0, 3 * side, 0.5)};
    EXPECT_TRUE(near(colorAt(output(renderer(), scene, camera, Output::Normal), 80, 60), {0, side, 0}, 1e-6));
  }
}

TEST_F(GeometryOutput, IdsCountDepthFirst) {
  // Added breadth first; nodes without a surface count, too.
  Scene scene;
  const NodeId first = scene.add(Node{.name = "1"});
  const NodeId second = scene.add(plate(Vec3(3, 0, 0), Vec2(1), {}));  // 4
  Node child = plate(Vec3(-3, 0, 0), Vec2(1), {});                     // 2
  child.parent = first;
  const NodeId left = scene.add(child);
  Node below = plate(Vec3(0, 0, 3), Vec2(1), {});  // 5: below the right one in its turned axes
  below.parent = second;
  scene.add(below);
  Node grandchild = plate(Vec3(0, 0, 3), Vec2(1), {});  // 3
  grandchild.parent = left;
  scene.add(grandchild);

  const Camera camera{.eye = Vec3(0, 0, 10), .projection = Projection::Orthographic, .height = 12};
  const CameraModel model(camera, kGeometryOutputSize);
  const Image ids = output(renderer(), scene, camera, Output::Id);
  const auto idAt = [&](const Vec3& p) {
    const Vec2 pixel = model.pixelOf(p);
    return ids.pixel(static_cast<int>(pixel.x), static_cast<int>(pixel.y))[0];
  };
  EXPECT_EQ(idAt({-3, 0, 0}), 2);
  EXPECT_EQ(idAt({3, 0, 0}), 4);
  // A plate is turned by 90 degrees about X: what hangs on its +Z is below it, turned twice, and faces down.
  const Camera from{
      .eye = Vec3(0, -10, 0), .up = Vec3(0, 0, 1), .projection = Projection::Orthographic, .height = 12};
  const Image lower = output(renderer(), scene, from, Output::Id);
  const CameraModel lowerModel(from, kGeometryOutputSize);
  const auto lowerIdAt = [&](const Vec3& p) {
    const Vec2 pixel = lowerModel.pixelOf(p);
    return lower.pixel(static_cast<int>(pixel.x), static_cast<int>(pixel.y))[0];
  };
  EXPECT_EQ(lowerIdAt({-3, -3, 0}), 3);
  EXPECT_EQ(lowerIdAt({3, -3, 0}), 5);
}

TEST_F(GeometryOutput, DebugViews) {
  Scene scene;
  scene.set(RenderSettings{.background = {0.25, 0.5, 0.75}});
  scene.add(Node{.surface = sphere(1)});
  scene.add(plate(Vec3(3, 0, -1), {2, 2}, {}));
  const Camera camera{.eye = Vec3(0, 0, 5), .fovY = radians(60)};
  const CameraModel model(camera, kGeometryOutputSize);
  const auto view = [&](Shading shading) {
    return draw(scene, camera, kGeometryOutputSize, {.shading = shading}).image;
  };
  const auto at = [&](const Image& image, const Vec3& p) {
    const Vec2 pixel = model.pixelOf(p);
    return colorAt(image, static_cast<int>(pixel.x), static_cast<int>(pixel.y));
  };
  const Vec3 ball(0, 0, 1), board(3, 0, -1);

  const Image normal = view(Shading::Normal);
  // The centre is a pixel's corner: half a pixel, 0.02 m, turns a normal by 0.02, half of which is seen.
  EXPECT_TRUE(near(at(normal, ball), {0.5, 0.5, 1}, 0.012));
  EXPECT_TRUE(near(at(normal, board), {0.5, 0.5, 1}, 1e-6));

  const Image uv = view(Shading::Uv);
  // Toward +Z u is 3/4; the middle of the ball's height and of the board is 1/2; half a pixel is 0.01 of u.
  EXPECT_TRUE(near(at(uv, ball), {0.75, 0.5, 0}, 0.012));
  EXPECT_TRUE(near(at(uv, board), {0.5, 0.5, 0}, 0.02));

  const Image depth = view(Shading::Depth);
  EXPECT_GT(at(depth, ball).x, at(depth, board).x + 0.1);  // nearer is brighter
  EXPECT_LE(at(depth, ball).x, 1);

  const Image id = view(Shading::Id);
  EXPECT_GT(glm::distance(at(id, ball), at(id, board)), 0.2);

  for (const Image* image : {&normal, &uv, &depth, &id}) {
    EXPECT_TRUE(allFinite(*image));
    EXPECT_EQ(colorAt(*image, 0, 0), Vec3(0.25, 0.5, 0.75));
  }
}

TEST_F(GeometryOutput, WireframeIsTheEdges) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0)});
  Node node = plate(Vec3(0), {2, 2}, scene.add(Material{.diffuse = Vec3(1)}));
  node.segments = Segments{2, 2};
  scene.add(node);
  const Camera camera{.eye = Vec3(0, 0, 3), .projection = Projection::Orthographic, .height = 3};
  const CameraModel model(camera, kGeometryOutputSize);
  const Image image = draw(scene, camera, kGeometryOutputSize, {.shading = Shading::Wireframe}).image;
  int edge = 0;
  for (int y = 0; y < kGeometryOutputSize.height; ++y)
    for (int x = 0; x < kGeometryOutputSize.width; ++x) {
      const Vec3 p = model.through(centerOf(x, y)).at(3);
      // The edges: x or y in {-1, 0, 1}, and each cell's diagonal from its lower left corner.
      const double metre = 1 / model.pixelsPerUnit();
      const bool within = std::max(std::abs(p.x), std::abs(p.y)) <= 1 + metre;
      const double toGrid = std::min(std::abs(p.x - std::round(p.x)), std::abs(p.y - std::round(p.y)));
      const double d = p.x - p.y, toDiagonal = std::abs(d - std::round(d)) / std::sqrt(2.0);
      const bool lit = colorAt(image, x, y) != Vec3(0);
      edge += lit;
      ASSERT_TRUE(!lit || (within && std::min(toGrid, toDiagonal) <= metre)) << x << ", " << y;
    }
  // Six lines of 80 pixels and four half diagonals of 40 columns at least, each pixel counted once or twice.
  EXPECT_GE(edge, 6 * 80 + 4 * 40 - 40);
  EXPECT_LE(edge, 3 * (6 * 80 + 4 * 40));
}

/// A sheet of wires, 4 x 4 metres, one metre a cell, white.
Node sheet(Scene& scene, double z) {
  Node node =
      plate(Vec3(0, 0, z), {4, 4}, scene.add(Material{.diffuse = Vec3(1), .shading = Shading::Wireframe}));
  node.segments = Segments{4, 4};
  return node;
}

Camera above() {
  return {.eye = Vec3(0.3, 0.2, 6),
          .lookAt = Vec3(0.3, 0.2, 0),
          .projection = Projection::Orthographic,
          .height = 2.4};
}

int litPixels(const Image& image, const Vec3& color) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) count += near(colorAt(image, x, y), color, 1e-6) ? 1 : 0;
  return count;
}

// The far sheet is half a cell aside: none of its lines along x or y is where one of the near sheet is.
TEST_F(GeometryOutput, WiresHideTheLinesBehindThem) {
  for (const int samples : {1, 4}) {
    const DrawOptions hiding{.shading = Shading::Wireframe, .samples = samples};
    DrawOptions showing = hiding;
    showing.hiddenLines = true;
    Scene nearSheet, both;
    for (Scene* scene : {&nearSheet, &both}) scene->set(RenderSettings{.background = Vec3(0)});
    nearSheet.add(sheet(nearSheet, 0));
    Node far = sheet(both, -2);
    far.translation = Vec3(0.5, 0.5, -2);
    both.add(far);
    both.add(sheet(both, 0));
    const Image alone = draw(nearSheet, above(), kGeometryOutputSize, hiding).image;
    EXPECT_TRUE(sameBytes(draw(both, above(), kGeometryOutputSize, hiding).image, alone)) << samples;
    const Image shown = draw(both, above(), kGeometryOutputSize, showing).image;
    EXPECT_FALSE(sameBytes(shown, alone)) << samples;
    if (samples == 1) {
      EXPECT_GT(litPixels(shown, Vec3(1)), 5 * litPixels(alone, Vec3(1)) / 4);
    }
    EXPECT_TRUE(sameBytes(draw(nearSheet, above(), kGeometryOutputSize, showing).image, alone))
        << "its own lines all show";
  }
}

// Lines of a steep sheet are whole: what hides lines does not hide those of its own triangles.
TEST_F(GeometryOutput, SteepWiresAreWhole) {
  for (const double height : {0.5, 2.0, 8.0, 30.0}) {
    Scene scene;
    scene.set(RenderSettings{.background = Vec3(0)});
    scene.add(sheet(scene, 0));
    const Camera aslant{.eye = Vec3(0.2, -10, height), .lookAt = Vec3(0)};
    const DrawOptions hiding{.shading = Shading::Wireframe};
    DrawOptions showing = hiding;
    showing.hiddenLines = true;
    const Image image = draw(scene, aslant, kGeometryOutputSize, hiding).image;
    EXPECT_GT(litPixels(image, Vec3(1)), 50) << height;
    EXPECT_TRUE(sameBytes(image, draw(scene, aslant, kGeometryOutputSize, showing).image)) << height;
  }
}

TEST_F(GeometryOutput, WiresHideNothingButLines) {
  Scene scene;
  scene.set(plainSettings());
  scene.add(plate(Vec3(0, 0, -1), {8, 8}, scene.add(glowing({0, 0.5, 0}))));
  scene.add(sheet(scene, 0));
  scene.add(sheet(scene, -2));
  const Image image = draw(scene, above(), kGeometryOutputSize, {.shading = Shading::Phong}).image;
  const int lines = litPixels(image, Vec3(1)), body = litPixels(image, {0, 0.5, 0});
  EXPECT_EQ(lines + body, kGeometryOutputSize.width * kGeometryOutputSize.height)
      << "the solid plate is seen between the near wires";
  EXPECT_GT(lines, 100);
}

}  // namespace
}  // namespace luxo::test
