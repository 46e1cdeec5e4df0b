// SPDX-License-Identifier: Apache-2.0
// The first image of README.md, compiled and run as a test.
#include "luxo.h"

int main() {
  using namespace luxo;
  Scene scene;
  scene.set(RenderSettings{.size = {640, 480}});
  const Surface shell = surface(
      [](auto u, auto v) {
        const auto tube = 0.35 + 0.1 * cos(5 * u);
        return point((1 + tube * cos(v)) * cos(u), tube * sin(v), -((1 + tube * cos(v)) * sin(u)));
      },
      {{0, kTau}, {0, kTau}});
  scene.add(Node{.surface = shell, .material = scene.add(Material{.diffuse = {0.6, 0.3, 0.1}})});
  scene.add(Node{.translation = Vec3(2, 4, 3), .light = Light{.intensity = 0.9}});

  Renderer renderer;
  renderer.render(scene).image.save("first.png");
}
