// SPDX-License-Identifier: Apache-2.0
// The ground truth itself under attack: rays through random hard scenes, each held against what interval
// arithmetic alone proves.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>

#include "random/hard_scene.h"
#include "reference/caster.h"
#include "support/brute_force.h"

namespace luxo::test {
namespace {

constexpr int kScenes = 200, kRays = 40;
constexpr std::uint64_t kSeed = 17;

/// Two ways to the same distance differ by less: rays that graze reach it ill-conditioned.
constexpr double kSameDistance = 1e-7;

/// The reference, with few cells where it needs any, which it builds fast: what it proves must hold for any
/// number of them.
class FewCells {
 public:
  explicit FewCells(const SnapshotNode& node) : worldFromObject_(node.worldFromObject) {
    if (reference::ClosedForm::of(node.surface, 0, node.parameters))
      shape_.emplace(std::make_shared<const reference::Shape>(node.surface, node.parameters),
                     node.worldFromObject);
    else
      tree_.emplace(node.surface, node.parameters, 512);
  }

  [[nodiscard]] reference::Roots nearestRoot(const reference::Ray& ray,
                                             const reference::RootQuery& query) const {
    return shape_ ? shape_->nearestRoot(ray, query)
                  : reference::nearestRoot(*tree_, {ray, worldFromObject_}, query);
  }

 private:
  Transform worldFromObject_;
  std::optional<reference::CellTree> tree_;
  std::optional<reference::PlacedShape> shape_;
};

TEST(ReferenceBruteForce, NothingCertifiedIsDisproved) {
  int rays = 0, certified = 0, hits = 0, confirmedHits = 0, confirmedMisses = 0;
  for (std::uint64_t index = 0; index < kScenes; ++index) {
    const random::HardScene hard = random::hardScene(kSeed, index, {.samples = 1});
    SCOPED_TRACE(testing::Message() << hard.kind << " " << hard.camera << ", index " << index);
    const Scene scene = random::sceneOf(hard.json);
    const Snapshot snapshot = takeSnapshot(scene, 0, scene.settings().size);
    const SnapshotNode& node = snapshot.nodes.front();
    const FewCells truth(node);
    const View& view = snapshot.view;
    random::Numbers numbers(kSeed, ~index);
    for (int k = 0; k < kRays; ++k) {
      const double x = numbers.between(-1, 1) * view.halfExtent.x,
                   y = numbers.between(-1, 1) * view.halfExtent.y;
      const Vec3 across = x * view.right() + y * view.up();
      const reference::Ray ray = view.perspective() ? reference::Ray{view.eye, unit(view.forward() + across)}
                                                    : reference::Ray{view.eye + across, view.forward()};
      const double perDepth = 1 / glm::dot(ray.direction, view.forward());
      const double nearest = view.near * perDepth, farthest = view.far * perDepth;
      const reference::Roots roots =
          truth.nearestRoot(ray, {nearest, farthest, reference::Facing::Both, false});
      ++rays;
      if (!roots.certified) continue;
      ++certified;
      const BruteForce proven = bruteForce(node.surface, node.parameters, node.worldFromObject, ray.origin,
                                           ray.direction, nearest, farthest);
      if (!roots.nearest) {
        EXPECT_FALSE(proven.metBefore)
            << "a miss, but a point is met before " << *proven.metBefore << ", ray " << k;
        confirmedMisses += std::isinf(proven.clearUntil) ? 1 : 0;
        continue;
      }
      ++hits;
      const double t = roots.nearest->t, slack = kSameDistance * t;
      EXPECT_LE(proven.clearUntil, t + slack) << "a hit where nothing is, ray " << k;
      if (proven.metBefore) {
        EXPECT_GE(*proven.metBefore, t - slack) << "a nearer point, ray " << k;
        // Between what is clear and what is met lies the point: to a twentieth of the way.
        confirmedHits += proven.clearUntil > t * 0.95 && *proven.metBefore < t * 1.05 ? 1 : 0;
      }
    }
  }
  // Or nothing was attacked.
  EXPECT_GT(certified, rays * 0.98);
  EXPECT_GT(hits, rays / 4);
  EXPECT_GT(confirmedHits, hits * 0.65);
  EXPECT_GT(confirmedMisses, (certified - hits) * 0.85);
  RecordProperty("rays", rays);
  RecordProperty("hits", hits);
  RecordProperty("confirmedHits", confirmedHits);
  RecordProperty("confirmedMisses", confirmedMisses);
}

}  // namespace
}  // namespace luxo::test
