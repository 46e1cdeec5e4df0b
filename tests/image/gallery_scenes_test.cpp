// SPDX-License-Identifier: Apache-2.0
// Scenes of the gallery whose pictures are known: the two colours of the blue teapot, the one shape of the
// four generations, the outlines of the cartoon, the border of the verdigris.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "reference/reference.h"
#include "scene/scene_builder.h"
#include "scenes/gallery.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

using GalleryScenes = PictureTest;

SceneFile describedScene(std::string_view name) {
  const auto scenes = galleryScenes();
  return galleryDescription(*std::ranges::find(scenes, name, &EmbeddedScene::name));
}

// The course's first picture: one colour and white. Where it is blue, rays in double meet the pot.
TEST_F(GalleryScenes, TheBlueTeapotHasTwoColours) {
  constexpr PixelSize kSize{160, 90};
  const Scene scene = buildScene(describedScene("gallery/blue_teapot"));
  const Image image = draw(scene, kSize).image;
  const auto truth = castPicture(takeSnapshot(scene, 0, kSize), {});
  int blue = 0;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      const bool met = std::isfinite(truth.depth[static_cast<std::size_t>(y * kSize.width + x)]);
      ASSERT_EQ(colorAt(image, x, y), met ? Vec3(0, 0, 1) : Vec3(1)) << x << ", " << y;
      blue += met;
    }
  EXPECT_GT(blue, 2000);
  EXPECT_LT(blue, 8000);
}

// The camera is parallel and pots are half a picture apart: what is covered of each quarter differs by what
// triangles are off.
TEST_F(GalleryScenes, TheFourGenerationsHaveOneShape) {
  constexpr int kWide = 96, kHigh = 54;
  SceneFile description = describedScene("gallery/generations");
  description.render.background = repeated(0);
  const Scene scene = buildScene(description);
  const DrawOptions options = drawOptions(scene.settings());
  const Image image =
      draw(scene, {2 * kWide, 2 * kHigh}, {.shading = options.shading, .tolerancePx = options.tolerancePx})
          .image;
  const auto covered = [&](int quarter, int x, int y) {
    return colorAt(image, x + quarter % 2 * kWide, y + quarter / 2 * kHigh) != Vec3(0);
  };
  // Of the programmed one, which is exact: what is the same in all pixels nearer than triangles may be off,
  // and half a line.
  const int margin = static_cast<int>(std::ceil(options.tolerancePx)) + 1;
  const auto settledAt = [&](int x, int y) -> std::optional<bool> {
    const bool first = covered(3, x, y);
    for (int dy = -margin; dy <= margin; ++dy)
      for (int dx = -margin; dx <= margin; ++dx)
        if (covered(3, x + dx, y + dy) != first) return std::nullopt;
    return first;
  };
  int inside = 0, outside = 0, holes = 0;
  for (int y = margin; y < kHigh - margin; ++y)
    for (int x = margin; x < kWide - margin; ++x) {
      const auto pot = settledAt(x, y);
      if (!pot) continue;
      ASSERT_EQ(covered(1, x, y), *pot) << "solid: " << x << ", " << y;
      ASSERT_EQ(covered(2, x, y), *pot) << "textured: " << x << ", " << y;
      ++(*pot ? inside : outside);
      holes += *pot && !covered(0, x, y);
      ASSERT_FALSE(!*pot && covered(0, x, y)) << "wireframe: " << x << ", " << y;
    }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 1000);
  EXPECT_GT(holes, inside / 20) << "one sees through the wires";
  EXPECT_LT(holes, inside);
}

// Without light and with one paint, that of the background too, all there is to see is ink: outlines of three
// balls at 10, 19 and 48 metres, each 2 px wide, and none on the floor, which goes on to the horizon.
TEST_F(GalleryScenes, TheCartoonsOutlinesAreAsWideNearAndFar) {
  constexpr PixelSize kSize{640, 360};
  const Vec3 paint(0.8, 0.6, 0.4);
  SceneFile description = describedScene("gallery/toon");
  for (MaterialDesc& material : description.materials) material.diffuse = {paint.x, paint.y, paint.z};
  std::erase_if(description.nodes, [](const NodeDesc& node) {
    return node.name.text == "hill" || node.name.text == "mountain" || node.name.text == "pot" ||
           node.name.text == "sun";
  });
  Scene scene = buildScene(description);
  RenderSettings settings = scene.settings();
  settings.background = 0.5 * paint;
  scene.set(settings);
  const Snapshot snapshot = takeSnapshot(scene, 0, kSize);
  const CameraModel camera(scene.cameras().front(), kSize);
  const Vec3 eye = scene.cameras().front().eye.at(0);
  for (const int samples : {1, 4}) {
    const Image image = draw(scene, kSize, {.shading = settings.shading, .samples = samples}).image;
    const auto inkAt = [&](int x, int y) { return 1 - colorAt(image, x, y).y / (0.5 * paint.y); };
    std::vector<bool> outlined(static_cast<std::size_t>(kSize.width * kSize.height));
    for (const SnapshotNode& node : snapshot.nodes) {
      if (node.surface.flatNormal()) continue;
      // Where rays from the eye touch the ball: a circle around the way to its centre.
      const Vec3 center = node.worldFromObject.translation, way = center - eye;
      const double distance = glm::length(way), cosine = 1 / distance, sine = std::sqrt(1 - cosine * cosine);
      const Vec3 back = -way / distance, side = glm::normalize(glm::cross(back, Vec3(0, 1, 0))),
                 up = glm::cross(side, back);
      std::vector<Vec2> contour;
      for (int i = 0; i < 180; ++i) {
        const double angle = kTau * i / 180;
        contour.push_back(
            camera.pixelOf(center + cosine * back + sine * (std::cos(angle) * side + std::sin(angle) * up)));
      }
      double length = 0;
      for (std::size_t i = 0; i < contour.size(); ++i)
        length += glm::length(contour[(i + 1) % contour.size()] - contour[i]);
      double ink = 0;
      const auto [left, right] = std::ranges::minmax(contour, {}, &Vec2::x);
      const auto [top, bottom] = std::ranges::minmax(contour, {}, &Vec2::y);
      for (int y = static_cast<int>(top.y) - 6; y < bottom.y + 6; ++y)
        for (int x = static_cast<int>(left.x) - 6; x < right.x + 6; ++x)
          if (std::ranges::any_of(contour,
                                  [&](const Vec2& at) { return glm::length(at - centerOf(x, y)) < 6; })) {
            ink += inkAt(x, y);
            outlined[static_cast<std::size_t>(y * kSize.width + x)] = true;
          }
      // The middle of the outline is a pixel within the edge of the ball.
      EXPECT_NEAR(ink / (length - kTau), 2, 0.5) << distance << " m, samples " << samples;
    }
    for (int y = 0; y < kSize.height; ++y)
      for (int x = 0; x < kSize.width; ++x)
        if (!outlined[static_cast<std::size_t>(y * kSize.width + x)]) {
          ASSERT_NEAR(inkAt(x, y), 0, 1e-6) << x << ", " << y << ", samples " << samples;
        }
  }
}

// A point beside a wall sees the part of the sky that is not toward it; green ends where that is `age` of
// all.
TEST_F(GalleryScenes, VerdigrisEndsWhereTheSkyIsOpenEnough) {
  constexpr PixelSize kSize{160, 120};
  constexpr double kRadius = 1, kSky = 0.8, kAge = 0.8;
  Scene scene;
  const MaterialId bronze = scene.add(Material{.twoSided = TwoSided::Yes,
                                               .shader = galleryShaderFiles()->get("occlusion.frag"),
                                               .uniforms = {{"sky", {kSky}},
                                                            {"age", {kAge}},
                                                            {"uneven", {0}},
                                                            {"bronze", {1, 0, 0}},
                                                            {"verdigris", {0, 1, 0}}}});
  scene.add(Node{.surface = rectangle(40, 40), .material = bronze});
  scene.add(plate(Vec3(0, 10, -2), {40, 20}, bronze));
  RenderSettings settings = plainSettings();
  settings.ambient = Vec3(kSky);
  settings.ambientOcclusion = {.radius = kRadius};
  scene.set(settings);
  const Camera camera{.eye = Vec3(1, 3, 5), .lookAt = Vec3(0, 0, -0.5), .fovY = radians(40), .near = 0.1};
  const Image image = draw(scene, camera, kSize).image;
  // A direction meets the wall at a distance d within the radius if its part toward it is at least c = d /
  // radius: a segment of the disc that the cosine makes of the half sphere.
  const auto open = [](double c) { return 1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / kPi; };
  double border = 0, high = 1;
  while (high - border > 1e-9) (open((border + high) / 2) < kAge ? border : high) = (border + high) / 2;
  const CameraModel model(camera, kSize);
  int columns = 0;
  double off = 0;
  for (int x = 20; x < kSize.width - 20; ++x) {
    double last = -1;
    for (int y = 0; y < kSize.height; ++y) {
      const Ray ray = model.through(centerOf(x, y));
      const Vec3 point = ray.at(*hitPlane(ray, Vec3(0), Vec3(0, 1, 0)));
      const double distance = point.z + 2;
      if (distance <= 0 || point.y < -1e-9) continue;
      const Vec3 color = colorAt(image, x, y);
      const double green = color.y / (color.x + color.y);
      if (distance > kRadius) {
        ASSERT_EQ(green, 0) << x << ", " << y;
      }
      if (green >= 0.5) last = distance;
    }
    ASSERT_GE(last, 0) << x;
    off += last / kRadius - border;
    ++columns;
  }
  EXPECT_NEAR(off / columns, 0, 0.1);
}

}  // namespace
}  // namespace luxo::test
