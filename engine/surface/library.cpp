// SPDX-License-Identifier: Apache-2.0
#include "surface/library.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>

#include "base/error.h"

namespace luxo {
namespace {

constexpr Domain kUnitSquare{};

struct Length {
  const char* name;
  double value;
};

void requirePositive(const char* surface, std::initializer_list<Length> lengths) {
  for (const auto& [name, value] : lengths)
    if (!(value > 0 && std::isfinite(value)))
      throw Error(ErrorKind::Scene, fmt::format("{}: {} is {}", surface, name, value),
                  fmt::format("give {} a positive, finite length in metres", name));
}

}  // namespace

Surface rectangle(double sizeX, double sizeZ) {
  requirePositive("rectangle", {{"size x", sizeX}, {"size z", sizeZ}});
  return surface([=](auto u, auto v) { return point(sizeX * (u - 0.5), 0, -(sizeZ * (v - 0.5))); },
                 kUnitSquare, {.name = "rectangle", .flatNormal = Vec3(0, 1, 0)});
}

Surface disk(double radius) {
  requirePositive("disk", {{"radius", radius}});
  return revolve(
      [=](auto v) {
        return ProfilePoint{radius * v, 0};
      },
      {.name = "disk", .orientation = -1, .flatNormal = Vec3(0, 1, 0)});
}

Surface cylinder(double radius, double height) {
  requirePositive("cylinder", {{"radius", radius}, {"height", height}});
  return revolve([=](auto v) { return ProfilePoint{radius, height * v}; }, {.name = "cylinder"});
}

Surface cone(double radius, double topRadius, double height) {
  requirePositive("cone", {{"the larger radius", std::max(radius, topRadius)}, {"height", height}});
  if (!(radius >= 0 && topRadius >= 0 && std::isfinite(radius + topRadius)))
    throw Error(ErrorKind::Scene, fmt::format("cone: its radii are {} and {}", radius, topRadius),
                "give radii that are finite and not negative");
  return revolve(
      [=](auto v) {
        return ProfilePoint{radius * (1 - v) + topRadius * v, height * v};
      },
      {.name = "cone"});
}

Surface sphere(double radius) {
  requirePositive("sphere", {{"radius", radius}});
  return revolve(
      [=](auto v) {
        const auto latitude = kPi * (v - 0.5);
        return ProfilePoint{radius * cos(latitude), radius * sin(latitude)};
      },
      {.name = "sphere"});
}

Surface paraboloid(double focalLength, double height) {
  requirePositive("paraboloid", {{"focal length", focalLength}, {"height", height}});
  const double rim = 2 * std::sqrt(focalLength * height);
  return revolve(
      [=](auto v) {
        return ProfilePoint{rim * v, height * (v * v)};
      },
      {.name = "paraboloid", .paraboloid = Paraboloid{focalLength, height}});
}

Surface torus(double major, double minor) {
  requirePositive("torus", {{"major", major}, {"minor", minor}});
  if (!(major > minor))
    throw Error(ErrorKind::Scene,
                fmt::format("torus: major radius {} is not larger than minor radius {}", major, minor),
                "a ring torus needs major > minor");
  return revolve(
      [=](auto v) {
        return ProfilePoint{major + minor * cos(kTau * v), minor * sin(kTau * v)};
      },
      {.name = "torus"});
}

Surface flag(const FlagDesc& desc) {
  requirePositive("flag", {{"width", desc.width}, {"height", desc.height}});
  return surface(
      [=](auto u, auto v, auto phase) {
        return point(desc.width * u, desc.height * v, desc.depth * sin(desc.waves * u + phase));
      },
      kUnitSquare, {.name = "flag"}, desc.phase);
}

}  // namespace luxo
