// SPDX-License-Identifier: Apache-2.0
// Isolines of scene files, and how much of a pixel a line covers, against areas of polygons.
#include "scene/isolines.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/snapshot.h"
#include "scene_test_support.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

/// What of a convex polygon is where f >= 0, f linear.
template <class F>
std::vector<Vec2> cut(const std::vector<Vec2>& polygon, const F& f) {
  std::vector<Vec2> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    if (f(p) >= 0) rest.push_back(p);
    if ((f(p) >= 0) != (f(q) >= 0)) rest.push_back(p + (q - p) * (f(p) / (f(p) - f(q))));
  }
  return rest;
}

double areaOf(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    twice += p.x * q.y - p.y * q.x;
  }
  return 0.5 * std::abs(twice);
}

/// Of a unit square, in the middle of which the field is `level`.
double bandArea(double level, const Vec2& perPixel, double width) {
  const double half = 0.5 * width * glm::length(perPixel);
  std::vector<Vec2> square{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  square = cut(square, [&](const Vec2& p) { return half - (level + glm::dot(perPixel, p)); });
  if (square.empty()) return 0;
  square = cut(square, [&](const Vec2& p) { return half + (level + glm::dot(perPixel, p)); });
  return square.empty() ? 0 : areaOf(square);
}

TEST(LineCoverage, IsTheAreaOfABandInASquare) {
  for (const Vec2& perPixel :
       {Vec2(0.1, 0), Vec2(0, -0.2), Vec2(0.1, 0.1), Vec2(-0.3, 0.07), Vec2(0.2, 1e-12)})
    for (const double width : {0.2, 1.0, 3.1})
      for (double level = -0.7; level < 0.7; level += 0.013) {
        const LineField one{.level = level, .repeats = false}, many{.level = level};
        EXPECT_NEAR(lineCoverage(one, perPixel, width), bandArea(level, perPixel, width), 1e-12);
        double all = 0;
        for (int k = -3; k <= 3; ++k) all += bandArea(level - k, perPixel, width);
        EXPECT_NEAR(lineCoverage(many, perPixel, width), std::min(all, 1.0), 1e-12);
      }
}

TEST(LineCoverage, IsDefinedWhateverTheFieldIs) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double level : {0.0, 0.3, kNan, kInfinity, 1e300})
    for (const double slope : {0.0, 1e-300, 1e-9, 1.0, 1e29, 1e300, kInfinity, kNan})
      for (const double other : {0.0, slope})
        for (const double width : {0.0, 1.0, 1e3, kNan})
          for (const bool repeats : {false, true}) {
            const double c = lineCoverage({level, Vec2(0), std::abs(level), repeats}, {slope, other}, width);
            EXPECT_TRUE(c >= 0 && c <= 1 + 1e-12) << level << " " << slope << " " << width << " " << c;
          }
}

SceneFile fileWith(const std::string& material, const std::string& surface = R"({ "type": "torus" })") {
  return parseScene(fmt::format(R"({{ "luxo": 1, "params": {{ "k": 3 }},
"materials": {{ "m": {{ {} }} }},
"surfaces": {{ "s": {} }}, "nodes": [ {{ "surface": "s", "material": "m" }} ] }})",
                                material, surface),
                    "scene");
}

Material materialWith(const std::string& material, const std::string& surface = R"({ "type": "torus" })") {
  const Snapshot snapshot = takeSnapshot(buildScene(fileWith(material, surface)), 0, {8, 8});
  return snapshot.materials[snapshot.nodes[0].material.index];
}

/// As a pixel sees it.
Vec3 colorAt(const Material& material, const Vec2& uv, const Mat2& footprint) {
  return material.underIsolines(material.diffuseAt(uv.x, uv.y), uv.x, uv.y, footprint);
}

TEST(SceneIsolines, AGridHasAsManyLinesAsIsSaid) {
  const Material material =
      materialWith(R"("diffuse": 1, "isolines": { "u": 28, "v": "4+k", "width": "2px" })");
  ASSERT_TRUE(material.isolines.valid());
  const Domain domain = makeSurface("torus").domain();
  constexpr int kSteps = 2800;
  const auto count = [&](const auto& at, const Mat2& footprint) {
    int begun = 0;
    bool was = colorAt(material, at(-0.5), footprint).x < 0.5;
    for (int i = 0; i < kSteps; ++i) {
      const Vec2 p = at(i + 0.5);
      const bool is = colorAt(material, p, footprint).x < 0.5;
      begun += is && !was;
      was = is;
    }
    return begun;
  };
  const double stepU = domain.u.width() / kSteps, stepV = domain.v.width() / kSteps;
  // Between two lines of the other family.
  const double u = domain.u.lo + domain.u.width() / 56, v = domain.v.lo + domain.v.width() / 14;
  EXPECT_EQ(count([&](double i) { return Vec2(domain.u.lo + i * stepU, v); }, Mat2(stepU, 0, 0, stepV)), 28);
  EXPECT_EQ(count([&](double i) { return Vec2(u, domain.v.lo + i * stepV); }, Mat2(stepU, 0, 0, stepV)), 7);
}

TEST(SceneIsolines, LieOverTheColourInTheirOwn) {
  const Material material = materialWith(
      R"("diffuse": ["u", 1, 0], "let": { "w": "2v" },
         "isolines": [ { "of": "w", "at": 1, "width": 1, "color": "#0000ff80" }, { "of": "k*u", "color": [1, 0, 0] } ])");
  const Mat2 footprint(0.01, 0, 0, 0.01);
  const auto at = [&](double u, double v) { return colorAt(material, {u, v}, footprint); };
  const double a = 128 / 255.0;
  expectNear(at(0.5, 0.25), {0.5, 1, 0}, 1e-12);
  expectNear(at(0.5, 0.5), {0.5 * (1 - a), 1 - a, a}, 1e-12);
  expectNear(at(0.001, 0.5), {1, 0, 0}, 1e-12);
}

TEST(SceneIsolines, AreWrittenAsTheyAreRead) {
  const SceneFile file = fileWith(
      R"("let": { "w": "2v" }, "isolines": [ { "of": "w", "step": 0.5, "at": "k", "color": "#0012ff" },
         { "u": 28, "v": 14, "width": "1.2px", "opacity": 0.25 } ])");
  EXPECT_EQ(parseScene(writeScene(file), "again").materials, file.materials);
}

TEST(SceneIsolines, MistakesAreToldAtTheirPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {R"("isolines": { "width": 2 })", "nothing says where these isolines are"},
      {R"("isolines": { "u": 3, "step": 0.1 })", "this is of the lines of a formula"},
      {R"("isolines": { "of": "q" })", "unknown name 'q'"},
      {R"("isolines": { "of": "u", "step": 0 })", "from 1e-18"},
      {R"("isolines": { "u": 0 })", "from 1 to 100000"},
      {R"("isolines": { "u": 3, "width": -1 })", "from 0 to 1000 pixels"},
      {R"("isolines": { "u": 3, "color": "#0000000g" })", "is not a colour"},
      {R"("isolines": { "u": 3, "opacity": 2 })", "from 0 to 1"},
      {R"("isolines": { "of": "u", "stop": 1 })", "did you mean"},
      {R"("isolines": [ { "of": "u", "u": 1, "v": 1 }, { "of": "u", "u": 1, "v": 1 }, { "of": "u", "u": 1, "v": 1 } ])",
       "more than 8 families"}};
  for (const auto& [material, said] : cases) {
    SCOPED_TRACE(material);
    expectSceneError([&, material = material] { static_cast<void>(materialWith(material)); },
                     {"scene:2:", said});
  }
}

// Beside a formula for the colour or the opacity, and beside neither; their parameters are their own.
TEST(SceneIsolines, AreBesideWhateverColours) {
  const Mat2 footprint(0.01, 0, 0, 0.01);
  const Material plain = materialWith(R"("diffuse": [0.5, 1, 0], "isolines": { "of": "k*u", "width": 1 })");
  EXPECT_FALSE(plain.diffusePattern.valid());
  EXPECT_EQ(plain.isolineParameters, std::vector<double>{3});
  expectNear(colorAt(plain, {0.5, 0.5}, footprint), {0.5, 1, 0}, 1e-12);
  expectNear(colorAt(plain, {0, 0.5}, footprint), {0, 0, 0}, 1e-12);
  const Material veil =
      materialWith(R"a("opacity": "0.5+0.1*sin(k*v)", "isolines": { "of": "u", "color": [0, 0, 1] })a");
  EXPECT_NEAR(veil.opacityAt(0, 0.5), 0.5 + 0.1 * std::sin(1.5), 1e-12);
  expectNear(colorAt(veil, {0, 0.5}, footprint), {0, 0, 1}, 1e-12);
}

// Of equal formulas, and only of these.
TEST(SceneIsolines, CompareByContent) {
  const auto isolines = [](const char* formula) {
    return materialWith(fmt::format(R"("isolines": {{ "of": "{}", "step": 0.1 }})", formula)).isolines;
  };
  EXPECT_EQ(isolines("u+v"), isolines("u+v"));
  EXPECT_NE(isolines("u+v"), isolines("u-v"));
  EXPECT_NE(isolines("u+v"), IsolineSet());
}

}  // namespace
}  // namespace luxo::test
