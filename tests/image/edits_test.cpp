// SPDX-License-Identifier: Apache-2.0
// One renderer draws scene after scene whose formulas differ, as when a file is edited beside its picture:
// what it keeps has a bound, and what pictures go on using is there.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "draw/scene_pipelines.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kEditsSize{160, 120};

/// Shaders are compiled into a folder of the test's own.
class EditsTest : public PictureTest {
 protected:
  void TearDown() override {
    PictureTest::TearDown();
    std::filesystem::remove_all(directory_);
  }

  [[nodiscard]] std::uint64_t objects() { return renderer().context().counters().objects; }
  [[nodiscard]] std::uint64_t pipelinesFor(const Scene& scene) {
    return draw(scene, Camera{.eye = Vec3(0, 0, 6)}, kEditsSize, {.shading = Shading::Phong})
        .statistics.count.pipelinesCreated;
  }

 private:
  const std::filesystem::path directory_ =
      std::filesystem::path(testing::TempDir()) / ("luxo-edits-" + std::to_string(getpid()));
  ScopedVariable variable_{"LUXO_CACHE_DIR", directory_.c_str()};
};

Material stripes(int edit) {
  return {.diffusePattern =
              pattern([edit](auto u, auto) { return point(0.5 + 0.5 * sin((edit + 1.5) * u), 0.5, 0.5); })};
}

/// Plates of one shape, side by side, each with a formula of its own.
Scene plates(int firstEdit, int count) {
  Scene scene;
  scene.set(plainSettings());
  static const Node kPlate = plate(Vec3(0), {0.1, 2}, {});
  for (int i = 0; i < count; ++i) {
    Node node = kPlate;
    node.translation = Vec3(0.1 * i - 2, 0, 0);
    node.material = scene.add(stripes(firstEdit + i));
    scene.add(node);
  }
  return scene;
}

/// As many pipelines as fit what is kept of old ones, whatever their shaders.
constexpr int kMaxKept = static_cast<int>(kMaxIdlePipelineBytes >> 21);

TEST_F(EditsTest, WhatIsKeptHasABound) {
  // Each edit makes a shader, a pipeline and its layout.
  for (int edit = 0; edit < kMaxKept; ++edit) ASSERT_EQ(pipelinesFor(plates(edit, 1)), 1u);
  const std::uint64_t then = objects();
  for (int edit = kMaxKept; edit < 2 * kMaxKept; ++edit) ASSERT_EQ(pipelinesFor(plates(edit, 1)), 1u);
  EXPECT_LE(objects(), then);
  // The latest are still there, the first is not.
  EXPECT_EQ(pipelinesFor(plates(2 * kMaxKept - 5, 1)), 0u);
  EXPECT_EQ(pipelinesFor(plates(0, 1)), 1u);
}

// A shader's file, saved again and again: what is on the device for the first kMaxKept is all there ever is.
TEST_F(EditsTest, WhatIsKeptOfShadersHasABound) {
  const auto edited = [](int edit) {
    Scene scene;
    scene.set(plainSettings());
    const std::string text = "vec4 material(Point p) { return vec4(vec3(0.001 * " + std::to_string(edit + 1) +
                             ".0) + fract(" + std::to_string(edit) + ".5 * p.uv.x), 1.0); }";
    static const Node kPlate = plate(Vec3(0), {2, 2}, {});
    Node node = kPlate;
    node.material = scene.add(
        Material{.shader = std::make_shared<const MaterialShader>(MaterialShader{{{"edited.frag", text}}})});
    scene.add(node);
    return scene;
  };
  for (int edit = 0; edit < kMaxKept; ++edit) ASSERT_EQ(pipelinesFor(edited(edit)), 1u);
  const gpu::Counters then = renderer().context().counters();
  for (int edit = kMaxKept; edit < kMaxKept + 8; ++edit) ASSERT_EQ(pipelinesFor(edited(edit)), 1u);
  const gpu::Counters now = renderer().context().counters();
  EXPECT_LE(now.objects, then.objects);
  EXPECT_LE(now.allocations, then.allocations);
  EXPECT_LE(now.memoryBytes, then.memoryBytes);
}

TEST_F(EditsTest, WhatAPictureUsesStays) {
  const Scene many = plates(0, kMaxKept + 4);
  EXPECT_EQ(pipelinesFor(many), kMaxKept + 4u);
  EXPECT_EQ(pipelinesFor(many), 0u);
  EXPECT_EQ(pipelinesFor(plates(100, 1)), 1u);
  EXPECT_EQ(pipelinesFor(many), 0u) << "it was in use a picture ago";
}

}  // namespace
}  // namespace luxo::test
