// SPDX-License-Identifier: Apache-2.0
// What exact pictures compile before anything is kept on disk: nothing for what is built in.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "luxo_grandpa/lamp.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scenes/embedded_scenes.h"
#include "scenes/primitives.h"
#include "support/other_arguments.h"
#include "support/picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

namespace fs = std::filesystem;

class ExactStart : public PictureTest {
 protected:
  ~ExactStart() override { fs::remove_all(directory_); }

  [[nodiscard]] std::uint64_t compiledBy(const Scene& scene) {
    return draw(scene, {64, 36}, {.shading = Shading::Exact}).statistics.count.shadersCompiled;
  }

 private:
  const fs::path directory_ = fs::path(testing::TempDir()) / ("luxo-exact-start-" + std::to_string(getpid()));
  const ScopedVariable cache_{"LUXO_CACHE_DIR", directory_.c_str()};
};

Scene sceneOf(Surface surface) {
  Scene scene;
  scene.add(Node{.surface = std::move(surface)});
  scene.add(Camera{.eye = Vec3(0, 1, 6)});
  return scene;
}

TEST_F(ExactStart, BuiltInScenesCompileNothing) {
  EXPECT_EQ(compiledBy(luxoGrandpa()), 0u) << "the lamp";
  EXPECT_EQ(compiledBy(primitives()), 0u) << "the primitives";
  for (const EmbeddedScene& scene : embeddedScenes()) {
    if (scene.name == "lecture") continue;  // shows patterns on triangles, too: its own choice of shadings
    EXPECT_EQ(compiledBy(buildScene(parseScene(std::string(scene.text), std::string(scene.name)))), 0u)
        << scene.name;
  }
}

TEST_F(ExactStart, EquationsCompileNothingWhateverTheirNumbers) {
  EXPECT_EQ(compiledBy(sceneOf(sphere(0.7316))), 0u);
  EXPECT_EQ(compiledBy(sceneOf(cone(1.3, 0.217, 0.9))), 0u);
  EXPECT_EQ(compiledBy(sceneOf(torus(1.2, 0.3177))), 0u);
}

TEST_F(ExactStart, NamedSurfacesCompileNothingWhateverTheirArguments) {
  for (const CatalogueEntry& entry : catalogue())
    EXPECT_EQ(compiledBy(sceneOf(makeSurface(entry, otherArguments(entry)))), 0u) << entry.name;
}

// Searches in double are built in as those in float are.
TEST_F(ExactStart, NamedSurfacesCompileNothingWhenMagnified) {
  const auto magnified = [&](const char* name) {
    Scene scene;
    scene.add(Node{.surface = makeSurface(name)});
    scene.add(Camera{.eye = Vec3(0, 1, 6), .fovY = 1e-5});
    return scene;
  };
  EXPECT_EQ(compiledBy(magnified("torus_knot")), 0u);
  EXPECT_EQ(compiledBy(magnified("sphere")), 0u);
}

TEST_F(ExactStart, AFormulaIsCompiledOnce) {
  const Surface wave = surface([](auto u, auto v) { return point(u, 0.1 * sin(7 * u), v); }, {});
  EXPECT_EQ(compiledBy(sceneOf(wave)), 1u);
  EXPECT_EQ(compiledBy(sceneOf(wave)), 0u);
}

}  // namespace
}  // namespace luxo::test
