// SPDX-License-Identifier: Apache-2.0
// What tests of pictures share: a renderer on the tests' device, and the few facts about cameras and light
// that answers are worked out from, written a second time, in double, straight from the definitions.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <span>
#include <utility>

#include "draw/renderer.h"
#include "support/gpu_fixture.h"
#include "surface/library.h"

namespace luxo::test {

/// A ray whose direction advances one metre of depth: the parameter is the depth.
struct Ray {
  Vec3 origin{0}, direction{0};

  [[nodiscard]] Vec3 at(double depth) const { return origin + depth * direction; }
};

/// Where pixels and points lie. Pixel coordinates: x right, y down, centres at .5.
class CameraModel {
 public:
  CameraModel(const Camera& camera, PixelSize size, double time = 0);

  [[nodiscard]] Ray through(const Vec2& pixel) const;
  [[nodiscard]] Vec2 pixelOf(const Vec3& pointWorld) const;  ///< perspective: in front of the eye
  [[nodiscard]] double depthOf(const Vec3& pointWorld) const;
  [[nodiscard]] Vec3 towardViewer(const Vec3& pointWorld) const;  ///< unit
  [[nodiscard]] double pixelsPerUnit() const { return pixelsPerUnit_; }

 private:
  Vec3 eye_, right_, up_, forward_;
  Vec2 center_;
  bool orthographic_;
  double pixelsPerUnit_;  ///< at depth 1, or everywhere
};

[[nodiscard]] inline Vec2 centerOf(int x, int y) { return {x + 0.5, y + 0.5}; }

/// Depths at which a ray meets a plane (in front or behind) or a sphere (near, far).
[[nodiscard]] std::optional<double> hitPlane(const Ray& ray, const Vec3& point, const Vec3& normal);
[[nodiscard]] std::optional<std::pair<double, double>> hitSphere(const Ray& ray, const Vec3& center,
                                                                 double radius);

/// What `inside(pixel)` says if it says the same everywhere within `radius` pixels (the centre and 32 points
/// around it are asked), or nothing: the pixel is at a border.
template <class Inside>
[[nodiscard]] std::optional<bool> settled(const Inside& inside, const Vec2& pixel, double radius) {
  const bool first = inside(pixel);
  for (int k = 0; k < 32; ++k) {
    const double angle = kTau * k / 32;
    if (inside(pixel + radius * Vec2(glm::cos(angle), glm::sin(angle))) != first) return std::nullopt;
  }
  return first;
}

/// Vulkan rounds vertices to a grid of at least 1/256 pixel in each direction; with the rounding of single
/// precision before it, an edge is drawn within this many pixels of its place.
inline constexpr double kSnapPx = 1.0 / 128;

/// A light as the formula needs it: w = 1 a point, w = 0 the direction toward it.
struct Shine {
  Vec4 position{0, 0, 0, 1};
  Vec3 radiance{1};
  bool inverseSquare = false;
};

/// ka La + sum of (kd max(N.L, 0) + ks max(N.H, 0)^n) Le, nothing from below the horizon; n, v unit.
[[nodiscard]] Vec3 blinnPhong(const Material& material, const Vec3& ambient, std::span<const Shine> lights,
                              const Vec3& point, const Vec3& n, const Vec3& v);

NodeId addLight(Scene& scene, const Shine& shine);

/// Right-handed rotation that takes the unit vector `from` to the unit vector `to`.
[[nodiscard]] Rotation turning(const Vec3& from, const Vec3& to);

/// Shows `color` under ambient light 1, whatever the lights do.
[[nodiscard]] Material glowing(const Vec3& color, double opacity = 1);

/// A material's program, of one file.
[[nodiscard]] MaterialShaderPtr shaderOf(const std::string& text);

/// A rectangle whose normal is +Z: u to the right (+X), v up (+Y).
[[nodiscard]] Node plate(const Vec3& center, const Vec2& size, MaterialId material);

/// Ambient light 1 and a black background: glowing materials show their colour.
[[nodiscard]] RenderSettings plainSettings(const Vec3& background = Vec3(0));

[[nodiscard]] Vec3 colorAt(const Image& image, int x, int y);
[[nodiscard]] ::testing::AssertionResult near(const Vec3& a, const Vec3& b, double tolerance);
/// Whether there is more than one colour.
[[nodiscard]] bool showsSomething(const Image& image);
/// Two pictures that show nothing are the same, whatever should be there: comparing them is a failure, unless
/// that is what is asked.
enum class Shown { Something, MaybeNothing };
[[nodiscard]] ::testing::AssertionResult sameBytes(const Image& a, const Image& b,
                                                   Shown shown = Shown::Something);
/// Of the numbers of two images of one size; infinite where one is no number.
[[nodiscard]] double largestDifference(const Image& a, const Image& b);
[[nodiscard]] ::testing::AssertionResult nearEverywhere(const Image& a, const Image& b, double most);
/// How many pixels are not near(); of two images of one size.
[[nodiscard]] int differingPixels(const Image& a, const Image& b, double tolerance);
[[nodiscard]] ::testing::AssertionResult allFinite(const Image& image);
[[nodiscard]] Image flippedLeftRight(const Image& image);

/// A renderer on the tests' device, made when first needed.
class PictureTest : public GpuTest {
 protected:
  void TearDown() override;

  [[nodiscard]] Renderer& renderer();
  /// From the scene's first camera.
  [[nodiscard]] Picture draw(const Scene& scene, PixelSize size, const DrawOptions& options = {},
                             double time = 0);
  [[nodiscard]] Picture draw(const Scene& scene, const Camera& camera, PixelSize size,
                             const DrawOptions& options = {}, double time = 0);

 private:
  std::optional<Renderer> renderer_;
};

}  // namespace luxo::test
