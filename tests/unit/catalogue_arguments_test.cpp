// SPDX-License-Identifier: Apache-2.0
// What the catalogue's surfaces are made from: arguments constant, moving and wrong; and how people read it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "surface/catalogue.h"
#include "surface/library.h"

namespace luxo {
namespace {

using testing::HasSubstr;

/// What makeSurface() says, message and hint.
std::string refusal(std::string_view name, const std::vector<SurfaceArgument>& arguments) {
  try {
    const Surface surface = makeSurface(name, arguments);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    return std::string(error.what()) + " | " + error.hint();
  }
  return "made";
}

TEST(CatalogueArguments, EachBadNumberIsNamedWithItsArgument) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const CatalogueEntry& entry : catalogue())
    for (const CatalogueArgument& argument : entry.arguments)
      for (const double bad :
           {std::nan(""), infinity, -infinity, 1e308, -1e308, std::nextafter(argument.range.lo, -infinity),
            std::nextafter(argument.range.hi, infinity)})
        for (std::size_t component = 0; component < argument.initial.size(); ++component) {
          SurfaceArgument given{std::string(argument.name),
                                {argument.initial.begin(), argument.initial.end()}};
          given.components[component] = bad;
          const std::string message = refusal(entry.name, {given});
          EXPECT_THAT(message, HasSubstr(std::string(entry.name) + ": " + std::string(argument.name)));
          EXPECT_THAT(message, HasSubstr(std::string(argument.name) + " must be a"));
        }
}

TEST(CatalogueArguments, MessagesSayWhatIsAllowed) {
  EXPECT_EQ(refusal("sphere", {{"radius", {0.0}}}),
            "sphere: radius is 0 | radius must be a length from 1e-12 to 1000000000000 metres");
  EXPECT_THAT(refusal("rectangle", {{"size", {1.0, -2.0}}}), HasSubstr("rectangle: size[1] is -2"));
  EXPECT_THAT(refusal("mobius", {{"half_twists", {1.5}}}), HasSubstr("a whole number from 0 to 100"));
  EXPECT_THAT(refusal("sphere", {{"raduis", {1.0}}}),
              HasSubstr("no argument 'raduis' | did you mean 'radius'?"));
  EXPECT_THAT(refusal("sphere", {{"radius", {1.0}}, {"radius", {2.0}}}), HasSubstr("given twice"));
  EXPECT_THAT(refusal("ellipsoid", {{"radii", {1.0, 2.0}}}), HasSubstr("radii takes 3 numbers, not 2"));
  EXPECT_THAT(refusal("torus", {{"major", {1.0}}, {"minor", {1.0}}}), HasSubstr("major larger than minor"));
  EXPECT_THAT(refusal("cone", {{"radius", {0.0}}, {"top_radius", {0.0}}}), HasSubstr("larger than 0"));
  EXPECT_THAT(refusal("torus_knot", {{"p", {2.0}}, {"q", {4.0}}}), HasSubstr("common divisor"));
  EXPECT_THAT(refusal("torus_knot", {{"tube", {0.8}}}), HasSubstr("radius of curvature"));
  EXPECT_THAT(refusal("shpere", {}), HasSubstr("there is no surface 'shpere' | did you mean 'sphere'?"));
  EXPECT_THAT(refusal("mobius", {{"half_twists", {[](double t) { return t; }}}}),
              HasSubstr("must be a constant"));
  EXPECT_EQ(refusal("cone", {{"radius", {0.0}}, {"top_radius", {1.0}}}), "made");
}

TEST(CatalogueArguments, MovingOnesGiveTheSameSurface) {
  // Folded or not, the formula is the same but for the order of a few roundings.
  for (const CatalogueEntry& entry : catalogue()) {
    std::vector<SurfaceArgument> moving;
    std::vector<double> values;
    for (const CatalogueArgument& argument : entry.arguments) {
      if (!argument.mayMove()) continue;
      SurfaceArgument given{std::string(argument.name), {}};
      for (const double value : argument.initial) {
        given.components.emplace_back([value](double) { return value; });
        values.push_back(value);
      }
      moving.push_back(given);
    }
    const Surface still = makeSurface(entry), moved = makeSurface(entry, moving);
    ASSERT_EQ(moved.parameters().size(), values.size()) << entry.name;
    EXPECT_TRUE(still.parameters().empty()) << entry.name;
    if (entry.name.starts_with("super")) continue;  // Other pieces: see the next test.
    for (double u = 0.03; u < 1; u += 0.11)
      for (double v = 0.04; v < 1; v += 0.12)
        ASSERT_LE(glm::length(moved.position(u, v, values) - still.position(u, v)), 1e-13)
            << entry.name << " at " << u << ", " << v;
  }
}

TEST(CatalogueArguments, MovingExponentsStayOnTheSurface) {
  const Surface moving =
      makeSurface("superellipsoid", {{"exponents", {[](double t) { return 0.5 + t; }, 1.0}}});
  for (const double e : {0.2, 0.5, 1.0, 1.7, 2.0})
    for (double u = 0; u <= 1; u += 0.05)
      for (double v = 0; v <= 1; v += 0.05) {
        const Vec3 p = moving.position(u, v, std::vector{e});
        const double residual = std::pow(std::hypot(p.x, p.z), 2 / e) + std::pow(std::abs(p.y), 2 / e) - 1;
        ASSERT_NEAR(residual, 0, 1e-13) << e << " at " << u << ", " << v;
      }
}

TEST(CatalogueArguments, TheyMoveWithTimeAndParameters) {
  const Animated<double> byTime([](double t) { return 1 + t; });
  const Animated<double> byParameter([](const Moment& m) { return m.parameters[0]; }, DependsOn::Parameters);
  const std::vector<double> values{0.25};
  const Surface surface =
      makeSurface("torus", {{"major", {byTime}}, {"minor", {byParameter}}}, Moment(0, values));
  ASSERT_EQ(surface.parameters().size(), 2u);
  EXPECT_EQ(surface.parameters()[0].at(Moment(2, values)), 3);
  EXPECT_EQ(surface.parameters()[1].at(Moment(2, values)), 0.25);
  EXPECT_TRUE(surface.parameters()[0].movesWithTime());
  EXPECT_FALSE(surface.parameters()[1].movesWithTime());
  EXPECT_TRUE(surface.closed());
}

TEST(CatalogueArguments, MovingOnesAreCheckedWhereverTheyAre) {
  const Surface growing =
      makeSurface("torus", {{"major", {2.0}}, {"minor", {[](double t) { return 1 + t; }}}});
  EXPECT_EQ(growing.parameters()[0].at(0.5), 1.5);
  const auto said = [&](double time) -> std::string {
    try {
      (void)growing.parameters()[0].at(time);
    } catch (const Error& error) {
      return std::string(error.what()) + " | " + error.hint();
    }
    return "nothing";
  };
  EXPECT_THAT(said(1), HasSubstr("major 2, minor 2 | torus needs major larger than minor"));
  EXPECT_THAT(said(-1), HasSubstr("torus: minor is 0 at time -1 | minor must be a length from"));
}

TEST(CatalogueArguments, TheCppFunctionsAreTheSameSurfaces) {
  const std::vector<std::pair<Surface, Surface>> pairs = {
      {rectangle(3, 2), makeSurface("rectangle", {{"size", {3.0, 2.0}}})},
      {disk(2), makeSurface("disk", {{"radius", {2.0}}})},
      {cylinder(2, 3), makeSurface("cylinder", {{"radius", {2.0}}, {"height", {3.0}}})},
      {cone(2, 1, 3), makeSurface("cone", {{"radius", {2.0}}, {"top_radius", {1.0}}, {"height", {3.0}}})},
      {sphere(2), makeSurface("sphere", {{"radius", {2.0}}})},
      {paraboloid(0.2, 1.8), makeSurface("paraboloid", {{"focal_length", {0.2}}, {"height", {1.8}}})},
      {torus(2, 1), makeSurface("torus", {{"major", {2.0}}, {"minor", {1.0}}})},
      {flag(), makeSurface("flag")}};
  for (const auto& [fromCpp, named] : pairs)
    for (double u = 0; u <= 1; u += 0.125)
      for (double v = 0; v <= 1; v += 0.125)
        ASSERT_EQ(fromCpp.position(u, v), named.position(u, v)) << named.name();
  EXPECT_EQ(paraboloid(0.2, 1.8).paraboloid()->focalLength, 0.2);
}

}  // namespace
}  // namespace luxo
