// SPDX-License-Identifier: Apache-2.0
// Where a hull's triangles are seen flat no ray grazes the surface near them.
#include "draw/hull_view.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/view.h"
#include "surface/catalogue.h"
#include "tessellate/hull.h"

namespace luxo {
namespace {

Hull hullOf(const Surface& surface) {
  const double size = glm::length(surface.framing({}).extent());
  return makeHull(surface, {}, CurvatureMap(surface, {}), {.tolerance = 2e-3 * size});
}

class HullViewOf : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Surfaces, HullViewOf,
                         testing::Values("torus", "sphere", "cylinder", "klein_figure8", "teapot", "flag"),
                         [](const auto& name) { return std::string(name.param); });

TEST_P(HullViewOf, RaysThroughFlatTrianglesMeetTheSideSearchedFor) {
  const Surface surface = makeSurface(GetParam());
  const Hull hull = hullOf(surface);
  ASSERT_EQ(hull.cones.size(), hull.triangleCount());
  const Box box = surface.framing({});
  const Vec3 eye =
      0.5 * (box.min + box.max) + 1.3 * glm::length(box.extent()) * glm::normalize(Vec3(0.4, 0.5, 0.8));
  const View view = viewAt({.eye = eye, .lookAt = 0.5 * (box.min + box.max)}, {}, {640, 480});
  const HullView seen(view, Transform{}, true), inside(view, Transform{}, false);
  std::size_t flatTriangles = 0;
  for (const Hull::Part& part : hull.parts)
    for (const double side : {1.0, -1.0}) {
      const std::uint32_t first = side > 0 ? part.firstIndex : part.wallIndex();
      std::vector<std::uint32_t> flat;
      for (std::uint32_t i = first; i < first + part.frontCount; i += 3) {
        EXPECT_EQ(inside.seen(hull, i, side), Seen::Steep);
        if (seen.seen(hull, i, side) == Seen::Flat)
          flat.insert(flat.end(), hull.indices.begin() + i, hull.indices.begin() + i + 3);
      }
      flatTriangles += flat.size() / 3;
      // Halfway from the corners to the middle, where the normal is the formula's own.
      for (std::size_t i = 0; i < flat.size(); i += 3) {
        const std::uint32_t patch = hull.patches[flat[i]];
        const Vec2 middle =
            (hull.parameters[flat[i]] + hull.parameters[flat[i + 1]] + hull.parameters[flat[i + 2]]) / 3.0;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec2 at = 0.5 * (middle + hull.parameters[flat[i + k]]);
          const Vec3 point = surface.position(patch, at.x, at.y);
          EXPECT_GT(side * glm::dot(surface.normal(patch, at.x, at.y), eye - point), 0);
        }
      }
    }
  EXPECT_GT(flatTriangles, 0U);
}

}  // namespace
}  // namespace luxo
