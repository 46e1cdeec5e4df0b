// SPDX-License-Identifier: Apache-2.0
#include "luxo_grandpa/lamp.h"

#include <cmath>

#include "surface/library.h"

namespace luxo {
namespace {

// Metres, y up. Every part stands on the one before it.
constexpr double kBaseRadius = 2, kBaseHeight = 0.4;
constexpr double kJointRadius = 0.35;
constexpr double kRodRadius = 0.15, kRodLength = 4;
constexpr double kShadeOffset = 0.3, kShadeFocus = 0.2, kShadeHeight = 1.8;  // opens 36.87 degrees: cos = 0.8

Vec3 up(double metres) { return {0, metres, 0}; }

// What reflects light evenly reflects it from everywhere: ambient = pi * diffuse.
MaterialId addMaterial(Scene& scene, const char* name, const Vec3& diffuse, double specular, double shininess,
                       TwoSided twoSided = TwoSided::Auto) {
  return scene.add(Material{.name = name,
                            .diffuse = diffuse,
                            .ambient = kPi * diffuse,
                            .specular = Vec3(specular),
                            .shininess = shininess,
                            .twoSided = twoSided});
}

// Circles the lamp once in 8 pi seconds, after which the joints are back where they were, too.
Vec3 orbitingEye(double t) { return {18 * std::sin(t / 4), 9, 18 * std::cos(t / 4)}; }

}  // namespace

Scene luxoGrandpa() {
  Scene scene;
  scene.set(RenderSettings{.time = 21, .background = {0.02, 0.025, 0.03}, .ambient = Vec3(0.05)});

  // Of the enamelled parts only the shade ever shows its inside.
  const Vec3 red(0.35, 0.06, 0.05);
  const MaterialId enamel = addMaterial(scene, "lamp", red, 0.8, 60, TwoSided::No);
  const MaterialId enamelBothSides = addMaterial(scene, "shade", red, 0.8, 60);
  const MaterialId brass = addMaterial(scene, "joints", {0.5, 0.42, 0.12}, 1.5, 80);
  const MaterialId wood = addMaterial(scene, "floor", {0.32, 0.28, 0.24}, 0.15, 40);

  scene.add(Node{.name = "floor", .surface = rectangle(60, 60), .material = wood});

  const NodeId base =
      scene.add(Node{.name = "base", .surface = cylinder(kBaseRadius, kBaseHeight), .material = enamel});
  scene.add(Node{.name = "base top",
                 .parent = base,
                 .translation = up(kBaseHeight),
                 .surface = disk(kBaseRadius),
                 .material = enamel});

  // A joint turns everything above it; a rod stands in it and carries the next one.
  const Surface ball = sphere(kJointRadius), rod = cylinder(kRodRadius, kRodLength);
  const auto addJoint = [&](const char* name, NodeId below, double height, const Vec3& axis, double rate) {
    return scene.add(Node{.name = name,
                          .parent = below,
                          .translation = up(height),
                          .rotation = spin(axis, rate),
                          .surface = ball,
                          .material = brass});
  };
  const auto addRod = [&](const char* name, NodeId joint) {
    scene.add(Node{.name = name, .parent = joint, .surface = rod, .material = enamel});
  };
  const NodeId joint1 = addJoint("joint 1", base, kBaseHeight, {1, 5, 1}, 0.5);
  addRod("rod 1", joint1);
  const NodeId joint2 = addJoint("joint 2", joint1, kRodLength, {2, 6, -1}, 0.75);
  addRod("rod 2", joint2);
  const NodeId joint3 = addJoint("joint 3", joint2, kRodLength, {2, 1, 2}, 1.0);

  const NodeId shade = scene.add(Node{.name = "shade",
                                      .parent = joint3,
                                      .translation = up(kShadeOffset),
                                      .surface = paraboloid(kShadeFocus, kShadeHeight),
                                      .material = enamelBothSides});
  Light bulb;
  bulb.color = Vec3(1, 0.9, 0.7);
  bulb.intensity = 110.0;
  bulb.attenuation = Light::Attenuation::InverseSquare;
  Light roomLight = bulb;
  roomLight.color = Vec3(1);
  roomLight.intensity = 70.0;
  bulb.shadow = Light::Shadow::Exact;
  bulb.casters = {shade};
  scene.add(Node{.name = "bulb", .parent = shade, .translation = up(kShadeFocus), .light = bulb});
  scene.add(Node{.name = "room light", .translation = Vec3(8, 14, 6), .light = roomLight});

  scene.add(Camera{.name = "orbit", .eye = orbitingEye, .lookAt = up(5), .fovY = radians(50)});
  return scene;
}

}  // namespace luxo
