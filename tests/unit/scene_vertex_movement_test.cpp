// SPDX-License-Identifier: Apache-2.0
// The mesh that moved vertices make, whoever moves them; and which programs may.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "scene/snapshot.h"
#include "scene/vertex_movement.h"
#include "support/meshes.h"
#include "surface/surface_triangles.h"

namespace luxo::test {
namespace {

using testing::HasSubstr;

MaterialShaderPtr vertexProgram(const std::string& text) {
  MaterialShader shader{{{"a.frag", "void main() { gl_FragColor = vec4(1.0); }"}, {"a.vert", text}}};
  shader.vertex = 1;
  return std::make_shared<const MaterialShader>(std::move(shader));
}
Material moving() { return {.shader = vertexProgram("void main() { gl_Position = somewhere(); }")}; }

/// Moves by a function instead of a program.
class ByFunction : public VertexMovement {
 public:
  using Function = std::function<Vec4f(const Vec3f& place, const Vec3f& normal)>;
  explicit ByFunction(Function function) : function_(std::move(function)) {}
  int runs = 0;

 private:
  std::vector<Vec4f> run(const VerticesAtRest& vertices, const Material&) override {
    ++runs;
    std::vector<Vec4f> moved;
    for (std::size_t i = 0; i < vertices.positions.size(); ++i)
      moved.push_back(function_(vertices.positions[i], vertices.normals[i]));
    return moved;
  }

  Function function_;
};

const TriangleMesh& meshOf(const Surface& surface) { return surface.triangles()->mesh; }

TEST(VertexMovement, TellsProgramsThatMayMove) {
  for (const char* text : {"void main() { gl_Position = ftransform(); }",
                           "void main() { gl_Position=gl_ModelViewProjectionMatrix*gl_Vertex; }",
                           "/* gl_Position = x; */ void main() { if (a) gl_Position = ftransform (); }"})
    EXPECT_FALSE(vertexProgram(text)->movesVertices()) << text;
  for (const char* text :
       {"void main() { gl_Position = 2.0 * ftransform(); }",
        "void main() { gl_Position = ftransform() + a; }",
        "void main() { gl_Position = ftransform(); gl_Position.x += 1.0; }",
        "#define P gl_Position\nvoid main() { P = vec4(1.0); gl_Position = ftransform(); }",
        "void main() { move(gl_Position); }", "void main() { gl_Position = gl_Vertex; }"})
    EXPECT_TRUE(vertexProgram(text)->movesVertices()) << text;
  EXPECT_FALSE(MaterialShader({{{"a.frag", "gl_Position"}}}).movesVertices());
}

TEST(VertexMovement, LeavesTrianglesAndTellsWhereTheyWere) {
  const TriangleMesh rest = icosphere(1);
  ByFunction movement([](const Vec3f& p, const Vec3f&) { return Vec4f(2.0F * p + Vec3f(1, 0, 0), 2); });
  const Surface moved = movement.moved(rest, moving());
  const TriangleMesh& mesh = meshOf(moved);
  EXPECT_EQ(mesh.triangleCount(), rest.triangleCount());
  ASSERT_EQ(mesh.rest().size(), rest.positions().size());
  EXPECT_TRUE(moved.closed());
  for (std::uint32_t i = 0; i < mesh.positions().size(); ++i) {
    EXPECT_LT(glm::length(mesh.point(i) - Vec3(mesh.rest()[i]) - Vec3(0.5, 0, 0)), 1e-7);
    EXPECT_LT(glm::length(mesh.normals()[i] - mesh.restNormals()[i]), 1e-6F);
  }
  EXPECT_LT(glm::length(moved.bounds({}).center() - Vec3(0.5, 0, 0)), 1e-6);
}

// A turn by 30 degrees about y; a squeeze, whose normals are those of its triangles.
TEST(VertexMovement, NormalsTurnWithTheTriangles) {
  const float c = std::cos(0.5F), s = std::sin(0.5F);
  const auto turn = [&](const Vec3f& v) { return Vec3f(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
  ByFunction turning([&](const Vec3f& p, const Vec3f&) { return Vec4f(turn(p), 1); });
  for (const TriangleMesh& rest : {cubeMesh(), icosphere(2), quadMesh()}) {
    const Surface surface = turning.moved(rest, moving());
    const TriangleMesh& mesh = meshOf(surface);
    for (std::uint32_t i = 0; i < mesh.positions().size(); ++i)
      EXPECT_LT(glm::length(mesh.normals()[i] - turn(mesh.restNormals()[i])), 2e-6F) << rest.name();
  }
  // Given normals that are not those of the triangles keep what they differ by.
  MeshArrays arrays{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .indices = {0, 1, 2}};
  arrays.normals.assign(3, Vec3f(0.6F, 0, 0.8F));
  const Surface leaning = turning.moved(triangleMesh(std::move(arrays)), moving());
  for (const Vec3f& normal : meshOf(leaning).normals())
    EXPECT_LT(glm::length(normal - turn(Vec3f(0.6F, 0, 0.8F))), 2e-6F);
  ByFunction squeezing([](const Vec3f& p, const Vec3f&) { return Vec4f(p.x, p.y + p.x, p.z, 1); });
  const Surface sheared = squeezing.moved(cubeMesh(), moving());
  for (std::uint32_t i = 0; i < sheared.triangles()->count; ++i) {
    const auto [a, b, d] = sheared.triangles()->points(i);
    const Vec3 normal = unit(glm::cross(b - a, d - a));
    for (const std::uint32_t corner : sheared.triangles()->corners(i))
      EXPECT_LT(glm::length(Vec3(meshOf(sheared).normals()[corner]) - normal), 1e-6);
  }
}

TEST(VertexMovement, WhatIsTurnedInsideOutKeepsItsOutside) {
  ByFunction mirroring([](const Vec3f& p, const Vec3f&) { return Vec4f(-p.x, p.y, p.z, 1); });
  const Surface mirrored = mirroring.moved(icosphere(1), moving());
  for (std::uint32_t i = 0; i < mirrored.triangles()->count; ++i) {
    const auto [a, b, c] = mirrored.triangles()->points(i);
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a), 0);
  }
}

// What falls into one place was at two; a part of a mesh is moved by itself; vertices that stay are where they
// were, however far from the origin.
TEST(VertexMovement, KeepsWhatIsApartAtRest) {
  ByFunction folding([](const Vec3f& p, const Vec3f&) { return Vec4f(std::abs(p.x), p.y, p.z, 1); });
  const TriangleMesh strip =
      triangleMesh({.positions = {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}},
                    .indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4},
                    .materials = {0, 0, 1, 1}},
                   "strip");
  EXPECT_EQ(meshOf(folding.moved(strip, moving())).rest().size(), 6U);
  const Surface part(strip, strip.groups()[1]);
  EXPECT_EQ(meshOf(folding.moved(part, moving())).triangleCount(), 2U);
  const Vec3 far(1e7 + 0.1, 0, 0);
  ByFunction lifting([](const Vec3f& p, const Vec3f& n) {
    return n.z > 0.5F && p.y > 0.5F ? Vec4f(p + Vec3f(0, 0, 1), 1) : Vec4f(p, 1);
  });
  const TriangleMesh distant =
      triangleMesh({.positions = {far, far + Vec3(1, 0, 0), far + Vec3(0, 1, 0)}, .indices = {0, 1, 2}});
  const Surface lifted = lifting.moved(distant, moving());
  EXPECT_EQ(lifted.bounds({}).max.z, 1);
  EXPECT_NEAR(lifted.bounds({}).min.x, distant.bounds().min.x, 1e-6);  // where floats are a metre apart
}

TEST(VertexMovement, RemembersWhatItMoved) {
  ByFunction movement([](const Vec3f& p, const Vec3f&) { return Vec4f(3.0F * p, 1); });
  const Surface ball(icosphere(1));
  const Surface first = movement.moved(ball, moving());
  Material other = moving();
  EXPECT_NE(movement.moved(ball, other).identity(),
            first.identity());  // another shader, as far as that is known
  other.uniforms = {{.name = "a", .values = {1}}};
  static_cast<void>(movement.moved(ball, other));
  const int runs = movement.runs;
  EXPECT_EQ(movement.moved(ball, other).identity(), movement.moved(ball, other).identity());
  EXPECT_EQ(movement.runs, runs);
}

TEST(VertexMovement, RefusesWhatIsNoPlace) {
  const auto refusal = [](const Vec4f& place) {
    try {
      static_cast<void>(
          ByFunction([&](const Vec3f&, const Vec3f&) { return place; }).moved(icosphere(1), moving()));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("it was moved");
  };
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusal({nan, 0, 0, 1}), HasSubstr("which is no number"));
  EXPECT_THAT(refusal({0, infinity, 0, 1}), HasSubstr("which is no number"));
  EXPECT_THAT(refusal({0, 0, 0, nan}), HasSubstr("which is no number"));
  EXPECT_THAT(refusal({1, 0, 0, 0}), HasSubstr("at infinity"));
  EXPECT_THAT(refusal({1, 0, 0, -1}), HasSubstr("at infinity, or behind it"));
  EXPECT_THAT(refusal({1e30F, 0, 0, 1}), HasSubstr("m away"));
  EXPECT_THAT(refusal({1, 0, 0, 1}), HasSubstr("no triangle has an area"));
  EXPECT_THAT(refusal({nan, 0, 0, 1}), HasSubstr("a.vert:1:15"));
}

// A scene in C++ that has nobody to run its programs says so, where they may move a mesh.
TEST(VertexMovement, OfASceneHasToBeGiven) {
  Scene scene;
  scene.add(Node{.surface = icosphere(1), .material = scene.add(moving())});
  EXPECT_TRUE(scene.movesVertices());
  EXPECT_THROW(static_cast<void>(takeSnapshot(scene, 0, {8, 8})), Error);
  scene.set(std::make_shared<ByFunction>([](const Vec3f& p, const Vec3f&) { return Vec4f(3.0F * p, 1); }));
  const Snapshot snapshot = takeSnapshot(scene, 0, {8, 8});
  EXPECT_NEAR(snapshot.nodes.front().boundsWorld.extent().y, 6, 1e-6);
  EXPECT_EQ(snapshot, takeSnapshot(scene, 0, {8, 8}));
  EXPECT_NEAR(framingOf(snapshot).extent().y, 6, 1e-6);
}

}  // namespace
}  // namespace luxo::test
