// SPDX-License-Identifier: Apache-2.0
// What the tests of scene and cull share: expected errors, and reproducible random places.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/snapshot.h"
#include "surface/library.h"

namespace luxo::test {

/// Expects an Error(Scene) whose message holds every one of the texts.
template <class Action>
void expectSceneError(Action action, const std::vector<std::string>& texts) {
  try {
    action();
    ADD_FAILURE() << "nothing was thrown; expected an error about " << texts.front();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    for (const std::string& text : texts)
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos)
          << error.what() << "\nlacks: " << text;
  }
}

inline void expectNear(const Vec3& actual, const Vec3& expected, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

/// A fixed sequence of numbers, the same on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * (engine_() * 0x1p-64); }
  std::uint64_t bits() { return engine_(); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  Vec3 inCube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = inCube(1);
      const double squared = glm::dot(v, v);
      if (squared > 1e-4 && squared <= 1) return v / std::sqrt(squared);
    }
  }
  Rotation rotation() { return {direction(), uniform(-kPi, kPi)}; }
  /// Uneven, from a twentieth to thrice, mirrored in any of the axes.
  Vec3 scale() {
    const auto one = [&] { return (below(2) ? 1 : -1) * std::exp(uniform(std::log(0.05), std::log(3.0))); };
    return {one(), one(), one()};
  }
  Surface surface() {
    switch (below(7)) {
      case 0:
        return sphere(1);
      case 1:
        return cylinder(0.3, 3);
      case 2:
        return torus(1, 0.3);
      case 3:
        return rectangle(4, 2);
      case 4:
        return disk(1.5);
      case 5:
        return cone(1, 0.2, 2);
      default:
        return paraboloid(0.2, 1.8);
    }
  }

 private:
  std::mt19937_64 engine_;
};

/// Points of the surface in object space, borders included: (n + 1)^2 of them, u fastest.
inline std::vector<Vec3> sample(const Surface& surface, int n) {
  const Domain& domain = surface.domain();
  std::vector<double> u, v;
  for (int i = 0; i <= n; ++i) {
    u.push_back(domain.u.lo + domain.u.width() * i / n);
    v.push_back(domain.v.lo + domain.v.width() * i / n);
  }
  return surface.evaluateGrid(u, v, {}).position;
}

inline Snapshot snap(const Scene& scene, double time = 0) { return takeSnapshot(scene, time, {100, 100}); }

inline const SnapshotNode& nodeNamed(const Scene& scene, const Snapshot& snapshot, const char* name) {
  for (const SnapshotNode& node : snapshot.nodes)
    if (scene[node.id].name == name) return node;
  throw std::runtime_error(std::string("no visible node with a surface is called ") + name);
}

}  // namespace luxo::test
