// SPDX-License-Identifier: Apache-2.0
// Legal but extreme: lights and eyes inside things, flattened nodes, and scenes far away, tiny or huge.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/picture.h"
#include "tessellate/tessellator.h"

namespace luxo::test {
namespace {

using Extremes = PictureTest;

constexpr PixelSize kExtremesSize{128, 96};
constexpr std::array kShadings{Shading::Flat, Shading::Gouraud, Shading::Phong, Shading::Exact};

TEST_F(Extremes, LightInsideABallDoesNotLeakOut) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0.2)});
  const Material material{.diffuse = {0.6, 0.4, 0.2}};
  scene.add(Node{.surface = sphere(1), .material = scene.add(material)});
  addLight(scene, {.position = {0.2, 0.1, -0.3, 1}, .inverseSquare = true});
  const Vec3 ambient = 0.2 * material.diffuse;
  for (const Shading shading : kShadings) {
    const Image image = draw(scene, Camera{.eye = Vec3(1, 2, 3)}, kExtremesSize, {.shading = shading}).image;
    for (int y = 0; y < kExtremesSize.height; ++y)
      for (int x = 0; x < kExtremesSize.width; ++x) {
        const Vec3 color = colorAt(image, x, y);
        ASSERT_TRUE(color == Vec3(0) || near(color, ambient, 1e-6)) << nameOf(shading) << x << ", " << y;
      }
  }
}

TEST_F(Extremes, EyeInsideABallSeesItsWallEverywhere) {
  constexpr Segments kFine{256, 128};
  const Vec3 eye(0.2, -0.3, 0.4);
  for (const double mirror : {1.0, -1.0})
    for (const bool fine : {true, false}) {
      Scene scene;
      scene.set(plainSettings());
      Node node{.scale = Vec3(mirror, 1, 1), .surface = sphere(2), .material = scene.add(glowing({0, 1, 0}))};
      if (fine) node.segments = kFine;
      scene.add(node);
      const Camera camera{.eye = eye, .lookAt = Vec3(1, 0, 0), .fovY = radians(100)};
      const Snapshot snapshot = takeSnapshot(scene, 0, kExtremesSize, camera);
      for (const Shading shading : kShadings) {
        const Image color = renderer().render(snapshot, {.shading = shading}).image;
        for (int y = 0; y < kExtremesSize.height; ++y)
          for (int x = 0; x < kExtremesSize.width; ++x)
            ASSERT_TRUE(near(colorAt(color, x, y), {0, 1, 0}, 1e-6));
      }
      if (!fine) continue;
      const Image depth = renderer().render(snapshot, {.output = Output::Depth}).image;
      const CameraModel model(camera, kExtremesSize);
      const double bound = deviationBound(sphere(2), {}, kFine);
      for (int y = 0; y < kExtremesSize.height; ++y)
        for (int x = 0; x < kExtremesSize.width; ++x) {
          const Ray ray = model.through(centerOf(x, y));
          // The wall is met at 60 degrees or more: cos of it 0.85 at least, and the ray is up to 1.9 long a
          // metre of depth; either way an error of the wall grows less than twofold.
          ASSERT_NEAR(depth.pixel(x, y)[0], hitSphere(ray, Vec3(0), 2)->second, 2 * bound + 1e-5);
        }
    }
}

TEST_F(Extremes, FlattenedNodesAreFinite) {
  for (const Vec3& scale : {Vec3(0, 1, 1), Vec3(1, 0, 1), Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0)})
    for (const Shading shading : kShadings) {
      Scene scene;
      scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0.2)});
      const NodeId flat = scene.add(Node{.rotation = Rotation{{1, 1, 0}, 0.4}, .scale = scale});
      for (Surface surface : {sphere(1), torus(1, 0.3), paraboloid(0.2, 1), rectangle(1, 2), cylinder(1, 1)})
        scene.add(Node{.parent = flat, .surface = std::move(surface)});
      addLight(scene, {.position = {1, 2, 3, 1}});
      const Camera camera{.eye = Vec3(2, 3, 4)};
      EXPECT_TRUE(allFinite(draw(scene, camera, kExtremesSize, {.shading = shading}).image))
          << scale.x << scale.y << scale.z << " " << nameOf(shading);
      const Image normals = draw(scene, camera, kExtremesSize, {.output = Output::Normal}).image;
      EXPECT_TRUE(allFinite(normals)) << scale.x << scale.y << scale.z;
      // What is flattened once is a disk, and seen.
      const bool isDisk = scale.x + scale.y + scale.z == 2;
      EXPECT_EQ(std::ranges::any_of(normals.samples(), [](float number) { return number != 0; }), isDisk)
          << scale.x << scale.y << scale.z;
    }
}

TEST_F(Extremes, FlattenedBallIsADiskWithItsNormal) {
  Scene scene;
  scene.add(Node{.scale = Vec3(1, 0, 1), .surface = sphere(1), .segments = Segments{64, 32}});
  const Camera camera{.eye = Vec3(0, 4, 0.5), .lookAt = Vec3(0)};
  const CameraModel model(camera, kExtremesSize);
  const Image normal = draw(scene, camera, kExtremesSize, {.output = Output::Normal}).image;
  int hit = 0;
  for (int y = 0; y < kExtremesSize.height; ++y)
    for (int x = 0; x < kExtremesSize.width; ++x) {
      const Ray ray = model.through(centerOf(x, y));
      const Vec3 p = ray.at(*hitPlane(ray, Vec3(0), {0, 1, 0}));
      if (glm::length(p) > 0.99) continue;
      ++hit;
      // Upper and lower half lie in one plane: either may be seen, and its normal is straight up or down.
      ASSERT_TRUE(near(glm::abs(colorAt(normal, x, y)), {0, 1, 0}, 1e-6)) << x << ", " << y;
    }
  EXPECT_GT(hit, 300);
}

TEST_F(Extremes, NormalsOfUnevenlyScaledNodes) {
  // N = (1, 1, 0) / sqrt 2 under diag(2, 1, 1): tangent (1, -1, 0) becomes (2, -1, 0), so N' is along (1, 2,
  // 0).
  Scene scene;
  const NodeId uneven = scene.add(Node{.scale = Vec3(2, 1, 1)});
  scene.add(Node{.parent = uneven,
                 .rotation = turning({0, 1, 0}, glm::normalize(Vec3(1, 1, 0))),
                 .surface = rectangle(2, 2)});
  const Camera camera{.eye = Vec3(2, 4, 0.3)};
  const Image normal = draw(scene, camera, kExtremesSize, {.output = Output::Normal}).image;
  EXPECT_TRUE(near(colorAt(normal, 64, 48), glm::normalize(Vec3(1, 2, 0)), 1e-6));

  // An ellipsoid with half axes 3, 1 and 1/2: its gradient.
  Scene egg;
  egg.add(Node{.scale = Vec3(3, 1, 0.5), .surface = sphere(1), .segments = Segments{512, 256}});
  const Camera from{.eye = Vec3(3, 4, 5)};
  const Image normals = draw(egg, from, kExtremesSize, {.output = Output::Normal}).image;
  const Image positions = draw(egg, from, kExtremesSize, {.output = Output::Position}).image;
  int hit = 0;
  for (int y = 0; y < kExtremesSize.height; ++y)
    for (int x = 0; x < kExtremesSize.width; ++x) {
      const Vec3 p = colorAt(positions, x, y);
      if (p == Vec3(0)) continue;
      ++hit;
      // Cells of 1/81 rad: normals mixed across one are off by the square of its angle, stretched up to
      // 6-fold.
      ASSERT_TRUE(near(colorAt(normals, x, y), glm::normalize(p / Vec3(9, 1, 0.25)), 36 / (81.0 * 81.0)));
    }
  EXPECT_GT(hit, 300);
}

/// Everything in it is a multiple of 1/16, its size is a factor, and it stands at `origin`.
struct Diorama {
  Scene scene;
  Camera camera;
};

Diorama diorama(double size, const Vec3& origin) {
  Diorama d;
  Scene& scene = d.scene;
  scene.set(RenderSettings{.background = {0.1, 0.1, 0.2}, .ambient = Vec3(0.2)});
  const MaterialId shiny = scene.add(Material{.diffuse = {0.6, 0.3, 0.1}, .specular = Vec3(0.5)});
  const MaterialId glass = scene.add(Material{.diffuse = {0.2, 0.3, 0.7}, .opacity = 0.5});
  const auto place = [&](const Vec3& at, const Rotation& turn, Surface surface, MaterialId material) {
    scene.add(Node{.translation = origin + size * at,
                   .rotation = turn,
                   .surface = std::move(surface),
                   .material = material});
  };
  place({-2, 0.25, 0}, {{1, 2, 0}, 0.7}, torus(0.75 * size, 0.25 * size), shiny);
  place({0.5, 0, -1}, {}, sphere(0.875 * size), shiny);
  place({2, -0.75, 0}, {{1, 0, 1}, 0.6}, paraboloid(0.25 * size, 1.5 * size), shiny);
  place({1, 0.25, 1.25}, {}, sphere(0.5 * size), glass);
  place({0, -1, 0}, {}, rectangle(8 * size, 5 * size), shiny);
  scene.add(Node{.translation = origin + size * Vec3(-2, 4, 3), .light = Light{.intensity = 0.75}});
  scene.add(
      Node{.translation = origin + size * Vec3(3, 2, 1),
           .light = Light{.intensity = 4 * size * size, .attenuation = Light::Attenuation::InverseSquare}});
  scene.add(Node{.rotation = Rotation{{1, 0.5, 0}, -0.8},
                 .light = Light{.type = Light::Type::Directional, .intensity = 0.25}});
  d.camera = {.eye = origin + size * Vec3(1.5, 2, 6),
              .lookAt = origin + size * Vec3(0.25, 0, 0),
              .fovY = radians(40),
              .near = 0.125 * size};
  return d;
}

TEST_F(Extremes, FarFromTheOriginIsTheSamePicture) {
  // 2^23 m, and a distance like that to the Moon: all sums with it are exact in double.
  const Diorama here = diorama(1, Vec3(0));
  for (const double far : {0x1p23, 0x1p28}) {
    const Diorama there = diorama(1, Vec3(far, -far, 2 * far));
    for (const Shading shading : kShadings)
      EXPECT_TRUE(sameBytes(draw(there.scene, there.camera, kExtremesSize, {.shading = shading}).image,
                            draw(here.scene, here.camera, kExtremesSize, {.shading = shading}).image))
          << far << " m, " << nameOf(shading);
    EXPECT_TRUE(sameBytes(draw(there.scene, there.camera, kExtremesSize, {.output = Output::Depth}).image,
                          draw(here.scene, here.camera, kExtremesSize, {.output = Output::Depth}).image));
  }
}

TEST_F(Extremes, AnySizeIsTheSamePicture) {
  const Diorama normal = diorama(1, Vec3(0));
  for (const int power : {-20, 20}) {
    const Diorama scaled = diorama(std::ldexp(1.0, power), Vec3(0));
    for (const Shading shading : kShadings) {
      const Image image = draw(scaled.scene, scaled.camera, kExtremesSize, {.shading = shading}).image;
      EXPECT_TRUE(allFinite(image));
      EXPECT_TRUE(
          sameBytes(image, draw(normal.scene, normal.camera, kExtremesSize, {.shading = shading}).image))
          << "2^" << power << ", " << nameOf(shading);
    }
  }
}

// A formula may lie far from its node's origin: single precision holds its mesh relative to its own middle.
TEST_F(Extremes, AFarFormulaIsAsSharpAsANearOne) {
  constexpr double kFar = 0x1p24;  // single precision counts in metres there; double in 4e-9
  const auto pictureAt = [&](double offset) {
    Scene scene;
    scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0.2)});
    const Surface saddle =
        surface([=](auto u, auto v) { return point(offset + u, u * v, v); }, {{-1, 1}, {-1, 1}});
    scene.add(Node{.surface = saddle,
                   .material = scene.add(Material{.diffuse = {0.6, 0.4, 0.2}}),
                   .segments = Segments{24, 24}});
    addLight(scene, {.position = {offset + 1, 4, 2, 1}});
    const Camera camera{.eye = Vec3(offset + 1, 2, 3), .lookAt = Vec3(offset, 0, 0)};
    return draw(scene, camera, kExtremesSize, {.shading = Shading::Phong}).image;
  };
  const Image near = pictureAt(0), far = pictureAt(kFar);
  for (int y = 0; y < kExtremesSize.height; ++y)
    for (int x = 0; x < kExtremesSize.width; ++x)
      ASSERT_LT(glm::length(colorAt(near, x, y) - colorAt(far, x, y)), 1e-4) << x << ", " << y;
}

}  // namespace
}  // namespace luxo::test
