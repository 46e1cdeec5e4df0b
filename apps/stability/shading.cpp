// SPDX-License-Identifier: Apache-2.0
// ST-28 to 31, 33: the numbers behind a shaded pixel, as the device computes them with the shaders' own
// functions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "draw/device_precision.h"
#include "stability/cases.h"
#include "stability/device_formula.h"
#include "stability/pictures.h"
#include "surface/library.h"

namespace luxo {
namespace {

/// What the illumination asks of the shader that includes it; here nobody does.
constexpr std::string_view kNoLights = R"(
#include "lib/illumination.glsl"
LightData lightAt(uint i) { return LightData(vec4(0), vec3(0), 0u); }
ShadeData shadeAt(uint i) { return ShadeData(vec3(0), 0.0, 0.0, 0); }
SpotData spotAt(uint i) { return SpotData(vec3(0), vec3(0), 0.0, 0.0); }
)";

constexpr std::string_view kHead =
    "void formula(float u, float v, out vec4 first, out vec4 second, out vec4 third) {\n"
    "  second = third = vec4(0);\n";

/// Runs a body of GLSL that sets `first`: for every k in 0..count-1, with u = k and the inputs of all.
std::vector<std::vector<float>> run(StressContext& context, std::string_view library, std::string_view body,
                                    std::size_t count, const std::vector<double>& inputs) {
  const std::string glsl = fmt::format("{}\n{}{}}}\n", library, kHead, body);
  std::vector<Vec2f> points;
  for (std::size_t k = 0; k < count; ++k) points.emplace_back(static_cast<float>(k), 0.0f);
  return DeviceFormula(context.device(), glsl, 4).at(points, inputs);
}

void append(std::vector<double>& inputs, const Vec3f& v) { inputs.insert(inputs.end(), {v.x, v.y, v.z}); }

// ST-28 -----------------------------------------------------------------------------------------------------

/// The device's self-test, measured anew; what formulas draw with must hold whatever the driver does.
std::vector<Measurement> selfTest(StressContext& context) {
  const SinCosError error = sinCosError(context.device(), {});
  return {
      atMost("error of sin and cos as formulas draw with them", error.ofFormulas, 0x1p-20),
      atLeast("what Vulkan promises of the driver's: 2^-11 over their error", 0x1p-11 / error.ofDriver, 1)};
}

// ST-29 -----------------------------------------------------------------------------------------------------

/// The highlight (N.H)^s of a material, where the exponent is in v, for cosines from 0 to 1.
std::vector<Measurement> highlightSweep(StressContext& context, std::string_view expression) {
  constexpr int kSteps = 65536;
  const std::string glsl = fmt::format("{}\n{}  float x = u, s = v;\n  first = vec4({}, 0, 0, 0);\n}}\n",
                                       kNoLights, kHead, expression);
  DeviceFormula formula(context.device(), glsl, 1);
  double worst = 0, worstExponent = 0, zeroToZero = 0;
  std::int64_t falling = 0;
  for (const double s : {0.0, 1.0, 8.0, 30.0, 64.0, 128.0, 512.0, 1e3, 4e3, 1e4}) {
    std::vector<Vec2f> points;
    for (int i = 0; i <= kSteps; ++i)
      points.emplace_back(static_cast<float>(i) / kSteps, static_cast<float>(s));
    const std::vector<float> values = formula.at(points, {})[0];
    for (int i = 0; i <= kSteps; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double allowed = 1e-6 + 1e-7 * s, error = std::abs(values[k] - std::pow(double{points[k].x}, s));
      if (!(error / allowed <= worst)) {
        worst = error / allowed;
        worstExponent = s;
      }
      if (i > 0) falling += !(values[k] >= values[k - 1]);
    }
    if (s == 0) zeroToZero = values[0];
  }
  return {atMost(fmt::format("error over 1e-6 + 1e-7 s (largest at s = {})", worstExponent), worst, 1),
          atMost("distance of 0^0 from 1", std::abs(zeroToZero - 1), 0),
          none("places where it falls with growing N.H", falling, "places")};
}

std::vector<Measurement> blinn(StressContext& context) {
  return highlightSweep(context, "highlight(vec3(0, 0, 1), vec3(sqrt((1.0 - x) * (1.0 + x)), 0, x), s)");
}

std::vector<Measurement> blinnByPow(StressContext& context) { return highlightSweep(context, "pow(x, s)"); }

// ST-30 -----------------------------------------------------------------------------------------------------

/// A point to shade: three unit vectors, as floats.
struct Shaded {
  Vec3f n, l, v;
};

/// Light from behind the viewer's back to the point, or grazing, or both, or anywhere.
std::vector<Shaded> degenerateHalves(int count) {
  std::mt19937 random(30);  // NOLINT: the same numbers every time
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> exponent(-9, 0), choice(0, 1);
  const auto anywhere = [&] { return unit(Vec3(gauss(random), gauss(random), gauss(random))); };
  const auto little = [&] {
    const double size = std::pow(10, exponent(random));
    return choice(random) < 0.2 ? Vec3(0) : size * anywhere();
  };
  std::vector<Shaded> samples;
  for (int k = 0; k < count; ++k) {
    // Whole axes make products with the normal exact, so that the sign of N.L is what it seems.
    const int axis = k % 3;
    const Vec3 n = Vec3(axis == 0, axis == 1, axis == 2) * (k % 2 == 0 ? 1.0 : -1.0);
    const Vec3 across = unit(glm::cross(n, anywhere()));
    const auto grazing = [&] { return unit(across + glm::dot(little(), n) * n); };
    const Vec3 l = k % 4 == 0 ? anywhere() : grazing();
    const Vec3 v = k % 4 == 3 ? grazing() : unit(-l + little());
    samples.push_back({Vec3f(n), Vec3f(l), k % 5 == 0 ? -Vec3f(l) : Vec3f(v)});
  }
  return samples;
}

std::vector<Measurement> degenerateHalf(StressContext& context) {
  const std::vector<Shaded> samples = degenerateHalves(context.of(300000, 60000));
  std::vector<double> inputs;
  for (const Shaded& s : samples)
    for (const Vec3f& vector : {s.n, s.l, s.v}) append(inputs, vector);
  const auto values = run(context, kNoLights, R"(
  uint k = 9 * uint(u);
  vec3 n = vec3(parameterAt(k), parameterAt(k + 1), parameterAt(k + 2));
  vec3 l = vec3(parameterAt(k + 3), parameterAt(k + 4), parameterAt(k + 5));
  vec3 h = vec3(parameterAt(k + 6), parameterAt(k + 7), parameterAt(k + 8));
  first.xyz = reflected(Material(vec3(0), vec3(0), vec3(1, 0.5, 0.25), 0.5, 0u),
                        LightData(vec4(0), vec3(1), 0u), 3.0 * l, n, h);
  first.w = reflected(Material(vec3(0), vec3(0), vec3(1), 0.0, 0u), LightData(vec4(0), vec3(1), 0u), l, n, h).x;
)",
                          samples.size(), inputs);
  std::int64_t notFinite = 0, below = 0, belowLit = 0, above = 0, tooBright = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const bool up = glm::dot(samples[k].n, samples[k].l) > 0;
    ++(up ? above : below);
    for (std::size_t c = 0; c < 4; ++c) {
      const float value = values[c][k];
      notFinite += !std::isfinite(value);
      belowLit += !up && value != 0;
      tooBright += !(value >= 0 && value <= 1);
    }
  }
  return {none("values that are not finite", notFinite, "values"),
          none("values other than 0 where N.L <= 0", belowLit, "values"),
          none("values outside 0..1", tooBright, "values"),
          atLeast("points with N.L <= 0", below, 1000, "points"),
          atLeast("points with N.L > 0", above, 1000, "points")};
}

// ST-31 -----------------------------------------------------------------------------------------------------

/// The smallest normal number of float; a device may take smaller ones for 0.
constexpr double kSmallest = 0x1p-126;

/// Vectors whose largest component runs from 1e-38 to 1e38, and at last the zero vector.
std::vector<Vec3f> vectorsOfAllSizes(int count) {
  std::mt19937 random(31);  // NOLINT: the same numbers every time
  std::normal_distribution<double> gauss;
  std::vector<Vec3f> vectors;
  for (int k = 0; k < count; ++k) {
    const double size = std::max(std::pow(10, -38 + 76.0 * k / (count - 1)), kSmallest);
    Vec3 v(gauss(random), k % 7 == 0 ? 0 : gauss(random), k % 5 == 0 ? 0 : gauss(random));
    v /= std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    vectors.emplace_back(Vec3f(size * v));
  }
  vectors.emplace_back(0.0f);
  return vectors;
}

std::vector<Measurement> normalised(StressContext& context, std::string_view library,
                                    std::string_view expression) {
  const std::vector<Vec3f> vectors = vectorsOfAllSizes(context.of(100000, 20000));
  std::vector<double> inputs;
  for (const Vec3f& v : vectors) append(inputs, v);
  const auto values = run(context, library,
                          fmt::format(R"(
  uint k = 3 * uint(u);
  vec3 x = vec3(parameterAt(k), parameterAt(k + 1), parameterAt(k + 2));
  first = vec4({}, 0);
)",
                                      expression),
                          vectors.size(), inputs);
  const auto result = [&](std::size_t k) { return Vec3(values[0][k], values[1][k], values[2][k]); };
  double worst = 0, worstAngle = 0, wrongFrom = std::numeric_limits<double>::infinity(), wrongTo = 0;
  const std::size_t zero = vectors.size() - 1;
  for (std::size_t k = 0; k < zero; ++k) {
    const double ulps = std::abs(glm::length(result(k)) - 1) * 0x1p23;
    if (!(ulps <= worst)) worst = std::isnan(ulps) ? std::numeric_limits<double>::infinity() : ulps;
    const Vec3 truth = unit(Vec3(vectors[k]));
    worstAngle = std::max(worstAngle, glm::length(result(k) - truth));
    if (ulps <= 2) continue;
    const double size = glm::length(Vec3(vectors[k]));
    // Which lengths fail: those from 0 to `wrongTo` or from `wrongFrom` on.
    if (size < 1) wrongTo = std::max(wrongTo, size);
    if (size >= 1) wrongFrom = std::min(wrongFrom, size);
  }
  std::string where;
  if (worst > 2) where = fmt::format(" (wrong below {:.2g} and above {:.2g})", wrongTo, wrongFrom);
  return {atMost("length's distance from 1" + where, worst, 2, "ulp"),
          none("components of the zero vector's direction that are not 0",
               (result(zero).x != 0) + (result(zero).y != 0) + (result(zero).z != 0), "components")};
}

std::vector<Measurement> normalise(StressContext& context) {
  return normalised(context, "#include \"lib/scene.glsl\"", "unitOrZero(x)");
}

std::vector<Measurement> normaliseBare(StressContext& context) {
  return normalised(context, "", "normalize(x)");
}

// ST-33 -----------------------------------------------------------------------------------------------------

/// A ball and a floor under one light of inverse square attenuation, which is `at`.
Scene litFrom(const Vec3& at, double intensity) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0.05)});
  scene.add(Node{.surface = sphere(1)});
  scene.add(Node{.translation = Vec3(0, -1, 0), .surface = rectangle(8, 8)});
  scene.add(Node{.translation = at,
                 .light = Light{.intensity = intensity, .attenuation = Light::Attenuation::InverseSquare}});
  scene.add(Camera{.eye = Vec3(0, 0.5, 4), .lookAt = Vec3(0, 0, 0)});
  return scene;
}

/// A point that faces a light of that intensity, from distances down to the smallest float and 0.
std::int64_t notFiniteNearLight(StressContext& context) {
  std::vector<double> inputs;
  for (int power = -149; power <= 0; ++power) inputs.push_back(std::ldexp(1.0, power));
  inputs.push_back(0);
  const auto values = run(context, kNoLights, R"(
  vec3 toLight = vec3(0, parameterAt(uint(u)), 0);
  first.xyz = reflected(Material(vec3(0), vec3(1), vec3(1), 10.0, 0u), LightData(vec4(0), vec3(1e6), 1u), toLight,
                        vec3(0, 1, 0), vec3(0.6, 0.8, 0));
)",
                          inputs.size(), inputs);
  return std::ranges::count_if(values[0], [](float value) { return !std::isfinite(value); });
}

std::vector<Measurement> hazardousLights(StressContext& context) {
  constexpr double kIntensity = 1e6;
  struct Place {
    std::string_view name;
    Vec3 at;
  };
  // What the pixel in the middle shows, in single precision as the device has it.
  const Scene unlit = litFrom({0, 100, 0}, 0);
  const Snapshot snapshot = takeSnapshot(unlit, 0, context.size());
  const int middle = context.size().width / 2;
  const Vec3 seen = colorAt(context.draw(snapshot, {.output = Output::Position}).image, middle, middle);
  const Place places[] = {{"the origin, inside the ball", Vec3(0)},
                          {"the ball's wall", unit(Vec3(0.1, 0.3, 1))},
                          {"the point that a pixel shows", seen},
                          {"the ball's pole", {0, 1, 0}},
                          {"the floor", {0.5, -1, 1.5}},
                          {"the eye", {0, 0.5, 4}}};
  std::vector<Measurement> result;
  for (const Place& place : places) {
    const Image image = context.draw(takeSnapshot(litFrom(place.at, kIntensity), 0, context.size())).image;
    result.push_back(none(fmt::format("light at {}: samples that are not finite", place.name),
                          samplesNotFinite(image), "samples"));
  }
  result.push_back(
      none("values that are not finite at distances from 0 to 1 m", notFiniteNearLight(context), "values"));
  // Inside the ball nothing outside of it is lit but the floor: the ball turns its back to the light.
  const Image inside = context.draw(takeSnapshot(litFrom(Vec3(0), kIntensity), 0, context.size())).image;
  const Image ids = context.draw(snapshot, {.output = Output::Id}).image;
  const Image dark = context.draw(snapshot).image;
  std::int64_t litBall = 0, ball = 0;
  for (int y = 0; y < ids.height(); ++y)
    for (int x = 0; x < ids.width(); ++x) {
      if (ids.pixel(x, y)[0] != 1) continue;
      ++ball;
      litBall += colorAt(inside, x, y) != colorAt(dark, x, y);
    }
  result.push_back(none("pixels of the ball lit from inside through its wall", litBall, "pixels"));
  result.push_back(atLeast("pixels of the ball", ball, context.of(60000, 4000), "pixels"));
  return result;
}

}  // namespace

std::vector<StressCase> shadingCases() {
  return {
      {.id = "ST-28", .title = "sin and cos of the device", .run = selfTest},
      {.id = "ST-29", .title = "Blinn's highlight", .run = blinn, .canary = blinnByPow},
      {.id = "ST-30", .title = "no half vector, or a grazing one", .run = degenerateHalf},
      {.id = "ST-31", .title = "unit vectors from 1e-38 to 1e38", .run = normalise, .canary = normaliseBare},
      {.id = "ST-33", .title = "lights inside, on and before surfaces", .run = hazardousLights}};
}

}  // namespace luxo
