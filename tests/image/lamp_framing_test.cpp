// SPDX-License-Identifier: Apache-2.0
// The lamp never leaves the picture: its geometry projected at 1,000 moments of its period, without drawing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "luxo_grandpa/lamp.h"
#include "scene/snapshot.h"
#include "surface/surface.h"

namespace luxo::test {
namespace {

TEST(LampFraming, InsideThePictureOverItsWholePeriod) {
  constexpr PixelSize kSize{1280, 720};
  constexpr int kMoments = 1000, kCuts = 48;
  std::vector<double> cuts(kCuts + 1);
  for (int i = 0; i <= kCuts; ++i) cuts[i] = static_cast<double>(i) / kCuts;
  // Between samples a curve of radius r bulges by r pi^2 / (2 48^2) = 0.2 % of r <= 2 m: 5 mm, at 8 m and
  // more from the eye.
  constexpr double kBulge = 0.005 / 8;

  const double tangent = std::tan(radians(50) / 2), aspect = 16.0 / 9;
  const Scene lamp = luxoGrandpa();
  std::vector<std::vector<Vec3>> points;  // of each node, in object space
  double widest = 0, tallest = 0, closest = 1e9;
  for (int moment = 0; moment < kMoments; ++moment) {
    const double t = 8 * kPi * moment / kMoments;
    const Snapshot snapshot = takeSnapshot(lamp, t, kSize);
    if (points.empty())
      for (const SnapshotNode& node : snapshot.nodes)
        points.push_back(node.surface.evaluateGrid(cuts, cuts, node.parameters).position);
    ASSERT_EQ(points.size(), snapshot.nodes.size());

    const Vec3 eye(18 * std::sin(t / 4), 9, 18 * std::cos(t / 4));
    const Vec3 forward = glm::normalize(Vec3(0, 5, 0) - eye);
    const Vec3 right = glm::normalize(glm::cross(forward, Vec3(0, 1, 0))), up = glm::cross(right, forward);
    int bodies = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (snapshot.nodes[i].surface.name() == "rectangle") continue;  // the floor is meant to go on
      ++bodies;
      for (const Vec3& p : points[i]) {
        const Vec3 q = transformPoint(snapshot.nodes[i].worldFromObject, p) - eye;
        const double depth = glm::dot(q, forward);
        closest = std::min(closest, depth);
        widest = std::max(widest, std::abs(glm::dot(q, right)) / (depth * tangent * aspect));
        tallest = std::max(tallest, std::abs(glm::dot(q, up)) / (depth * tangent));
      }
    }
    ASSERT_EQ(bodies, 8) << "base and its top, three joints, two rods, the shade";
  }
  EXPECT_GT(closest, 8);
  EXPECT_LE(widest + kBulge / (tangent * aspect), 1);
  EXPECT_LE(tallest + kBulge / tangent, 1);
  EXPECT_GT(tallest, 0.5);  // and it is not lost in the distance
}

}  // namespace
}  // namespace luxo::test
