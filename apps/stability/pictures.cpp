// SPDX-License-Identifier: Apache-2.0
#include "stability/pictures.h"

#include <algorithm>

namespace luxo {

PixelRay rayThrough(const View& view, const Vec2& pixel) {
  const Vec2 fromCenter = (pixel - Vec2(view.size.width, view.size.height) / 2.0) / view.pixelsPerUnit;
  const Vec3 sideways = fromCenter.x * view.right() - fromCenter.y * view.up();
  return view.perspective() ? PixelRay{view.eye, view.forward() + sideways}
                            : PixelRay{view.eye + sideways, view.forward()};
}

Vec2 pixelOf(const View& view, const Vec3& pointWorld) {
  return pixelFromEye(view, eyeFromWorldPoint(view, pointWorld));
}

double nanCount(const Image& image) {
  return static_cast<double>(std::ranges::count_if(image.samples(), [](float x) { return std::isnan(x); }));
}

double emptyCount(const Image& id) { return static_cast<double>(std::ranges::count(id.samples(), 0.0f)); }

double degreesBetween(const Vec3& a, const Vec3& b) {
  if (a == Vec3(0) || b == Vec3(0)) return 180;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * (180 / kPi);
}

Material glowing(const Vec3& color) { return {.diffuse = Vec3(0), .ambient = color, .specular = Vec3(0)}; }

RenderSettings plainSettings() { return {.background = Vec3(0), .ambient = Vec3(1)}; }

Scene sceneOf(const Surface& surface) {
  Scene scene;
  scene.set(plainSettings());
  scene.add(Node{.surface = surface, .material = scene.add(glowing(Vec3(1)))});
  return scene;
}

double positionErrorPx(const Snapshot& snapshot, const Image& id, const Image& uv) {
  const SnapshotNode& node = snapshot.nodes.front();
  double worst = 0;
  for (int y = 0; y < id.height(); ++y)
    for (int x = 0; x < id.width(); ++x) {
      if (id.pixel(x, y)[0] == 0) continue;
      const auto at = uv.pixel(x, y);
      const Vec3 point =
          transformPoint(node.worldFromObject, node.surface.position(at[0], at[1], node.parameters));
      const double error = glm::length(pixelOf(snapshot.view, point) - centerOf(x, y));
      // Written so that NaN counts.
      if (!(error <= worst)) worst = error;
    }
  return worst;
}

}  // namespace luxo
