// SPDX-License-Identifier: Apache-2.0
#include "scenes/primitives.h"

#include "surface/library.h"

namespace luxo {

Scene primitives() {
  Scene scene;
  scene.set(RenderSettings{.background = {0.02, 0.025, 0.03}, .ambient = Vec3(0.12)});

  const MaterialId floor =
      scene.add(Material{.name = "floor", .diffuse = {0.32, 0.30, 0.28}, .specular = Vec3(0.1)});
  const auto enamel = [&](const Vec3& color) {
    return scene.add(Material{.name = "enamel", .diffuse = color, .specular = Vec3(0.6), .shininess = 80});
  };
  const MaterialId red = enamel({0.55, 0.08, 0.07}), gold = enamel({0.60, 0.42, 0.10});
  const MaterialId green = enamel({0.10, 0.42, 0.16}), blue = enamel({0.09, 0.22, 0.55});

  scene.add(Node{.name = "floor", .surface = rectangle(60, 60), .material = floor});
  const auto place = [&](const char* name, double x, double y, double z, Surface surface, MaterialId material,
                         const Rotation& rotation = {}) {
    scene.add(Node{.name = name,
                   .translation = Vec3(x, y, z),
                   .rotation = rotation,
                   .surface = std::move(surface),
                   .material = material});
  };
  const Rotation towardViewer{{1, 0, 0}, radians(75)};
  place("rectangle", -4.5, 1, -2, rectangle(2, 1.6), red, towardViewer);
  place("disk", -1.5, 1, -2, disk(1), gold, towardViewer);
  place("cylinder", 1.5, 0, -2, cylinder(0.8, 2), green);
  place("cone", 4.5, 0, -2, cone(1, 0, 2.2), blue);
  place("sphere", -4.2, 1, 1.5, sphere(1), blue);
  place("paraboloid", -1.6, 0.1, 1.5, paraboloid(0.2, 1.2), green, {{1, 0, 0}, radians(25)});
  place("torus", 1.4, 1.05, 1.5, torus(0.7, 0.3), gold, towardViewer);
  place(
      "flag", 3.4, 0.4, 1.5,
      flag(
          {.width = 2.2, .height = 1.5, .depth = 0.15, .waves = 7, .phase = [](double t) { return -3 * t; }}),
      red);

  scene.add(Node{.name = "key light",
                 .translation = Vec3(-7, 10, 5),
                 .light = Light{.color = Vec3(1, 0.96, 0.9),
                                .intensity = 110,
                                .attenuation = Light::Attenuation::InverseSquare,
                                .shadow = Light::Shadow::Exact}});
  scene.add(
      Node{.name = "fill light",
           .rotation = Rotation{{1, 0.7, 0}, radians(-50)},
           .light = Light{.type = Light::Type::Directional, .color = Vec3(0.8, 0.9, 1), .intensity = 0.3}});
  scene.add(Camera{.eye = Vec3(0, 4.8, 10.4), .lookAt = Vec3(0, 0.7, -0.3), .fovY = radians(38)});
  return scene;
}

}  // namespace luxo
