// SPDX-License-Identifier: Apache-2.0
// What the gallery's shaders draw, where it is known without them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scene/shader_files.h"
#include "support/picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

constexpr int kGalleryPixels = 80;

class GalleryPicture : public PictureTest {
 protected:
  /// Of a plate in ambient light, 160 pixels wide, of which 80 are seen, a part of a pixel off the middle.
  Image plate(const std::string& shader, std::vector<UniformValue> uniforms, double ambient) {
    Scene scene;
    const Material material{.shader = ShaderFiles(LUXO_SOURCE_DIR "/apps/scenes/gallery").get(shader),
                            .uniforms = std::move(uniforms)};
    scene.add(Node{.rotation = Rotation{{1, 0, 0}, kPi / 2},
                   .surface = rectangle(4, 4),
                   .material = scene.add(material)});
    scene.set(RenderSettings{.ambient = Vec3(ambient)});
    const Vec3 at(0.137 * 2 / kGalleryPixels, -0.291 * 2 / kGalleryPixels, 0);
    return draw(scene,
                Camera{.eye = at + Vec3(0, 0, 5),
                       .lookAt = at,
                       .projection = Projection::Orthographic,
                       .height = 2},
                {kGalleryPixels, kGalleryPixels})
        .image;
  }

  static double meanOf(const Image& image) {
    double sum = 0;
    for (int y = 0; y < kGalleryPixels; ++y)
      for (int x = 0; x < kGalleryPixels; ++x) sum += image.pixel(x, y)[0];
    return sum / (kGalleryPixels * kGalleryPixels);
  }
};

// At a quarter of the wavelength in the film what its faces reflect is opposite: least for an index between
// those of its sides, ((n0 n2 - n1^2) / (n0 n2 + n1^2))^2. At a half it is as if there were none: Fresnel's.
TEST_F(GalleryPicture, AThinFilmReflectsLeastAtAQuarterWave) {
  constexpr double kWavelength = 549, kFilm = 1.38, kBase = 1.52;
  const auto green = [&](double waves) {
    const Image image = plate("thin_film.frag",
                              {{"thickness", {waves * kWavelength / kFilm}},
                               {"uneven", {0}},
                               {"film", {kFilm}},
                               {"base", {kBase}},
                               {"body", {0, 0, 0}},
                               {"sky", {1, 1, 1}},
                               {"horizon", {1, 1, 1}},
                               {"ground", {1, 1, 1}}},
                              0);
    return double(image.pixel(kGalleryPixels / 2, kGalleryPixels / 2)[1]);
  };
  const double least = std::pow((kBase - kFilm * kFilm) / (kBase + kFilm * kFilm), 2);
  const double bare = std::pow((1 - kBase) / (1 + kBase), 2);
  constexpr double kFloat = 1e-6;  // a few dozen roundings of numbers below 1, the cosine's phase 6 at most
  EXPECT_NEAR(green(0.25), least, kFloat);
  EXPECT_NEAR(green(0.75), least, 2 * kFloat);
  EXPECT_NEAR(green(0.5), bare, kFloat);
  EXPECT_NEAR(green(0), bare, kFloat);
}

// Each pixel is the mean over itself: so the mean of whole squares is grey, wherever pixels lie; and so is
// each pixel over many squares, but for what a part of a square leaves: 1 / 5 of a wave in u times 1 / 5 in
// v, half of that.
TEST_F(GalleryPicture, ACheckerboardIsItsMean) {
  const auto board = [&](double squares) {
    return plate(
        "checker.frag",
        {{"squares", {squares, squares}}, {"bright", {1, 1, 1}}, {"dark", {0, 0, 0}}, {"shine", {0}}}, 1);
  };
  EXPECT_NEAR(meanOf(board(8)), 0.5, 1e-5);
  const Image fine = board(800);
  for (int y = 0; y < kGalleryPixels; ++y)
    for (int x = 0; x < kGalleryPixels; ++x)
      ASSERT_NEAR(fine.pixel(x, y)[0], 0.5, 0.5 / 25 + 1e-3) << x << " " << y;
}

TEST_F(GalleryPicture, TheMeanOfHatchingIsItsTone) {
  for (const double tone : {0.2, 0.5, 0.85}) {
    const Image image =
        plate("hatching.frag", {{"lines", {8, 8}}, {"paper", {1, 1, 1}}, {"ink", {0, 0, 0}}, {"bright", {1}}},
              tone);
    EXPECT_NEAR(meanOf(image), tone, 1e-5) << tone;
  }
}

}  // namespace
}  // namespace luxo::test
