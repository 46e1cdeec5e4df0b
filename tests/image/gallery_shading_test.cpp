// SPDX-License-Identifier: Apache-2.0
// What the gallery's solid textures, bumps and lights draw, against the same mathematics in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/shader_files.h"
#include "support/picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

constexpr int kShadedPixels = 64;
constexpr double kWide = 2;                       // metres that a picture shows
constexpr double kPixel = kWide / kShadedPixels;  // metres

/// Parts of a pixel: centres are on no lattice's lines.
const Vec3 kAside(0.137 * kPixel, -0.291 * kPixel, 0);
constexpr double kHeight = 0.31;  // of plates, which are in no lattice's plane

constexpr double kRings = 7, kWobble = 0.2;
const Vec3 kPith(0.3, 0, 0.1);

Material shaded(const std::string& shader, std::vector<UniformValue> uniforms) {
  return {.shader = ShaderFiles(LUXO_SOURCE_DIR "/apps/scenes/gallery").get(shader),
          .uniforms = std::move(uniforms)};
}

/// Of a plate across Z, seen along -Z.
class GalleryShading : public PictureTest {
 protected:
  Image plate(const std::string& shader, std::vector<UniformValue> uniforms, double ambient,
              std::optional<Vec3> toLight = std::nullopt) {
    Scene scene;
    scene.add(Node{.translation = Vec3(0, 0, kHeight),
                   .rotation = Rotation{{1, 0, 0}, kPi / 2},
                   .surface = rectangle(4, 4),
                   .material = scene.add(shaded(shader, std::move(uniforms)))});
    scene.set(RenderSettings{.ambient = Vec3(ambient)});
    if (toLight) addLight(scene, {.position = Vec4(*toLight, 0)});
    return picture(scene);
  }

  Image picture(const Scene& scene) {
    return draw(scene,
                Camera{.eye = kAside + Vec3(0, 0, 5),
                       .lookAt = kAside,
                       .projection = Projection::Orthographic,
                       .height = kWide},
                {kShadedPixels, kShadedPixels})
        .image;
  }

  /// White in autumn, black in spring.
  Image wood(double wobble) {
    return plate("wood.frag",
                 {{"early", {0, 0, 0}},
                  {"late", {1, 1, 1}},
                  {"pith", {kPith.x, kPith.y, kPith.z}},
                  {"rings", {kRings}},
                  {"autumn", {3}},
                  {"wobble", {wobble}},
                  {"fibre", {0}}},
                 1);
  }

  static Vec3 placeOf(int x, int y) {
    return kAside +
           Vec3((x + 0.5 - kShadedPixels / 2.0) * kPixel, (kShadedPixels / 2.0 - y - 0.5) * kPixel, 0);
  }
};

using Lattice = std::array<std::int64_t, 3>;

/// pcg3d as the paper has it: the first of its three numbers, as a part of 1.
double hashed(const Lattice& at) {
  std::array<std::uint32_t, 3> v{};
  for (std::size_t i = 0; i < 3; ++i) v[i] = std::uint32_t(at[i]) * 1664525u + 1013904223u;
  for (int round = 0; round < 2; ++round) {
    v[0] += v[1] * v[2];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
    if (round == 0)
      for (std::uint32_t& part : v) part ^= part >> 16u;
  }
  return double(v[0] >> 8u) / (1 << 24);
}

/// The sum of `height(corner, toPlace)` over the lattice's corners around a place, each with its weights'
/// product.
template <class Weight, class Height>
double overCorners(const Vec3& place, const Weight& weight, const Height& height) {
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Lattice at{};
    Vec3 from;
    double share = 1;
    for (int i = 0; i < 3; ++i) {
      const double low = std::floor(place[i]);
      const bool upper = ((corner >> i) & 1) != 0;
      at[std::size_t(i)] = std::int64_t(low) + (upper ? 1 : 0);
      from[i] = place[i] - low - (upper ? 1 : 0);
      share *= weight(1 - std::abs(from[i]));
    }
    sum += share * height(at, from);
  }
  return sum;
}

double valueNoise(const Vec3& place) {
  return overCorners(
      place, [](double x) { return x * x * (3 - 2 * x); },
      [](const Lattice& at, const Vec3&) { return hashed(at); });
}

/// Perlin's of 2002, with this hash for his table.
double gradientNoise(const Vec3& place) {
  static const std::array<Vec3, 12> kEdges{{{0, 1, 1},
                                            {0, -1, 1},
                                            {0, 1, -1},
                                            {0, -1, -1},
                                            {1, 0, 1},
                                            {-1, 0, 1},
                                            {1, 0, -1},
                                            {-1, 0, -1},
                                            {1, 1, 0},
                                            {-1, 1, 0},
                                            {1, -1, 0},
                                            {-1, -1, 0}}};
  return overCorners(
      place, [](double x) { return x * x * x * (x * (6 * x - 15) + 10); },
      [](const Lattice& at, const Vec3& from) {
        return glm::dot(kEdges[std::size_t(12 * hashed(at))], from);
      });
}

/// How many pixels of red are further than that from what is wanted there.
template <class Wanted>
int wrongPixels(const Image& image, const Wanted& wanted, double tolerance) {
  int wrong = 0;
  for (int y = 0; y < kShadedPixels; ++y)
    for (int x = 0; x < kShadedPixels; ++x)
      if (!(std::abs(double(image.pixel(x, y)[0]) - wanted(x, y)) <= tolerance)) ++wrong;
  return wrong;
}

/// From spring to autumn a year darkens as a cube: its mean over a pixel's width, of many places.
double darkness(double year, double size) {
  constexpr int kPlaces = 2000;
  double sum = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double at = year + size * ((i + 0.5) / kPlaces - 0.5);
    sum += std::pow(at - std::floor(at), 3);
  }
  return sum / kPlaces;
}

/// As K. Perlin's marble has it, of noise between 0 and 1: octaves of |2 noise - 1|, each twice as fine and
/// half as strong.
double veins(Vec3 place, double bend, int octaves) {
  const double height = place.y;
  double sum = 0, all = 0;
  for (double weight = 0.5; octaves > 0; --octaves, weight /= 2) {
    sum += weight * std::abs(2 * valueNoise(place) - 1);
    all += weight;
    place = 2.0 * place + Vec3(17);
  }
  return std::pow(0.5 + 0.5 * std::sin(3 * height + bend * sum / all), 0.6);
}

/// In the light of the surroundings alone it is their mix.
TEST_F(GalleryShading, VeinsOfMarbleAreASineOfTurbulence) {
  const Vec3 stone(0.9, 0.5, 0.1), vein(0.1, 0.2, 0.3);
  constexpr double kScale = 1.6, kBend = 7;
  constexpr int kOctaves = 6;
  Scene scene;
  scene.add(Node{
      .surface = surface([](auto u, auto v) { return point(u, v, 0 * u + kHeight); }, {{-2, 2}, {-2, 2}}),
      .material = scene.add(shaded("marble.frag", {{"stone", {stone.x, stone.y, stone.z}},
                                                   {"vein", {vein.x, vein.y, vein.z}},
                                                   {"scale", {kScale}},
                                                   {"bend", {kBend}},
                                                   {"octaves", {kOctaves}}}))});
  scene.set(RenderSettings{.ambient = Vec3(1)});
  const Image image = picture(scene);
  double least = 1, most = 0;
  for (int y = 0; y < kShadedPixels; ++y)
    for (int x = 0; x < kShadedPixels; ++x) {
      const double share = veins(kScale * (placeOf(x, y) + Vec3(0, 0, kHeight)), kBend, kOctaves);
      // Places are floats: the finest octave's are off by 1e-4 of its cells, and the sine by some 1e-5.
      EXPECT_TRUE(near(colorAt(image, x, y), glm::mix(vein, stone, share), 1e-3)) << x << "," << y;
      least = std::min(least, share);
      most = std::max(most, share);
    }
  EXPECT_LT(least, 0.1);
  EXPECT_GT(most, 0.9);
}

/// A. Gooch et al., equation 2, of l the way to the light: (1 + n.l) / 2 of the warm tone, the rest of the
/// cool one; k_cool = k_blue + alpha k_d, k_warm = k_yellow + beta k_d. A highlight lies over it where the
/// light is mirrored.
TEST_F(GalleryShading, GoochIsWarmTowardTheLightAndCoolAwayFromIt) {
  const Vec3 paint(0.55, 0.25, 0.2), cool = Vec3(0, 0, 0.4) + 0.2 * paint,
                                     warm = Vec3(0.4, 0.4, 0) + 0.6 * paint;
  const auto shown = [&](const Vec3& toLight) {
    return colorAt(plate("gooch.frag", {{"paint", {paint.x, paint.y, paint.z}}}, 0.1, toLight), 20, 40);
  };
  const double slant = std::sqrt(0.75);
  EXPECT_TRUE(near(shown(Vec3(0, 0, 1)), warm + Vec3(0.6), 1e-6)) << "with the whole highlight";
  EXPECT_TRUE(near(shown(Vec3(0, 0, -1)), cool, 1e-6));
  EXPECT_TRUE(near(shown(Vec3(1, 0, 0)), 0.5 * (warm + cool), 1e-6));
  EXPECT_TRUE(near(shown(Vec3(0, slant, 0.5)), 0.75 * warm + 0.25 * cool, 1e-6)) << "0.5^40 of a highlight";
  EXPECT_TRUE(near(shown(Vec3(0, slant, -0.5)), 0.25 * warm + 0.75 * cool, 1e-6));
}

// The node's axes: the plate was turned about X. A place that the mean jumps at is off by one of the 2000.
constexpr double kOfPlaces = 1e-3;

TEST_F(GalleryShading, RingsOfWoodAreLevelsOfTheDistanceToTheTrunksAxis) {
  const Image image = wood(0);
  const auto wanted = [](int x, int y) {
    const Vec3 at = placeOf(x, y);
    return darkness(kRings * std::hypot(at.x - kPith.x, -at.y - kPith.z), kRings * kPixel);
  };
  EXPECT_EQ(wrongPixels(image, wanted, kOfPlaces), 0);
}

TEST_F(GalleryShading, RingsOfWoodWobbleByNoise) {
  const Image image = wood(kWobble);
  const auto wanted = [](int x, int y) {
    const Vec3 at = placeOf(x, y), across(at.x - kPith.x, 0, -at.y - kPith.z), slow = 2.5 * across;
    const double radius = glm::length(across) + kWobble * (valueNoise(slow + 3.7) - 0.5) +
                          0.2 * kWobble * (valueNoise(4.0 * slow) - 0.5);
    return darkness(kRings * radius, kRings * kPixel);
  };
  EXPECT_EQ(wrongPixels(image, wanted, kOfPlaces), 0);
}

/// On the axes of the plate, which was turned about X.
Vec3 onPlate(const Vec3& at) { return {at.x, 0, -at.y}; }

/// The RenderMan shader's: |1/2 - noise| over six octaves, of noise between 0 and 1.
double turbulence(const Vec3& place, int octaves = 6) {
  double sum = 0;
  for (double frequency = 1; frequency < 1 << octaves; frequency *= 2)
    sum += std::abs(0.5 * gradientNoise(4 * frequency * place)) / frequency;
  return sum;
}

// The normal is that of the surface that lies dent * turbulence^3 below, by differences in double. Octaves do
// not fade here: the finest has 128 * 0.12 waves a metre, half a wave a pixel.
TEST_F(GalleryShading, DentsBendTheNormalAsSixOctavesOfTurbulenceDo) {
  constexpr double kScale = 0.12, kDent = 3, kShininess = 20;
  const Vec3 toLight = glm::normalize(Vec3(0.5, 0.3, 0.8)), half = glm::normalize(toLight + Vec3(0, 0, 1));
  const Image image = plate("dent.frag",
                            {{"metal", {1, 1, 1}},
                             {"scale", {kScale}},
                             {"dent", {kDent}},
                             {"octaves", {6}},
                             {"sharp", {3}},
                             {"old", {0}},
                             {"hole", {9}},
                             {"shininess", {kShininess}}},
                            0, toLight);
  const auto wanted = [&](int x, int y) {
    constexpr double kStep = 1e-6;
    const auto depth = [&](double right, double up) {
      return kDent * std::pow(turbulence(kScale * onPlate(placeOf(x, y) + Vec3(right, up, 0))), 3);
    };
    const Vec3 normal = glm::normalize(Vec3((depth(kStep, 0) - depth(-kStep, 0)) / (2 * kStep),
                                            (depth(0, kStep) - depth(0, -kStep)) / (2 * kStep), 1));
    const double up = glm::dot(normal, toLight);
    return up <= 0 ? 0 : up + 3 * std::pow(std::max(glm::dot(normal, half), 0.0), kShininess);
  };
  // At a kink, where a noise is 0, floats may be on its other side: of 1e-7, which are few pixels or none.
  EXPECT_LE(wrongPixels(image, wanted, 2e-5), 2);
}

// A hole is where turbulence is above its level: of a pixel, as much as is on that side of a straight edge.
// Behind it is the white background.
TEST_F(GalleryShading, DentsAreHolesWhereTheyAreDeepest) {
  constexpr double kScale = 0.12, kHole = 0.15;
  Scene scene;
  scene.add(Node{
      .translation = Vec3(0, 0, kHeight),
      .rotation = Rotation{{1, 0, 0}, kPi / 2},
      .surface = rectangle(4, 4),
      .material = scene.add(shaded(
          "dent.frag",
          {{"metal", {0, 0, 0}}, {"scale", {kScale}}, {"octaves", {2}}, {"old", {0}}, {"hole", {kHole}}}))});
  scene.set(RenderSettings{.background = Vec3(1), .ambient = Vec3(0)});
  const Image image = picture(scene);
  const auto wanted = [&](int x, int y) {
    constexpr double kStep = 1e-6;
    const auto deep = [&](double right, double up) {
      return turbulence(kScale * onPlate(placeOf(x, y) + Vec3(right, up, 0)), 2);
    };
    const double slope =
        std::hypot(deep(kStep, 0) - deep(-kStep, 0), deep(0, kStep) - deep(0, -kStep)) / (2 * kStep);
    return std::clamp(0.5 + (deep(0, 0) - kHole) / (slope * kPixel), 0.0, 1.0);
  };
  EXPECT_LE(wrongPixels(image, wanted, 1e-3), 2);
  double holes = 0;
  for (int y = 0; y < kShadedPixels; ++y)
    for (int x = 0; x < kShadedPixels; ++x) holes += image.pixel(x, y)[0];
  EXPECT_GT(holes, 100);
  EXPECT_LT(holes, kShadedPixels * kShadedPixels - 100);
}

// A ball, the camera and the lamp, all turned alike: the same picture.
TEST_F(GalleryShading, DentsTurnWithTheirNode) {
  const auto shown = [&](double angle) {
    const Vec3 axis(1, 2, 0.5);
    const Mat3 turn = rotation(axis, angle);
    Scene scene;
    scene.add(Node{.rotation = Rotation{axis, angle},
                   .surface = sphere(0.8),
                   .material = scene.add(shaded("dent.frag", {{"scale", {0.5}}, {"hole", {0.7}}}))});
    scene.set(RenderSettings{.ambient = Vec3(0.1)});
    addLight(scene, {.position = Vec4(turn * Vec3(0.5, 0.3, 0.8), 0)});
    return draw(scene,
                Camera{.eye = turn * Vec3(0, 0, 5),
                       .up = turn * Vec3(0, 1, 0),
                       .projection = Projection::Orthographic,
                       .height = kWide},
                {kShadedPixels, kShadedPixels})
        .image;
  };
  const Image still = shown(0), turned = shown(0.8);
  const Vec3 background = colorAt(still, 0, 0);
  int different = 0, seen = 0;
  for (int y = 0; y < kShadedPixels; ++y)
    for (int x = 0; x < kShadedPixels; ++x) {
      different += !near(colorAt(still, x, y), colorAt(turned, x, y), 2e-3);
      seen += !near(colorAt(still, x, y), background, 2e-3);
    }
  EXPECT_LE(different, 20);  // at kinks of noise, and its outline
  EXPECT_GT(seen, 500);
}

// What comes from behind is what goes through, from the front what is thrown back, by the cosine on that
// side; a ball between leaf and light, which the leaf hides, shows as its shadow.
TEST_F(GalleryShading, ALeafShinesByTheLightBehindIt) {
  const Vec3 reflected(0.1, 0.2, 0.05), passed(0.3, 0.5, 0.07), ball(0.2, 0.1, -1);
  constexpr double kRadius = 0.4;
  const auto leaf = [&](const Vec3& toLight) {
    Scene scene;
    const Material material = shaded("vegetation.frag", {{"reflectance", {0.1, 0.2, 0.05}},
                                                         {"transmittance", {0.3, 0.5, 0.07}},
                                                         {"relief", {0}},
                                                         {"shine", {0}}});
    scene.add(Node{.rotation = Rotation{{1, 0, 0}, kPi / 2},
                   .surface = rectangle(4, 4),
                   .material = scene.add(material)});
    scene.add(Node{.translation = ball, .surface = sphere(kRadius)});
    scene.add(Node{.rotation = turning({0, 0, 1}, toLight),
                   .light = Light{.type = Light::Type::Directional, .shadow = Light::Shadow::Exact}});
    scene.set(RenderSettings{.ambient = Vec3(0)});
    return picture(scene);
  };
  const Vec3 behind = glm::normalize(Vec3(0.4, -0.2, -0.9)), before = glm::normalize(Vec3(0.4, -0.2, 0.9));
  const Image shone = leaf(behind), lit = leaf(before);
  int dark = 0;
  for (int y = 0; y < kShadedPixels; ++y) {
    for (int x = 0; x < kShadedPixels; ++x) {
      ASSERT_TRUE(near(colorAt(lit, x, y), reflected * before.z, 1e-6)) << x << " " << y;
      const Vec3 from = placeOf(x, y) - ball;
      const double off = glm::length(from - glm::dot(from, behind) * behind);
      if (std::abs(off - kRadius) < 1e-4) continue;
      if (off < kRadius) ++dark;
      ASSERT_TRUE(near(colorAt(shone, x, y), off < kRadius ? Vec3(0) : passed * -behind.z, 1e-6))
          << x << " " << y;
    }
  }
  EXPECT_GT(dark, 400);
}

// The table of Jensen et al. has two digits of what a material reflects, beside what that is computed from,
// which has two or three itself.
TEST_F(GalleryShading, SubsurfaceColoursAreThoseOfTheMeasuredTable) {
  struct Row {
    const char* name;
    double index;
    Vec3 scattering, absorption, reflectance;
  };
  for (const Row& row : {Row{"apple", 1.3, {2.29, 2.39, 1.97}, {0.0030, 0.0034, 0.046}, {0.85, 0.84, 0.53}},
                         Row{"marble", 1.5, {2.19, 2.62, 3.00}, {0.0021, 0.0041, 0.0071}, {0.83, 0.79, 0.75}},
                         Row{"skin", 1.3, {0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}, {0.44, 0.22, 0.13}},
                         Row{"milk", 1.3, {2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}, {0.91, 0.88, 0.76}},
                         Row{"ketchup", 1.3, {0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}, {0.16, 0.01, 0.00}}}) {
    const Image image = plate("subsurface.frag",
                              {{"index", {row.index}},
                               {"scattering", {row.scattering.x, row.scattering.y, row.scattering.z}},
                               {"absorption", {row.absorption.x, row.absorption.y, row.absorption.z}}},
                              1);
    EXPECT_TRUE(near(colorAt(image, 20, 30), row.reflectance, 0.01)) << row.name;
  }
}

// Around a ball that is lit from the right, light is what falls on each place of a ring, spread by the
// exponential that diffusion with absorption has on a line: here summed up, place by place.
TEST_F(GalleryShading, LightLeaksPastTheHorizonAsItDiffusesAlongARing) {
  constexpr double kRadius = 0.9, kScattering = 1, kAbsorption = 0.05;
  const double depth = 1 / std::sqrt(3 * kAbsorption * (kScattering + kAbsorption));  // millimetres
  const auto ring = [](double angle, double k) {
    constexpr int kPlaces = 4000;
    const double far = 20 / k, step = 2 * far / kPlaces;
    double sum = 0;
    for (int i = 0; i < kPlaces; ++i) {
      const double away = -far + (i + 0.5) * step;
      sum += 0.5 * k * std::exp(-k * std::abs(away)) * std::max(std::cos(angle - away), 0.0) * step;
    }
    return sum;
  };
  for (const double k : {1.5, 6.0}) {
    Scene scene;
    const std::vector<double> s(3, kScattering), a(3, kAbsorption);
    scene.add(Node{.surface = sphere(kRadius),
                   .material = scene.add(shaded(
                       "subsurface.frag",
                       {{"scattering", s}, {"absorption", a}, {"index", {1}}, {"size", {k * depth}}}))});
    scene.set(RenderSettings{.ambient = Vec3(0)});
    addLight(scene, {.position = Vec4(1, 0, 0, 0)});
    const Image image = picture(scene);
    // Index 1 reflects nothing inside, but for 0.2 % that the fit leaves.
    const double kept = std::sqrt(3 * kAbsorption / (kScattering + kAbsorption)), fit = 0.0016;
    const double color = 0.5 * kScattering / (kScattering + kAbsorption) *
                         (1 + std::exp(-4.0 / 3 * (1 + fit) / (1 - fit) * kept)) * std::exp(-kept);
    for (int x = 4; x < kShadedPixels - 4; x += 3) {
      const double right = placeOf(x, kShadedPixels / 2).x, up = placeOf(x, kShadedPixels / 2).y;
      if (std::hypot(right, up) > 0.98 * kRadius) continue;
      const double wanted = color * ring(std::acos(right / kRadius), k);
      EXPECT_NEAR(image.pixel(x, kShadedPixels / 2)[0], wanted, 2e-5) << k << " " << x;
    }
  }
}

std::vector<UniformValue> ice(double bump, double ground, const Vec3& flow, double time) {
  return {{"bump", {bump}},
          {"flow", {flow.x, flow.y, flow.z}},
          {"time", {time}},
          {"cloud", {0}},
          {"absorbs", {0, 0, 0}},
          {"sky", {1, 1, 1}},
          {"ground", {ground, ground, ground}},
          {"stone", {0, 0, 0}},
          {"lamps", {0}}};
}

// Of a plate that leans back, under a white sky over black ground: the sky is mirrored, the ground refracted.
TEST_F(GalleryShading, IceMirrorsWhatFresnelsEquationsSay) {
  constexpr double kIndex = 1.31;
  for (const double angle : {0.9, 1.1, 1.3}) {
    Scene scene;
    scene.add(Node{.rotation = Rotation{{1, 0, 0}, kPi / 2 - angle},
                   .surface = rectangle(4, 12),
                   .material = scene.add(shaded("ice.frag", ice(0, 0, Vec3(0), 0)))});
    const double in = std::cos(angle), out = std::sqrt(1 - std::pow(std::sin(angle) / kIndex, 2));
    const double across = (in - kIndex * out) / (in + kIndex * out),
                 along = (kIndex * in - out) / (kIndex * in + out);
    EXPECT_NEAR(picture(scene).pixel(20, 30)[0], 0.5 * (across * across + along * along), 1e-5) << angle;
  }
}

// Water carries the bumps along: in 4 seconds by 8 pixels. Below y = 0 no table is in the way.
TEST_F(GalleryShading, BumpsOfIceRunDownWithTheWater) {
  const Vec3 flow(0, -2 * kPixel, 0);
  const Image first = plate("ice.frag", ice(0.1, 0.1, flow, 0), 0),
              later = plate("ice.frag", ice(0.1, 0.1, flow, 4), 0);
  double least = 1, most = 0;
  for (int y = kShadedPixels / 2 + 9; y < kShadedPixels; ++y) {
    for (int x = 0; x < kShadedPixels; ++x) {
      const double was = first.pixel(x, y - 8)[0];
      ASSERT_NEAR(later.pixel(x, y)[0], was, 1e-4) << x << " " << y;
      least = std::min(least, was);
      most = std::max(most, was);
    }
  }
  EXPECT_GT(most - least, 0.3);
}

/// Per metre of wavelength and the rest, but for what all wavelengths share.
double planck(double nanometres, double kelvin) {
  return std::pow(nanometres, -5) / (std::exp(1.438777e7 / (nanometres * kelvin)) - 1);
}

/// In front of a black plate, of one temperature.
std::vector<UniformValue> flame(double kelvin, double torn) {
  return {{"foot", {0, -0.9, 2}}, {"tall", {3}},   {"wide", {0.5}},   {"hot", {kelvin}},   {"cool", {kelvin}},
          {"torn", {torn}},       {"time", {0.7}}, {"strength", {1}}, {"paint", {0, 0, 0}}};
}

TEST_F(GalleryShading, FlamesHaveTheColoursOfABlackBody) {
  for (const double kelvin : {1500.0, 2400.0}) {
    const Image image = plate("fire.frag", flame(kelvin, 0.9), 0);
    int bright = 0;
    for (int y = 0; y < kShadedPixels; ++y) {
      for (int x = 0; x < kShadedPixels; ++x) {
        const Vec3 color = colorAt(image, x, y);
        if (color.x < 1e-3) continue;
        ++bright;
        ASSERT_NEAR(color.y / color.x * planck(611, kelvin) / planck(549, kelvin), 1, 1e-4);
        ASSERT_NEAR(color.z / color.x * planck(611, kelvin) / planck(464, kelvin), 1, 1e-4);
      }
    }
    EXPECT_GT(bright, 200);
  }
}

// Untorn, it is a body of revolution: what it gives off along the way through it is an integral, of which 24
// steps of 6 cm leave 3e-3 where it is wider than a few of them. Its tip is above the picture.
TEST_F(GalleryShading, AFlameIsSummedUpAlongTheWayThroughIt) {
  constexpr double kKelvin = 1900, kTall = 3, kWideOfFlame = 0.5;
  const Image image = plate("fire.frag", flame(kKelvin, 0), 0);
  const auto wanted = [&](int x, int y) {
    const Vec3 place = placeOf(x, y) - Vec3(0, -0.9, 0);
    const double height = place.y / kTall;
    const double width = height < 0 ? 0 : 2 * kWideOfFlame * std::sqrt(height + 0.03) * (1 - height);
    if (width <= 0) return 0.0;
    constexpr int kSteps = 2000;
    const double step = 2 * kWideOfFlame / kSteps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double deep = -kWideOfFlame + (i + 0.5) * step;
      const double body = 1 - 0.5 * height * height - std::hypot(place.x, deep) / width;
      sum += glm::smoothstep(0.0, 0.5, body) * step;
    }
    return sum;
  };
  EXPECT_EQ(wrongPixels(image, wanted, 3e-3), 0);
  EXPECT_GT(image.pixel(kShadedPixels / 2, kShadedPixels * 3 / 4)[0], 0.3);
}

// Two that mirror all but a fifth, under a sky that is the brighter the higher: outlines, normals, and what
// is seen of one in the other, three times at most. Each mirroring makes an error some ten times as large.
TEST_F(GalleryShading, SpheresMirrorTheSkyAndEachOther) {
  constexpr double kPaint = 0.8;
  constexpr int kBounces = 3;
  struct Ball {
    Vec3 middle;
    double radius;
  };
  const std::array<Ball, 2> balls{{{{-0.45, -0.2, -2}, 0.42}, {{0.5, 0.15, -1.7}, 0.47}}};
  std::vector<double> spheres;
  for (const Ball& ball : balls)
    spheres.insert(spheres.end(), {ball.middle.x, ball.middle.y, ball.middle.z, ball.radius});
  spheres.resize(24, 0);  // of radius 0: no others
  const Image image = plate("spheres.frag",
                            {{"spheres", spheres},
                             {"paints", std::vector<double>(18, kPaint)},
                             {"mirrors", std::vector<double>(6, 1)},
                             {"bounces", {kBounces}},
                             {"ground", {-1000}},
                             {"below", {0, 0, 0}},
                             {"above", {1, 1, 1}}},
                            0);
  int met = 0, twice = 0;
  const auto wanted = [&](int x, int y) {
    Ray ray{placeOf(x, y), {0, 0, -1}};
    double weight = 1;
    for (int k = 0; k <= kBounces; ++k) {
      double nearest = 1e9;
      Vec3 normal;
      for (const Ball& ball : balls) {
        const auto depths = hitSphere(ray, ball.middle, ball.radius);
        if (!depths || depths->first < 1e-6 || depths->first >= nearest) continue;
        nearest = depths->first;
        normal = (ray.at(nearest) - ball.middle) / ball.radius;
      }
      if (nearest == 1e9) return weight * (0.5 + 0.5 * ray.direction.y);
      ++(k == 0 ? met : twice);
      ray = {ray.at(nearest), ray.direction - 2 * glm::dot(ray.direction, normal) * normal};
      weight *= kPaint;
    }
    return 0.0;
  };
  EXPECT_EQ(wrongPixels(image, wanted, 1e-3), 0);
  EXPECT_GT(met, 1000);
  EXPECT_GT(twice, 50);
}

}  // namespace
}  // namespace luxo::test
