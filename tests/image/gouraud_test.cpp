// SPDX-License-Identifier: Apache-2.0
// Gouraud shading: the formula at the vertices, and between them the perspective-correct barycentric mix.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "support/picture.h"
#include "tessellate/tessellator.h"

namespace luxo::test {
namespace {

using Gouraud = PictureTest;

const Material kEnamel{
    .diffuse = {0.6, 0.4, 0.2}, .ambient = Vec3(0.1), .specular = Vec3(0.5), .shininess = 12};
const Vec3 kAmbient(0.2);
const std::array kLights{Shine{.position = {2, 3, 4, 1}, .radiance = {0.8, 0.7, 0.6}},
                         Shine{.position = {-3, 1, 2, 0}, .radiance = {0.2, 0.2, 0.4}}};

Scene litScene(Node node) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0), .ambient = kAmbient});
  node.material = scene.add(kEnamel);
  scene.add(std::move(node));
  for (const Shine& light : kLights) addLight(scene, light);
  return scene;
}

TEST_F(Gouraud, VertexPixelsAreTheFormula) {
  // One pixel is 1/16 m and cells are half a metre: every inner vertex lies on a pixel's centre.
  constexpr PixelSize kSize{65, 65};
  const Camera camera{.eye = Vec3(0, 0, 6), .projection = Projection::Orthographic, .height = 65.0 / 16};
  Node node = plate(Vec3(0), {3, 3}, {});
  node.segments = Segments{6, 6};
  const Image image = draw(litScene(node), camera, kSize, {.shading = Shading::Gouraud}).image;
  const CameraModel model(camera, kSize);
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      const Vec3 vertex(0.5 * i, 0.5 * j, 0);
      const Vec2 pixel = model.pixelOf(vertex);
      ASSERT_EQ(pixel, centerOf(32 + 8 * i, 32 - 8 * j));
      const Vec3 formula =
          blinnPhong(kEnamel, kAmbient, kLights, vertex, {0, 0, 1}, model.towardViewer(vertex));
      EXPECT_TRUE(near(colorAt(image, 32 + 8 * i, 32 - 8 * j), formula, 1e-5)) << i << ", " << j;
    }
}

/// Barycentric coordinates of the plane point under a ray, and its depth.
struct TriangleHit {
  Vec3 weights{0};
  double depth = 0;
};

TriangleHit meet(const Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 solution = glm::inverse(Mat3(b - a, c - a, -ray.direction)) * (ray.origin - a);
  return {{1 - solution.x - solution.y, solution.x, solution.y}, solution.z};
}

TEST_F(Gouraud, InteriorIsThePerspectiveCorrectMix) {
  // A tilted plate close to the eye (depths 1.5 to 4.5) and a coarse ball: the mix over a triangle differs
  // from the formula in its inside, so only the right interpolation of the right vertices gives these values.
  constexpr PixelSize kSize{80, 80};
  Node tilted = plate(Vec3(0), {3, 3}, {});
  tilted.rotation = Rotation{{1, 0, 0}, radians(30)};
  tilted.segments = Segments{2, 2};
  Node coarse{.surface = sphere(1), .segments = Segments{8, 5}};
  const Camera camera{.eye = Vec3(0.3, 0.5, 3), .fovY = radians(50)};
  const CameraModel model(camera, kSize);

  for (const Node& node : {tilted, coarse}) {
    const Image image = draw(litScene(node), camera, kSize, {.shading = Shading::Gouraud}).image;
    const Mesh mesh = tessellate(node.surface, {}, {.uniform = node.segments});
    const Rotation turn = node.rotation.at(0);
    const Mat3 worldFromObject = rotation(turn.axis, turn.angle);
    std::vector<Vec3> places, colors;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      places.push_back(worldFromObject * mesh.positions[i]);
      colors.push_back(blinnPhong(kEnamel, kAmbient, kLights, places[i], worldFromObject * mesh.normals[i],
                                  model.towardViewer(places[i])));
    }
    int compared = 0;
    for (int y = 0; y < kSize.height; ++y)
      for (int x = 0; x < kSize.width; ++x) {
        const Ray ray = model.through(centerOf(x, y));
        double nearest = std::numeric_limits<double>::infinity();
        Vec3 mix(0);
        bool atEdge = false;
        for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
          const auto* k = &mesh.indices[t];
          const TriangleHit hit = meet(ray, places[k[0]], places[k[1]], places[k[2]]);
          const double least = std::min({hit.weights.x, hit.weights.y, hit.weights.z});
          // A pixel this close to an edge may be drawn from the triangle beyond it.
          if (std::abs(least) < 0.01) atEdge = true;
          if (!(least >= 0 && hit.depth < nearest)) continue;
          nearest = hit.depth;
          mix = hit.weights.x * colors[k[0]] + hit.weights.y * colors[k[1]] + hit.weights.z * colors[k[2]];
        }
        if (atEdge || std::isinf(nearest)) continue;
        ++compared;
        // Vertices snapped by 1/256 px move the mix by its slope: below 0.02 per pixel here.
        ASSERT_TRUE(near(colorAt(image, x, y), mix, 0.02 / 256 + tolerance(1e-5, 1e-4))) << x << ", " << y;
      }
    EXPECT_GT(compared, 1000);
  }
}

}  // namespace
}  // namespace luxo::test
