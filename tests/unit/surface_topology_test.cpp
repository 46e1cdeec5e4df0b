// SPDX-License-Identifier: Apache-2.0
#include "surface/topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "surface_samples.h"

namespace luxo {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

Edge kindOf(const Topology& t, Side side, std::uint32_t patch = 0) { return t.edge(patch, side).kind; }
Vec3 normalOf(const Topology& t, Side side) { return t.edge(0, side).normal; }

TEST(Topology, EdgesOrientationAndClosednessOfEverySurface) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    SCOPED_TRACE(sample.name);
    const Topology& t = sample.surface.topology();
    EXPECT_EQ(kindOf(t, Side::UMin), sample.u);
    EXPECT_EQ(kindOf(t, Side::UMax), sample.u);
    EXPECT_EQ(kindOf(t, Side::VMin), sample.vMin);
    EXPECT_EQ(kindOf(t, Side::VMax), sample.vMax);
    EXPECT_EQ(t.orientation(), sample.orientation);
    EXPECT_EQ(t.eulerCharacteristic, sample.euler);
    EXPECT_EQ(t.borderless, sample.borders == 0);
    EXPECT_EQ(t.orientable, sample.orientable);
    EXPECT_EQ(t.closed, sample.volume.has_value());
    EXPECT_EQ(sample.surface.closed(), sample.volume.has_value());
    EXPECT_EQ(t.seamU(), sample.u == Edge::Seam && sample.orientable);
  }
}

TEST(Topology, PolesHaveTheLimitOfTheCrossProduct) {
  // Before the orientation is applied: the disk's Su x Sv points down.
  const Topology ball = sphere(2).topology(), plate = disk(2).topology(),
                 shade = paraboloid(0.2, 1.8).topology();
  EXPECT_NEAR(glm::length(normalOf(ball, Side::VMin) - Vec3(0, -1, 0)), 0, 1e-15);
  EXPECT_NEAR(glm::length(normalOf(ball, Side::VMax) - Vec3(0, 1, 0)), 0, 1e-15);
  EXPECT_NEAR(glm::length(normalOf(plate, Side::VMin) - Vec3(0, -1, 0)), 0, 1e-15);
  EXPECT_NEAR(glm::length(normalOf(shade, Side::VMin) - Vec3(0, -1, 0)), 0, 1e-15);
}

TEST(Topology, SeamsCloseToRounding) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    const Topology& t = sample.surface.topology();
    const Domain& d = sample.surface.domain();
    for (double s = 0; s <= 1; s += 1.0 / 64) {
      const double u = d.u.lo + s * d.u.width(), v = d.v.lo + s * d.v.width();
      const auto at = [&](double x, double y) { return sample.surface.position(x, y, sample.parameters); };
      EXPECT_TRUE(!t.seamU() || glm::length(at(d.u.lo, v) - at(d.u.hi, v)) <= 1e-12) << sample.name;
      EXPECT_TRUE(!t.seamV() || glm::length(at(u, d.v.lo) - at(u, d.v.hi)) <= 1e-12) << sample.name;
    }
  }
}

TEST(Topology, InwardFormulasAreFoundOut) {
  // Azimuth and polar angle, in that order: Su x Sv points into the sphere.
  const Surface polar = surface(
      [](auto u, auto v) { return point(cos(u) * sin(v), sin(u) * sin(v), cos(v)); }, {{0, kTau}, {0, kPi}});
  EXPECT_TRUE(polar.closed());
  EXPECT_EQ(polar.topology().orientation(), -1);
  EXPECT_EQ(kindOf(polar.topology(), Side::VMin), Edge::Pole);
  EXPECT_EQ(kindOf(polar.topology(), Side::VMax), Edge::Pole);
  EXPECT_NEAR(glm::length(polar.normal(1, 0) - Vec3(0, 0, 1)), 0, 1e-15);
  EXPECT_NEAR(glm::length(polar.normal(1, kPi) - Vec3(0, 0, -1)), 0, 1e-15);
  // A stated orientation is for open surfaces; a closed one is measured.
  const Surface stated = surface(
      [](auto u, auto v) {
        const auto rho = 2 + cos(u);
        return point(rho * cos(v), rho * sin(v), sin(u));
      },
      {{0, kTau}, {0, kTau}}, {.orientation = 1});
  EXPECT_EQ(stated.topology().orientation(), -1);
}

TEST(Topology, ThinAndDistantSurfacesAreClosedToo) {
  EXPECT_TRUE(torus(1, 1e-4).closed());
  EXPECT_EQ(torus(1, 1e-4).topology().orientation(), 1);
  const auto needle = [](double thickness, double distance) {
    return surface(
        [=](auto u, auto v) {
          return point(distance + thickness * (cos(v) * cos(u)), sin(v), -thickness * (cos(v) * sin(u)));
        },
        {{0, kTau}, {-kPi / 2, kPi / 2}});
  };
  for (const double thickness : {1.0, 1e-3, 1e-5})
    for (const double distance : {0.0, 100.0}) {
      const Surface s = needle(thickness, thickness * distance);
      EXPECT_TRUE(s.closed()) << thickness << " thick at " << distance;
      EXPECT_EQ(s.topology().orientation(), 1);
    }
}

TEST(Topology, ASelfCancellingVolumeIsNotClosed) {
  // The ring of an upright figure eight: two tubes of equal radius and opposite sign. No side is outside.
  const Surface eight = surface(
      [](auto u, auto v) {
        const auto rho = 3 + sin(2 * u);
        return point(rho * cos(v), rho * sin(v), sin(u));
      },
      {{0, kTau}, {0, kTau}}, {.orientation = -1});
  EXPECT_TRUE(eight.topology().seamU() && eight.topology().seamV());
  EXPECT_FALSE(eight.closed());
  EXPECT_EQ(eight.topology().orientation(), -1);
}

TEST(Topology, HalfAndRotatedSurfaces) {
  const auto ball = [](auto u, auto v) { return point(cos(v) * cos(u), sin(v), -(cos(v) * sin(u))); };
  const Topology dome = surface(ball, {{0, kTau}, {0, kPi / 2}}).topology();
  EXPECT_EQ(kindOf(dome, Side::UMin), Edge::Seam);
  EXPECT_EQ(kindOf(dome, Side::VMin), Edge::Border);
  EXPECT_EQ(kindOf(dome, Side::VMax), Edge::Pole);
  EXPECT_FALSE(dome.closed);
  const Topology slice = surface(ball, {{0, kPi}, {-kPi / 2, kPi / 2}}).topology();
  EXPECT_EQ(kindOf(slice, Side::UMin), Edge::Border);
  EXPECT_EQ(kindOf(slice, Side::VMin), Edge::Pole);
  EXPECT_FALSE(slice.closed);
  // Around v instead of u.
  const Topology pipe =
      surface([](auto u, auto v) { return point(u, cos(v), sin(v)); }, {{0, 1}, {0, kTau}}).topology();
  EXPECT_EQ(kindOf(pipe, Side::UMin), Edge::Border);
  EXPECT_EQ(kindOf(pipe, Side::VMin), Edge::Seam);
  EXPECT_EQ(kindOf(pipe, Side::VMax), Edge::Seam);
}

TEST(Topology, ClosedWithAKinkIsASeamThatIsNotSmooth) {
  // The loop (u (1 - u), u (1 - u) (1 - 2u)) ends where it began, at an angle: two normals, so two vertices.
  const Topology t = surface(
                         [](auto u, auto v) {
                           const auto bulge = u * (1 - u);
                           return point(bulge, v, bulge * (1 - 2 * u));
                         },
                         {{0, 1}, {0, 1}})
                         .topology();
  EXPECT_EQ(kindOf(t, Side::UMin), Edge::Seam);
  EXPECT_EQ(kindOf(t, Side::UMax), Edge::Seam);
  ASSERT_EQ(t.joints.size(), 1u);
  EXPECT_FALSE(t.joints[0].smooth || t.joints[0].reversed || t.joints[0].flipped);
  EXPECT_FALSE(t.seamU());
}

/// The message of the Error(Scene) that making the surface throws.
template <class Make>
std::string refusal(const Make& make) {
  try {
    static_cast<void>(make());
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene) << error.what();
    EXPECT_FALSE(error.hint().empty()) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

bool mentions(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

TEST(Topology, RefusesWhatIsNoSurface) {
  const auto plane = [](auto u, auto v) { return point(u, v, 0); };
  for (const Interval& range :
       {Interval(1, 1), Interval(2, 1), Interval(0, kInfinity), Interval(kNotANumber, 1)}) {
    const std::string text = refusal([&] { return surface(plane, {range, {0, 1}}, {.name = "patch"}); });
    EXPECT_TRUE(mentions(text, "patch") && mentions(text, "domain")) << text;
    EXPECT_NE(refusal([&] { return surface(plane, {{0, 1}, range}); }), "");
  }
  const std::string constant =
      refusal([] { return surface([](auto, auto) { return point(1, 2, 3); }, {}, {.name = "dot"}); });
  EXPECT_TRUE(mentions(constant, "dot") && mentions(constant, "same point")) << constant;
  const std::string nothing = refusal([] {
    return surface([](auto u, auto v) { return point(log(u - 2), sqrt(v - 3), 1 / (u - u)); }, {},
                   {.name = "void"});
  });
  EXPECT_TRUE(mentions(nothing, "void") && mentions(nothing, "not a number")) << nothing;
}

TEST(Topology, RefusesWhatIsTooLarge) {
  for (const double size : {1e101, 1e200, 1e308}) {
    const std::string text = refusal([&] {
      return surface([=](auto u, auto v) { return point(size * u, size * v, 0); }, {}, {.name = "plain"});
    });
    EXPECT_TRUE(mentions(text, "plain") && mentions(text, "too large")) << text;
  }
  // What is far out in a few places only is a pole, not a size.
  EXPECT_NO_THROW(static_cast<void>(
      surface([](auto u, auto v) { return point(u, 1 / (1e-150 + u * u), v); }, {{-1, 1}, {0, 1}})));
}

TEST(Topology, NamedSurfacesRefuseImpossibleSizes) {
  for (const double size : {0.0, -1.0, kNotANumber, kInfinity}) {
    SCOPED_TRACE(size);
    EXPECT_TRUE(mentions(refusal([&] { return rectangle(size, 1); }), "rectangle"));
    EXPECT_TRUE(mentions(refusal([&] { return rectangle(1, size); }), "rectangle"));
    EXPECT_TRUE(mentions(refusal([&] { return disk(size); }), "disk"));
    EXPECT_TRUE(mentions(refusal([&] { return cylinder(size, 1); }), "cylinder"));
    EXPECT_TRUE(mentions(refusal([&] { return cylinder(1, size); }), "cylinder"));
    EXPECT_TRUE(mentions(refusal([&] { return cone(1, 0, size); }), "cone"));
    EXPECT_TRUE(mentions(refusal([&] { return sphere(size); }), "sphere"));
    EXPECT_TRUE(mentions(refusal([&] { return paraboloid(size, 1); }), "paraboloid"));
    EXPECT_TRUE(mentions(refusal([&] { return paraboloid(1, size); }), "paraboloid"));
    EXPECT_TRUE(mentions(refusal([&] { return torus(size, 0.5); }), "torus"));
    EXPECT_TRUE(mentions(refusal([&] { return torus(1, size); }), "torus"));
    EXPECT_TRUE(mentions(refusal([&] { return flag({.width = size}); }), "flag"));
    EXPECT_TRUE(mentions(refusal([&] { return flag({.height = size}); }), "flag"));
  }
  EXPECT_TRUE(mentions(refusal([] { return cone(0, 0, 1); }), "cone"));
  EXPECT_TRUE(mentions(refusal([] { return cone(-1, 1, 1); }), "cone"));
  EXPECT_TRUE(mentions(refusal([] { return cone(1, kNotANumber, 1); }), "cone"));
  EXPECT_TRUE(mentions(refusal([] { return torus(1, 1); }), "torus"));
  EXPECT_TRUE(mentions(refusal([] { return flag({.depth = kNotANumber}); }), "flag"));
  EXPECT_TRUE(mentions(refusal([] { return flag({.waves = kInfinity}); }), "flag"));
}

}  // namespace
}  // namespace luxo
