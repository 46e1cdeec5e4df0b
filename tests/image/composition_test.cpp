// SPDX-License-Identifier: Apache-2.0
// Points that are found and lit in one fragment, and points that are found first and lit later, make the same
// picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "draw/device_cloth_simulation.h"
#include "image/srgb.h"
#include "luxo_grandpa/lamp.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scenes/embedded_scenes.h"
#include "scenes/gallery.h"
#include "scenes/primitives.h"
#include "support/picture.h"
#include "surface/surface.h"

namespace luxo::test {
namespace {

/// Of the depth that is written down a float keeps 2^-24, and as much of each number of the normal; light
/// magnifies that where it is bright.
constexpr double kSame = 2e-6;
/// Of triangles where corners are rounded to 1/256 of a pixel: fused light is that of a point beside the ray.
constexpr double kSameBesideRay = 3e-4;
/// Shaders magnify that more, with powers, waves and noise: the ice 7e-5.
constexpr double kSameByShaders = 1e-4;
/// And may jump: of gallery/spheres, whose shader casts rays of its own, at an edge of these, 1 pixel in 700.
constexpr int kPixelsPerJump = 300;

Scene sceneOf(std::string_view text) { return buildScene(parseScene(std::string(text), "scene")); }

/// Light that has to know all that is in a picture is always deferred: what is seen through is put in order,
/// and shadows, occlusion and rays of shaders start at what was found. So there is no fused form of scenes
/// with layers to compare, and others are drawn without the shadows that are not known in closed form.
class CompositionTest : public PictureTest {
 protected:
  Picture draw(const Snapshot& snapshot, Composition composition, Shading shading = Shading::Exact,
               int samples = 1) {
    return renderer().render(snapshot, {.shading = shading,
                                        .audit = {.extent = AuditExtent::None},
                                        .samples = samples,
                                        .composition = composition,
                                        .shadows = ShadowKinds::ClosedForms});
  }

  void expectTheSame(const Snapshot& snapshot, Shading shading = Shading::Exact, int samples = 1,
                     double same = kSame, std::size_t jumps = 0) {
    const Picture fused = draw(snapshot, Composition::Fused, shading, samples),
                  deferred = draw(snapshot, Composition::Deferred, shading, samples);
    EXPECT_EQ(fused.statistics.count.deferred, 0u);
    EXPECT_EQ(deferred.statistics.count.deferred, static_cast<std::uint64_t>(samples));
    EXPECT_EQ(fused.statistics.error.unconvergedPx, deferred.statistics.error.unconvergedPx);
    EXPECT_EQ(fused.statistics.error.uncertifiedPx, deferred.statistics.error.uncertifiedPx);
    const auto a = fused.image.samples(), b = deferred.image.samples();
    ASSERT_EQ(a.size(), b.size());
    std::vector<double> off;
    std::vector<int> codesOff;
    for (std::size_t i = 0; i < a.size(); ++i) {
      off.push_back(std::abs(double{a[i]} - b[i]) / std::max(1.0, std::abs(double{a[i]})));
      codesOff.push_back(std::abs(int{encodeSrgb8(a[i])} - int{encodeSrgb8(b[i])}));
    }
    EXPECT_LE(mostBut(jumps, off), tolerance(same, kSameBesideRay));
    EXPECT_LE(mostBut(jumps, codesOff), 1);
  }

 private:
  /// The largest of them, but for so many.
  template <class Number>
  static Number mostBut(std::size_t count, std::vector<Number>& numbers) {
    const auto most = numbers.begin() + static_cast<std::ptrdiff_t>(count);
    std::ranges::nth_element(numbers, most, std::greater<>());
    return *most;
  }
};

TEST_F(CompositionTest, OfEveryBuiltInScene) {
  int compared = 0;
  for (const EmbeddedScene& embedded : embeddedScenes()) {
    SCOPED_TRACE(embedded.name);
    const Scene scene = sceneOf(embedded.text);
    const Snapshot snapshot = takeSnapshot(scene, scene.settings().time, {200, 150});
    if (hasLayers(snapshot, {})) continue;
    expectTheSame(snapshot);
    ++compared;
  }
  EXPECT_GE(compared, 8);
}

TEST_F(CompositionTest, OfEverySceneOfTheGallery) {
  constexpr PixelSize kSize{64, 36};
  constexpr std::size_t kJumps = 3 * kSize.width * kSize.height / kPixelsPerJump;
  int compared = 0;
  for (const EmbeddedScene& embedded : galleryScenes()) {
    SCOPED_TRACE(embedded.name);
    Scene scene = buildScene(galleryDescription(embedded));
    scene.set(std::make_shared<DeviceClothSimulation>(context()));
    const Snapshot snapshot = takeSnapshot(scene, scene.settings().time, kSize);
    if (hasLayers(snapshot, {}) || occludesAmbient(snapshot, {}) || tracesRays(snapshot, {})) continue;
    expectTheSame(snapshot, Shading::Exact, 1, kSameByShaders, kJumps);
    ++compared;
  }
  EXPECT_GE(compared, 10);
}

TEST_F(CompositionTest, OfThePrimitives) {
  const Scene scene = primitives();
  expectTheSame(takeSnapshot(scene, 1, {240, 160}));
}

TEST_F(CompositionTest, OfTriangles) {
  const Scene scene = luxoGrandpa();
  const Snapshot snapshot = takeSnapshot(scene, 21, {240, 160});
  expectTheSame(snapshot, Shading::Phong);
  expectTheSame(snapshot, Shading::Flat);
}

TEST_F(CompositionTest, OfManySamples) {
  expectTheSame(takeSnapshot(luxoGrandpa(), 21, {160, 120}), Shading::Exact, 4);
}

/// What is drawn over what was found: per-vertex light, wireframes, wires that are seen through.
constexpr std::string_view kMixed = R"luxo({
  "luxo": 1,
  "materials": {
    "a": { "diffuse": [0.7, 0.2, 0.2] }, "b": { "shading": "gouraud" }, "c": { "shading": "wireframe" },
    "d": { "shading": "wireframe", "opacity": 0.5 }, "e": { "diffuse": ["0.5+0.5*sin(9u)", "v", 0.2] },
    "f": { "diffuse": [0.2, "0.5+0.5*cos(7v)", "u"], "shading": "phong" }
  },
  "surfaces": {
    "ball": { "type": "sphere", "radius": 1 }, "ring": { "type": "torus", "major": 1, "minor": 0.3 }
  },
  "nodes": [
    { "surface": "ball", "material": "a" },
    { "surface": "ball", "material": "b", "translate": [1, 0, 0] },
    { "surface": "ring", "material": "c", "translate": [0, 1, 0] },
    { "surface": "ball", "material": "d", "translate": [0, 0, 1.5] },
    { "surface": "ring", "material": "e", "translate": [-1, 0, 0] },
    { "surface": "ball", "material": "f", "translate": [0, -1, 0] },
    { "translate": [3, 4, 5], "light": { "type": "point", "intensity": 1 } }
  ]
})luxo";

TEST_F(CompositionTest, OfAllKindsTogether) {
  const Scene scene = sceneOf(kMixed);
  expectTheSame(takeSnapshot(scene, 0, {200, 150}));
}

TEST_F(CompositionTest, OfParallelRays) {
  const Camera camera{.eye = Vec3(2, 3, 8), .projection = Projection::Orthographic, .height = 5.0};
  expectTheSame(takeSnapshot(sceneOf(kMixed), 0, {200, 150}, camera));
}

}  // namespace
}  // namespace luxo::test
