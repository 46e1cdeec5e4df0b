// SPDX-License-Identifier: Apache-2.0
// What rays that shaders of materials send into the scene meet: chords, mirrors, bounds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "draw/secondary_rays.h"
#include "scene/shader_files.h"
#include "support/picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

using testing::HasSubstr;

constexpr PixelSize kSecondaryRaysSize{72, 56};
/// Colours are computed in single precision from positions some metres away: a few dozen roundings.
constexpr double kFloat = 1e-5;

Material tracedBy(const std::string& text) {
  return {.shader = std::make_shared<const MaterialShader>(MaterialShader{{{"test.frag", text}}})};
}

class SecondaryRays : public PictureTest {};

/// A ray that enters a ball at cosine c goes on at Snell's cosine c' for 2 r c', meets the ball from within
/// at that cosine, too, and the same again from there.
TEST_F(SecondaryRays, ChordsOfAGlassBall) {
  constexpr double kRadius = 1.3, kIndex = 1.5;
  Scene scene;
  const Material glass = tracedBy(R"(
vec4 material(Point p) {
  vec3 way = refract(-p.viewer, p.normal, 1.0 / 1.5);
  Hit first = trace(way);
  Hit second = trace(first, 3.0 * reflect(way, first.normal));
  if (!first.found || !first.inside || !second.inside) return vec4(9.0);
  return vec4(first.distance, second.distance, -dot(way, first.normal), 1.0);
})");
  const Vec3 center(0.4, -0.2, 0.1);
  scene.add(Node{.translation = center, .surface = sphere(kRadius), .material = scene.add(glass)});
  const Camera camera{.eye = Vec3(1.5, 2.5, 4), .lookAt = Vec3(0, 0, 0)};
  const Picture picture = draw(scene, camera, kSecondaryRaysSize);
  const CameraModel model(camera, kSecondaryRaysSize);
  // A point is within 1e-3 of a pixel, 0.074 m here: that moves 1 - c'^2 by 2 / r * 7.4e-5 / 1.5^2 at most,
  // at the outline, where c' is 0.745, so chords by 2 r * 3.4e-5.
  constexpr double kChord = 1e-4;
  std::uint64_t inside = 0;
  for (int y = 0; y < kSecondaryRaysSize.height; ++y)
    for (int x = 0; x < kSecondaryRaysSize.width; ++x) {
      const Ray ray = model.through(centerOf(x, y));
      const auto roots = hitSphere(ray, center, kRadius);
      if (!roots) continue;
      ++inside;
      const Vec3 normal = (ray.at(roots->first) - center) / kRadius;
      const double cosine = -glm::dot(normal, glm::normalize(ray.direction));
      const double within = std::sqrt(1 - (1 - cosine * cosine) / (kIndex * kIndex));
      const Vec3 wanted(2 * kRadius * within, 2 * kRadius * within, within);
      EXPECT_TRUE(near(colorAt(picture.image, x, y), wanted, kChord)) << x << ", " << y;
    }
  EXPECT_GT(inside, 600U);
  EXPECT_EQ(picture.statistics.count.tracedRays, 2 * inside);
  EXPECT_EQ(picture.statistics.error.uncertifiedPx, 0U);
}

/// Things of every kind above a plate that is a mirror.
Scene aboveAMirror(const Material& plate, bool withPlate, Light::Shadow shadow = Light::Shadow::Exact) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0.1, 0.2, 0.4), .ambient = Vec3(0.2)});
  const MaterialId matt = scene.add(Material{.diffuse = Vec3(0.7, 0.4, 0.1), .specular = Vec3(0.6)}),
                   veil = scene.add(Material{.diffuse = Vec3(0.1, 0.6, 0.3), .opacity = 0.5});
  scene.add(Node{.translation = Vec3(-0.9, 1.1, 0), .surface = sphere(0.6), .material = matt});
  scene.add(Node{.translation = Vec3(0.9, 1.3, -0.4),
                 .rotation = Rotation{{1, 0, 0.4}, 0.9},
                 .surface = torus(0.6, 0.25),
                 .material = matt});
  scene.add(Node{.translation = Vec3(0.1, 1.2, 0.9), .surface = sphere(0.4), .material = veil});
  if (withPlate) scene.add(Node{.surface = rectangle(40, 40), .material = scene.add(plate)});
  scene.add(Node{
      .translation = Vec3(2, 5, 4),
      .light = Light{.intensity = 40, .attenuation = Light::Attenuation::InverseSquare, .shadow = shadow}});
  return scene;
}

const std::string kMirror = R"(
vec4 material(Point p) {
  Hit hit = trace(reflect(-p.viewer, p.normal));
  return vec4(hit.color, 1.0);
})";

Camera aheadFrom(double height) { return {.eye = Vec3(0.2, height, 6), .lookAt = Vec3(0.2, height, 0)}; }

/// A level camera over a level mirror sees in it, upside down, what one as far below it sees: lights and
/// shadows, and what is seen through.
TEST_F(SecondaryRays, AMirrorShowsWhatTheMirroredEyeSees) {
  const Picture direct = draw(aboveAMirror({}, false), aheadFrom(-1.2), kSecondaryRaysSize);
  const CameraModel model(aheadFrom(1.2), kSecondaryRaysSize);
  for (const Shading shading : {Shading::Exact, Shading::Phong}) {
    const Picture mirrored =
        draw(aboveAMirror(tracedBy(kMirror), true), aheadFrom(1.2), kSecondaryRaysSize, {.shading = shading});
    int shown = 0, differ = 0;
    // Below the horizon, where nothing that stands on the plate's side hides it: the lower third.
    for (int y = kSecondaryRaysSize.height * 2 / 3; y < kSecondaryRaysSize.height; ++y)
      for (int x = 0; x < kSecondaryRaysSize.width; ++x) {
        const Vec3 wanted = colorAt(direct.image, x, kSecondaryRaysSize.height - 1 - y);
        shown += wanted != Vec3(0.1, 0.2, 0.4);
        differ += !near(colorAt(mirrored.image, x, y), wanted, kFloat);
      }
    EXPECT_GT(shown, 150);
    EXPECT_EQ(differ, 0) << nameOf(shading);
  }
}

/// Samples of a pixel send rays of their own.
TEST_F(SecondaryRays, EverySampleHasItsOwn) {
  const Picture direct = draw(aboveAMirror({}, false), aheadFrom(-1.2), kSecondaryRaysSize, {.samples = 4});
  const Picture one = draw(aboveAMirror(tracedBy(kMirror), true), aheadFrom(1.2), kSecondaryRaysSize);
  const Picture four =
      draw(aboveAMirror(tracedBy(kMirror), true), aheadFrom(1.2), kSecondaryRaysSize, {.samples = 4});
  EXPECT_GT(four.statistics.count.tracedRays, 3 * one.statistics.count.tracedRays);
  EXPECT_LT(four.statistics.count.tracedRays, 5 * one.statistics.count.tracedRays);
  EXPECT_EQ(direct.statistics.count.tracedRays, 0U);
}

/// Sixteen rays are answered, however they are spread over a path; one more is an error in words.
TEST_F(SecondaryRays, APointSendsSixteenAtMost) {
  const auto count = [&](int rays) {
    const std::string text =
        "vec4 material(Point p) { float n = 0.0; Hit hit = trace(-p.normal);\n"
        "for (int i = 1; i < " +
        std::to_string(rays) +
        "; ++i) {\n"
        "  if (hit.found) n += 1.0;\n"
        "  hit = i % 2 == 0 ? trace(-p.normal) : trace(hit, -p.normal.yzx); }\n"
        "return vec4(n, n, n, 1.0); }";
    Scene scene;
    scene.add(Node{.surface = torus(1, 0.4), .material = scene.add(tracedBy(text))});
    return draw(scene, Camera{.eye = Vec3(0, 2, 3)}, {24, 16});
  };
  const Picture all = count(16);
  const Image& image = all.image;
  EXPECT_EQ(std::ranges::max(image.samples()), 15);  // from within a torus every way ends at it
  try {
    static_cast<void>(count(17));
    ADD_FAILURE() << "it was drawn";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_THAT(error.what(), HasSubstr("the shader sends more than 16 rays into the scene"));
  }
}

/// What a ray meets nothing of, and rays without a direction; a hit of nothing leads nowhere.
TEST_F(SecondaryRays, NothingIsMet) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0.1, 0.2, 0.4)});
  scene.add(Node{.surface = sphere(1), .material = scene.add(tracedBy(R"(
uniform float zero;
vec4 material(Point p) {
  Hit none = trace(p.normal);
  Hit still = trace(none, -p.normal), undirected = trace(vec3(zero)), wrong = trace(p.normal / zero);
  float far = none.distance == 1e30 ? 0.5 : 0.0;
  return vec4(none.found || still.found || undirected.found || wrong.found ? vec3(9.0) : none.color * far, 1.0);
})"))});
  const Image image = draw(scene, Camera{.eye = Vec3(0, 0, 3)}, {16, 16}).image;
  EXPECT_TRUE(near(colorAt(image, 8, 8), Vec3(0.05, 0.1, 0.2), 1e-7));
}

/// Glass of air's own index, which takes nothing, is not there; of a higher one it is.
TEST_F(SecondaryRays, GlassThatBendsNothingIsInvisible) {
  const std::vector<double> sky{0.1, 0.2, 0.4};
  const auto shown = [&](std::optional<double> index) {
    Scene scene = aboveAMirror({.diffuse = Vec3(0.6)}, true, Light::Shadow::None);
    if (index)
      scene.add(Node{.translation = Vec3(0.2, 0.9, 2.4),
                     .surface = sphere(0.7),
                     .material = scene.add(Material{
                         .shader = ShaderFiles(LUXO_SOURCE_DIR "/apps/scenes/gallery").get("glass.frag"),
                         .uniforms = {{"index", {*index}},
                                      {"absorption", {0, 0, 0}},
                                      {"lamp", {0}},
                                      {"sky", sky},
                                      {"horizon", sky}}})});
    return draw(scene, aheadFrom(1.2), kSecondaryRaysSize).image;
  };
  const Image without = shown(std::nullopt), invisible = shown(1), visible = shown(1.3);
  // A point is within 1e-3 of a pixel, from one to the next of which colours change by 0.7 at most.
  constexpr double kPoint = 7e-4;
  int differ = 0;
  for (int y = 0; y < kSecondaryRaysSize.height; ++y)
    for (int x = 0; x < kSecondaryRaysSize.width; ++x) {
      EXPECT_TRUE(near(colorAt(invisible, x, y), colorAt(without, x, y), kPoint)) << x << ", " << y;
      differ += !near(colorAt(visible, x, y), colorAt(without, x, y), 0.02);
    }
  EXPECT_GT(differ, 150);
}

/// Rays find the shadows of a few pixels, which are lit again where no shader sends any: what others have
/// asked is answered all the same. At these sizes there are such pixels.
TEST_F(SecondaryRays, AreAskedWhereOtherPixelsAreLitAgain) {
  const auto ringsBesideAMirror = [](const Material& ball) {
    Scene scene;
    scene.set(RenderSettings{.background = Vec3(0.3), .ambient = Vec3(0.2)});
    const MaterialId matt = scene.add(Material{.diffuse = Vec3(0.8, 0.5, 0.2)});
    scene.add(Node{.surface = rectangle(40, 40), .material = matt});
    scene.add(Node{.translation = Vec3(0, 1.5, 0), .surface = sphere(1), .material = scene.add(ball)});
    for (const double side : {-1.0, 1.0})
      scene.add(Node{.translation = Vec3(2 * side, 1, 1),
                     .rotation = Rotation{{1, 0, 0.4}, side < 0 ? kTau * 50 / 360 : kTau * 70 / 360},
                     .surface = torus(1.2, 0.3),
                     .material = matt});
    scene.add(Node{.translation = Vec3(3, 6, 5),
                   .light = Light{.intensity = 40,
                                  .attenuation = Light::Attenuation::InverseSquare,
                                  .shadow = Light::Shadow::Exact}});
    return scene;
  };
  const Camera camera{.eye = Vec3(0, 3, 8), .lookAt = Vec3(0, 1, 0), .fovY = kTau * 40 / 360};
  const Vec3 center(0, 1.5, 0);
  std::uint64_t shadowsByRays = 0;
  for (const PixelSize size : {PixelSize{320, 180}, PixelSize{400, 225}, PixelSize{480, 270}}) {
    const Picture picture = draw(ringsBesideAMirror(tracedBy(R"(
vec4 material(Point p) {
  Hit hit = trace(-p.normal);
  return vec4(hit.distance, hit.inside ? 1.0 : 0.0, 0.25, 1.0);
})")),
                                 camera, size);
    shadowsByRays += picture.statistics.error.shadowRaysPx;
    const CameraModel model(camera, size);
    std::uint64_t onBall = 0;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const Vec3 color = colorAt(picture.image, x, y);
        if (color.z != 0.25) continue;
        ++onBall;
        EXPECT_TRUE(hitSphere(model.through(centerOf(x, y)), center, 1));
        EXPECT_TRUE(near(color, Vec3(2, 1, 0.25), kFloat)) << x << ", " << y << ": the diameter";
      }
    EXPECT_GT(onBall, 1000U) << size.width;
    EXPECT_EQ(picture.statistics.count.tracedRays, onBall) << size.width;
  }
  EXPECT_GT(shadowsByRays, 0U);
}

/// Pixels at the borders of pictures that are no whole squares or blocks of fragments ask as all others do:
/// whatever the size, each ray from a plate meets the other, 2 m above, and comes back.
TEST_F(SecondaryRays, AreAnsweredInPicturesOfAllSizes) {
  Scene scene;
  const MaterialId plates = scene.add(tracedBy(R"(
vec4 material(Point p) {
  Hit up = trace(p.normal), back = trace(up, up.normal);
  return vec4(up.distance, back.distance, back.position.y, 1.0);
})"));
  for (const double height : {0.0, 2.0})
    scene.add(Node{.translation = Vec3(0, height, 0), .surface = rectangle(400, 400), .material = plates});
  const Camera camera{.eye = Vec3(0, 1.7, 0), .lookAt = Vec3(0, 0, -1), .fovY = kTau * 40 / 360};
  const auto wrongIn = [&](PixelSize size) {
    const Picture picture = draw(scene, camera, size);
    int wrong = 0;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) wrong += !near(colorAt(picture.image, x, y), Vec3(2, 2, 0), 1e-4);
    EXPECT_EQ(picture.statistics.count.tracedRays, 2U * size.width * size.height);
    return wrong;
  };
  for (const int height : {1, 2, 7})
    for (int width = 1; width < 200; width += height == 7 ? 2 : 22)
      EXPECT_EQ(wrongIn({width, height}), 0) << width << " x " << height;
  for (const PixelSize size : {PixelSize{160, 90}, PixelSize{65, 130}, PixelSize{3, 201}})
    EXPECT_EQ(wrongIn(size), 0) << size.width << " x " << size.height;
}

/// A point that is found anew asks anew: what it was told before, and what it was told after that, goes. Who
/// asks without end is left, and counted.
TEST(SecondaryRaysProtocol, AskingAgainReplacesAnswers) {
  Scene scene;
  scene.add(Node{.surface = sphere(1)});
  scene.add(Camera{.eye = Vec3(0, 0, 4)});
  const Snapshot snapshot = takeSnapshot(scene, 0, {3, 3});
  luxo::SecondaryRays rays;
  rays.begin(snapshot, Vec3(0));
  std::vector<shared::TraceQuestion> questions(9);
  const auto ask = [&](std::uint32_t number, std::uint32_t from, const Vec3f& direction) {
    questions[4] = {{direction, from}, number, Vec3f(0, 0, 1)};
    return rays.answer(questions);
  };
  const Vec3f across(0.6F, 0, -0.8F), down(0, 0, -1);
  EXPECT_TRUE(ask(0, shared::kFromPoint, across));
  EXPECT_TRUE(ask(1, shared::kFromFirstHit, across));
  EXPECT_EQ(rays.answers().size(), 2U);
  EXPECT_NEAR(rays.answers()[0].distance, 1.6, 1e-6);
  EXPECT_EQ(rays.answers()[1].distance, -1) << "out of the ball";
  EXPECT_TRUE(ask(0, shared::kFromPoint, down));
  ASSERT_EQ(rays.answers().size(), 1U);
  EXPECT_NEAR(rays.answers()[0].distance, 2, 1e-6);
  EXPECT_EQ(rays.starts()[4], 0U);
  EXPECT_EQ(rays.starts()[5], 1U);
  int more = 0;
  while (ask(0, shared::kFromPoint, down)) ASSERT_LT(++more, 100);
  EXPECT_EQ(rays.openPx(), 1U);
  questions[4] = {};
  EXPECT_FALSE(rays.answer(questions));
  EXPECT_EQ(rays.openPx(), 0U);
}

/// Without trace() the picture is made in one go, as ever.
TEST_F(SecondaryRays, WhoSendsNonePaysNothing) {
  const auto counted = [&](const std::string& text) {
    Scene scene;
    scene.add(Node{.surface = torus(1, 0.4), .material = scene.add(tracedBy(text))});
    return draw(scene, Camera{.eye = Vec3(0, 2, 3)}, {24, 16}).statistics.count;
  };
  const FrameCounts none = counted("vec4 material(Point p) { return vec4(p.normal, 1.0); } // retrace"),
                    one = counted("vec4 material(Point p) { return vec4(trace(p.normal).normal, 1.0); }");
  EXPECT_EQ(none.deferred, 0U);
  EXPECT_EQ(none.tracedRays, 0U);
  EXPECT_EQ(one.deferred, 1U);
  EXPECT_EQ(one.submits, none.submits + 1);
}

}  // namespace
}  // namespace luxo::test
