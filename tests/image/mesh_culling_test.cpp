// SPDX-License-Identifier: Apache-2.0
// What is left out of meshes changes no bit of a picture: closed and open, seen from outside, from within
// and from near, mirrored, cut out, seen through, in the shadow of each other, in every shading and output.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "image/compare.h"
#include "support/meshes.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kCullingSize{160, 120};

class MeshCulling : public VerifiedPictureTest {
 protected:
  /// The meshes are made once: they have some thousand triangles.
  MeshCulling() : random_(17) {
    meshes_ = {icosphere(4), meshOf(torus(0.7, 0.25), 4e-4), soup(random_, 4000, 0.15),
               meshOf(paraboloid(0.3, 1), 2e-4)};
  }

  double any(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 anywhere(double half) { return {any(-half, half), any(-half, half), any(-half, half)}; }
  bool oneIn(int n) { return random_() % static_cast<unsigned>(n) == 0; }

  Material anyMaterial() {
    Material material{.diffuse = Vec3(any(0.2, 1), any(0.2, 1), any(0.2, 1))};
    const auto kind = random_() % 5;
    if (kind == 0) material.twoSided = TwoSided::No;
    if (kind == 1) material.twoSided = TwoSided::Yes;
    if (kind == 2) material.opacity = any(0.3, 0.8);
    if (kind == 3) material = cutOut(material);
    return material;
  }
  Material cutOut(Material material) {
    Image alpha(8, 8, 4);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        std::ranges::fill(alpha.pixel(x, y), 1.0f);
        alpha.pixel(x, y)[3] = (x + y) % 3 ? 1.0f : 0.2f;
      }
    material.map = {.texture = std::make_shared<const Texture>(makeTexture(alpha, "holes"))};
    material.mapOpacity = true;
    material.cutoff = 0.5;
    return material;
  }

  Scene anyScene(bool shadows) {
    Scene scene;
    const int nodes = 2 + int(random_() % 3);
    for (int i = 0; i < nodes; ++i) {
      const double mirror = oneIn(3) ? -1 : 1;
      scene.add(Node{.translation = anywhere(0.8),
                     .rotation = Rotation{anywhere(1) + Vec3(0, 0, 0.01), any(0, 6)},
                     .scale = Vec3(mirror * any(0.3, 1.2), any(0.3, 1.2), any(0.3, 1.2)),
                     .surface = meshes_[random_() % meshes_.size()],
                     .material = scene.add(anyMaterial())});
    }
    scene.add(Node{
        .translation = Vec3(3, 5, 4),
        .light = Light{.intensity = 0.7, .shadow = shadows ? Light::Shadow::Exact : Light::Shadow::None}});
    scene.add(Node{.rotation = Rotation{{1, 0.4, 0}, -0.9},
                   .light = Light{.type = Light::Type::Directional, .intensity = 0.4}});
    Camera camera{.eye = any(0.1, 4) * unit(anywhere(1)), .lookAt = anywhere(0.7), .near = 0.02};
    camera.fovY = radians(any(20, 90));
    if (oneIn(4)) {
      camera.projection = Projection::Orthographic;
      camera.height = any(0.5, 4);
    }
    scene.add(camera);
    return scene;
  }

  std::mt19937 random_;
  std::vector<TriangleMesh> meshes_;
};

TEST_F(MeshCulling, NoSkipChangesABit) {
  FrameCounts left;
  int shown = 0;
  for (int i = 0; i < 48; ++i) {
    const std::array shadings{Shading::Phong, Shading::Exact,     Shading::Flat,  Shading::Gouraud,
                              Shading::Toon,  Shading::Wireframe, Shading::Phong, Shading::Exact};
    const std::array outputs{Output::Position, Output::Normal, Output::Id, Output::Depth, Output::Uv};
    DrawOptions all{.shading = shadings[std::size_t(i) % shadings.size()]};
    if (i % 3 == 2) all.output = outputs[random_() % outputs.size()];
    if (i % 5 == 4) all.samples = 4;
    const Scene scene = anyScene(oneIn(4));
    const Picture picture = draw(scene, kCullingSize, all);
    left.culledTrianglesFrustum += picture.statistics.count.culledTrianglesFrustum;
    left.culledTrianglesBackface += picture.statistics.count.culledTrianglesBackface;
    DrawOptions none = all;
    none.skips = Skips::none();
    const Picture whole = draw(scene, kCullingSize, none);
    EXPECT_EQ(whole.statistics.count.culledTrianglesFrustum, 0U);
    EXPECT_EQ(whole.statistics.count.culledTrianglesBackface, 0U);
    shown += showsSomething(whole.image);
    EXPECT_TRUE(sameBytes(picture.image, whole.image, Shown::MaybeNothing))
        << "scene " << i << ", " << nameOf(all.shading) << ", output " << int(all.output);
  }
  EXPECT_GT(shown, 40);
  EXPECT_GT(left.culledTrianglesFrustum, 100'000U);
  EXPECT_GT(left.culledTrianglesBackface, 5'000U);
}

/// A ball whose upper part comes out below, inside out: closed, but no solid.
TriangleMesh pushedThrough(const TriangleMesh& ball) {
  MeshArrays arrays;
  for (std::uint32_t i = 0; i < ball.positions().size(); ++i) {
    Vec3 p = ball.point(i);
    if (p.y > 0.2) p = Vec3(0.6 * p.x, p.y - 2.6 * (p.y - 0.2), 0.6 * p.z);
    arrays.positions.push_back(p);
  }
  arrays.indices.assign(ball.indices().begin(), ball.indices().end());
  return triangleMesh(std::move(arrays), "pushed through");
}

// Balls inside of meshes are looked for when these are drawn a second time.
TEST_F(MeshCulling, WhatSolidsHideChangesNoBit) {
  const std::array shapes{icosphere(5), meshOf(torus(0.7, 0.25), 3e-4), meshOf(torus(0.8, 0.08), 1e-4),
                          pushedThrough(icosphere(4)), soup(random_, 4000, 0.15)};
  std::uint64_t hidden = 0;
  int shown = 0;
  for (int i = 0; i < 60; ++i) {
    Scene scene;
    for (int n = 0; n < 6; ++n)
      scene.add(
          Node{.translation = anywhere(1.5),
               .rotation = Rotation{anywhere(1) + Vec3(0, 0, 0.01), any(0, 6)},
               .scale = Vec3(oneIn(2) ? -0.6 : 0.6, any(0.2, 1.2), any(0.2, 1.2)),
               .surface = shapes[random_() % shapes.size()],
               .material = scene.add(oneIn(4) ? anyMaterial()
                                              : Material{.diffuse = Vec3(any(0.2, 1), 0.5, any(0.2, 1))})});
    scene.add(Node{.translation = Vec3(3, 5, 4), .light = Light{.intensity = 0.7}});
    Camera camera{.eye = any(0, 4) * unit(anywhere(1)),
                  .lookAt = anywhere(0.5),
                  .fovY = radians(any(20, 100)),
                  .near = oneIn(2) ? 1e-3 : any(0.01, 0.6)};
    if (oneIn(4)) {
      camera.projection = Projection::Orthographic;
      camera.height = any(0.5, 4);
    }
    scene.add(camera);
    DrawOptions all{.shading = i % 2 ? Shading::Phong : Shading::Exact, .samples = i % 5 == 4 ? 4 : 1};
    DrawOptions none = all;
    none.skips.hidden = false;
    static_cast<void>(draw(scene, kCullingSize, all));
    const Picture whole = draw(scene, kCullingSize, none), picture = draw(scene, kCullingSize, all);
    hidden += picture.statistics.count.culledHidden;
    EXPECT_EQ(whole.statistics.count.culledHidden, 0U);
    shown += showsSomething(whole.image);
    EXPECT_TRUE(sameBytes(picture.image, whole.image, Shown::MaybeNothing)) << "scene " << i;
  }
  EXPECT_GT(shown, 50);
  EXPECT_GT(hidden, 50'000U);
}

/// Nodes may pass through each other.
TEST_F(MeshCulling, BackFacesOfSolidsAreHiddenFromAnywhere) {
  const std::array shapes{icosphere(3), meshOf(torus(0.7, 0.25), 1e-3), cubeMesh(),
                          pushedThrough(icosphere(3)), meshOf(sphere(0.8), 1e-2)};
  std::uint64_t fewer = 0;
  for (int i = 0; i < 60; ++i) {
    Scene scene;
    for (int n = 0; n < 3; ++n)
      scene.add(Node{.translation = anywhere(0.7),
                     .rotation = Rotation{anywhere(1) + Vec3(0, 0, 0.01), any(0, 6)},
                     .scale = Vec3(oneIn(2) ? -0.6 : 0.6, any(0.2, 1), any(0.2, 1)),
                     .surface = shapes[random_() % shapes.size()],
                     .material = scene.add(Material{.diffuse = Vec3(any(0.2, 1), any(0.2, 1), 0.5),
                                                    .twoSided = oneIn(2) ? TwoSided::Yes : TwoSided::Auto})});
    scene.add(Node{.translation = Vec3(3, 5, 4), .light = Light{.intensity = 0.7}});
    scene.add(Camera{.eye = any(0, 3) * unit(anywhere(1)),
                     .lookAt = anywhere(0.3),
                     .fovY = radians(any(20, 100)),
                     .near = oneIn(2) ? 1e-3 : any(0.01, 0.6)});
    if (i % 3 == 0) {
      const Verified exact = verified(takeSnapshot(scene, 0, kCullingSize));
      EXPECT_EQ(exact.verification.wrong.total(), 0U) << "scene " << i;
      EXPECT_EQ(exact.statistics.error.unconvergedPx, 0U);
      continue;
    }
    const DrawOptions culled{.shading = i % 3 == 1 ? Shading::Flat : Shading::Phong};
    DrawOptions both = culled;
    both.cullBackFaces = false;
    const Picture picture = draw(scene, kCullingSize, culled), whole = draw(scene, kCullingSize, both);
    fewer += picture.statistics.count.triangles < whole.statistics.count.triangles;
    // Where sides meet at an outline, rounding may show the other one.
    EXPECT_LE(compare(picture.image, whole.image, ComparisonSpace::Srgb8).differingPixels8, 2)
        << "scene " << i;
  }
  EXPECT_GT(fewer, 20U);
}

}  // namespace
}  // namespace luxo::test
