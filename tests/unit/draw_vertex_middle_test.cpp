// SPDX-License-Identifier: Apache-2.0
// What floats round away of the vertices of triangles: by the arithmetic of lib/scene.glsl, against double.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cull/cull.h"
#include "cull/raster_slack.h"
#include "draw/instance_data.h"
#include "scene_test_support.h"
#include "support/meshes.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

Vec3f relativeInFloat(const shared::InstanceData& instance, const Vec3f& vertex) {
  const Vec4f* columns = instance.relativeFromObject;
  const Vec3f d = vertex - Vec3f(columns[0].w, columns[1].w, columns[2].w);
  return d.x * Vec3f(columns[0]) + d.y * Vec3f(columns[1]) + d.z * Vec3f(columns[2]) + instance.translation;
}

struct VertexErrors {
  double perDistance = 0;  ///< of the vertex from the eye
  double perSlack = 0;     ///< of vertexSlack()
};

VertexErrors largestErrors(const Scene& scene, const Camera& camera) {
  const Snapshot snapshot = takeSnapshot(scene, 0, {640, 480}, camera);
  const SnapshotNode& node = snapshot.nodes[0];
  const TriangleMesh& mesh = node.surface.triangles()->mesh;
  const VisibleNode visible{.node = 0};
  const Vec3 origin = shadingOrigin(snapshot);
  const shared::InstanceData instance = instanceData(snapshot, node, visible, origin, mesh.origin(), false);
  VertexErrors errors;
  for (std::uint32_t i = 0; i < mesh.positions().size(); ++i) {
    const Vec3 world = transformPoint(node.worldFromObject, mesh.point(i));
    const double error = glm::distance(Vec3(relativeInFloat(instance, mesh.positions()[i])), world - origin);
    errors.perDistance = std::max(errors.perDistance, error / glm::distance(world, snapshot.view.eye));
    errors.perSlack = std::max(errors.perSlack, error / vertexSlack(snapshot.view, node));
  }
  return errors;
}

// Six roundings, half a unit each; of what a node scales more along one axis that is as much more of the
// others.
TEST(VertexMiddle, FloatsLeaveOfAVertexAsMuchAsItIsFarAway) {
  test::Random random(2);
  for (int i = 0; i < 200; ++i) {
    Scene scene;
    scene.add(Node{.translation = random.inCube(100),
                   .rotation = random.rotation(),
                   .scale = Vec3(random.uniform(0.7, 1.4), random.below(2) ? 1 : -1, 1),
                   .surface = test::icosphere(3)});
    const Vec3 place = transformPoint(takeSnapshot(scene, 0, {64, 48}, Camera{}).nodes[0].worldFromObject,
                                      1.001 * random.direction());
    EXPECT_LT(largestErrors(scene, {.eye = place, .lookAt = place + random.direction()}).perDistance,
              8 * 0x1p-24);
  }
}

// Parents that scale unevenly shear what is turned in them.
TEST(VertexMiddle, OfShearedNodesTooVerticesAreWithinTheirSlack) {
  test::Random random(3);
  for (int i = 0; i < 400; ++i) {
    Scene scene;
    const NodeId parent = scene.add(
        Node{.rotation = random.rotation(), .scale = Vec3(1, std::pow(10, random.uniform(-8, 2)), 1)});
    scene.add(Node{.parent = parent,
                   .translation = random.inCube(1),
                   .rotation = random.rotation(),
                   .surface = test::icosphere(2)});
    const Vec3 eye = random.uniform(0.5, 20) * random.direction();
    EXPECT_LT(largestErrors(scene, {.eye = eye, .lookAt = Vec3(0)}).perSlack, 1) << i;
  }
}

}  // namespace
}  // namespace luxo
