// SPDX-License-Identifier: Apache-2.0
// Nodes, what they inherit, and how a scene is changed.
#include <cmath>
#include <limits>

#include "scene/scene.h"
#include "scene_test_support.h"

namespace luxo {
namespace {

using test::expectNear;
using test::expectSceneError;
using test::nodeNamed;
using test::snap;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kHuge = 1e200;

TEST(Hierarchy, ScalesThenRotatesThenTranslates) {
  Scene scene;
  scene.add(Node{.name = "n",
                 .translation = Vec3(1, 2, 3),
                 .rotation = Rotation{{0, 0, 1}, radians(90)},
                 .scale = Vec3(2, 3, 4),
                 .surface = sphere(1)});
  const Snapshot snapshot = snap(scene);
  const Transform& t = snapshot.nodes[0].worldFromObject;
  expectNear(transformPoint(t, {1, 0, 0}), {1, 4, 3}, 1e-15);   // 2 along x, turned to y
  expectNear(transformPoint(t, {0, 1, 0}), {-2, 2, 3}, 1e-15);  // 3 along y, turned to -x
  expectNear(transformPoint(t, {0, 0, 1}), {1, 2, 7}, 1e-15);   // 4 along z, not turned
  expectNear(transformDirection(t, {1, 0, 0}), {0, 2, 0}, 1e-15);
}

TEST(Hierarchy, NormalsStayPerpendicularUnderUnevenScale) {
  const Mat3 stretch(Vec3(2, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  const Vec3 normal(1, 1, 0), tangent(1, -1, 0);
  EXPECT_EQ(glm::dot(normalMatrix(stretch) * normal, stretch * tangent), 0);
  EXPECT_EQ(glm::dot(stretch * normal, stretch * tangent),
            3);  // what a normal treated as a direction would give
}

TEST(Hierarchy, ScaleIsInheritedAsInGltf) {
  Scene scene;
  const NodeId base = scene.add(Node{.name = "base", .scale = Vec3(2, 0.4, 2)});
  scene.add(Node{.name = "ball", .parent = base, .translation = Vec3(0, 1, 0), .surface = sphere(1)});
  const Snapshot snapshot = snap(scene);
  const Box& bounds = snapshot.nodes[0].boundsWorld;
  expectNear(bounds.extent(), {4, 0.8, 4}, 0.3);  // an ellipsoid; bounds may be a few percent loose
  expectNear(bounds.center(), {0, 0.4, 0}, 0.05);
}

TEST(Hierarchy, PointsAndDirectionsTravelDownTheSameChain) {
  Scene scene;
  const NodeId arm =
      scene.add(Node{.translation = Vec3(0, 3, 0), .rotation = Rotation{{1, 0, 0}, radians(90)}});
  scene.add(Node{.parent = arm, .translation = Vec3(0, 2, 0), .light = Light{}});
  scene.add(
      Node{.parent = arm, .translation = Vec3(0, 2, 0), .light = Light{.type = Light::Type::Directional}});
  const Snapshot snapshot = snap(scene);
  ASSERT_EQ(snapshot.lights.size(), 2u);
  // +Y of the arm is +Z of the world; +Z of the arm, toward a directional light, is -Y of the world.
  expectNear(Vec3(snapshot.lights[0].positionWorld), {0, -1, 0}, 1e-15);
  EXPECT_EQ(snapshot.lights[0].positionWorld.w, 0);
  expectNear(Vec3(snapshot.lights[1].positionWorld), {0, 3, 2}, 1e-15);
  EXPECT_EQ(snapshot.lights[1].positionWorld.w, 1);
}

TEST(Hierarchy, InvisibleNodesHideWhatHangsOnThem) {
  Scene scene;
  const NodeId top = scene.add(Node{.name = "top", .visible = [](double t) { return t < 1; }});
  const NodeId ball = scene.add(Node{.name = "ball", .parent = top, .surface = sphere(1)});
  scene.add(Node{.name = "glow", .parent = ball, .light = Light{}});
  EXPECT_EQ(snap(scene, 0.5).nodes.size(), 1u);
  EXPECT_EQ(snap(scene, 0.5).lights.size(), 1u);
  EXPECT_TRUE(snap(scene, 1.5).nodes.empty());
  EXPECT_TRUE(snap(scene, 1.5).lights.empty());
}

TEST(Hierarchy, NumbersAreDepthFirstWhateverTheOrderOfAdding) {
  Scene scene;
  const NodeId a = scene.add(Node{.name = "a", .surface = sphere(1)});
  const NodeId b = scene.add(Node{.name = "b", .surface = sphere(1)});
  const NodeId aa = scene.add(Node{.name = "aa", .parent = a});  // no surface, but it counts
  scene.add(Node{.name = "ba", .parent = b, .surface = sphere(1)});
  scene.add(Node{.name = "aaa", .parent = aa, .surface = sphere(1)});
  scene.add(Node{.name = "ab", .parent = a, .surface = sphere(1), .visible = true});
  // a, aa, aaa, ab, b, ba
  const Snapshot snapshot = snap(scene);
  const auto number = [&](const char* name) { return nodeNamed(scene, snapshot, name).number; };
  EXPECT_EQ(number("a"), 1u);
  EXPECT_EQ(number("aaa"), 3u);
  EXPECT_EQ(number("ab"), 4u);
  EXPECT_EQ(number("b"), 5u);
  EXPECT_EQ(number("ba"), 6u);
}

TEST(Hierarchy, SpinIsAnAngleOfAbsoluteTime) {
  const Animated<Rotation> turning = spin({1, 5, 1}, 0.1);
  EXPECT_FALSE(turning.isConstant());
  for (const double t : {0.0, 1.0, 21.0, 1000.0, 86400.0}) {
    const double angle = turning.at(t).angle;
    // The product needs 64 bits more than a double has for 1e-15; a long double's 64-bit mantissa gives 8640
    // * 2^-64.
    const long double product = static_cast<long double>(0.1) * t;
    EXPECT_LE(std::abs(angle), kPi + 1e-15);
    EXPECT_NEAR(std::sin(angle), static_cast<double>(std::sin(product)), 2e-15) << t;
    EXPECT_NEAR(std::cos(angle), static_cast<double>(std::cos(product)), 2e-15) << t;
  }
  EXPECT_EQ(angleAt(0.5, 0), 0);
  EXPECT_NEAR(angleAt(0.5, 1e9), std::remainder(5e8, kTau), 1e-7);  // remainder by a rounded 2 pi, 8e7 times
}

TEST(Hierarchy, DeepChainsStayExact) {
  Scene scene;
  NodeId link{};
  for (int i = 0; i < 1000; ++i)
    link = scene.add(
        Node{.parent = link, .translation = Vec3(0, 1, 0), .rotation = Rotation{{0, 0, 1}, kTau / 1000}});
  scene.add(Node{.parent = link, .surface = sphere(1)});
  const Transform end = snap(scene).nodes[0].worldFromObject;
  expectNear(end.linear[0], {1, 0, 0}, 1000 * 1e-15);  // a full turn, a rounding per link
  expectNear(end.translation, {0, 0, 0}, 1e-9);        // a closed polygon of 1000 unit sides
}

TEST(Scene, RemovingANodeTakesItsChildrenAndKeepsIds) {
  Scene scene;
  const NodeId a = scene.add(Node{.name = "a", .surface = sphere(1)});
  const NodeId child = scene.add(Node{.name = "child", .parent = a, .surface = sphere(1)});
  const NodeId b = scene.add(Node{.name = "b", .surface = sphere(1)});
  const auto before = scene.version();
  scene.remove(a);
  EXPECT_GT(scene.version(), before);
  const Snapshot snapshot = snap(scene);
  ASSERT_EQ(snapshot.nodes.size(), 1u);
  EXPECT_EQ(snapshot.nodes[0].id, b);
  EXPECT_EQ(snapshot.nodes[0].number, 1u);
  EXPECT_FALSE(scene.findNode("child"));
  EXPECT_GT(scene.add(Node{}), b);
  EXPECT_EQ(scene[child].name, "child");
}

TEST(Scene, ThingsAreFoundByName) {
  Scene scene;
  scene.add(Node{.name = "x"});
  const NodeId y = scene.add(Node{.name = "y"});
  const CameraId top = scene.add(Camera{.name = "top"});
  EXPECT_EQ(scene.findNode("y"), y);
  EXPECT_FALSE(scene.findNode("z"));
  EXPECT_EQ(scene.findCamera("top"), top);
  EXPECT_FALSE(scene.findCamera("bottom"));
}

TEST(Scene, SetReplacesAndCounts) {
  Scene scene;
  const MaterialId red = scene.add(Material{.name = "red", .diffuse = {1, 0, 0}});
  const NodeId node = scene.add(Node{.name = "n", .surface = sphere(1), .material = red});
  const auto version = scene.version();
  scene.set(red, Material{.name = "red", .diffuse = {0.5, 0, 0}});
  scene.set(node, Node{.name = "n", .surface = sphere(2), .material = red});
  scene.set(RenderSettings{.ambient = Vec3(0.5)});
  EXPECT_EQ(scene.version(), version + 3);
  EXPECT_EQ(scene[red].at(0).diffuse.x, 0.5);
  EXPECT_EQ(scene.settings().ambient, Vec3(0.5));
  EXPECT_GT(snap(scene).nodes[0].boundsWorld.max.x, 1.9);
}

TEST(Scene, DefaultsAreTheDocumentedOnes) {
  const RenderSettings s = Scene().settings();
  EXPECT_EQ(s.size, (PixelSize{1280, 720}));
  EXPECT_EQ(s.samples, 1);
  EXPECT_EQ(s.fps, 24);
  EXPECT_EQ(s.tolerance, 0.5);
  EXPECT_EQ(s.background, Vec3(0.02, 0.025, 0.03));
  EXPECT_EQ(s.ambient, Vec3(0.1));
  const Material m;
  EXPECT_EQ(m.ambientOrDiffuse(), Vec3(0.7));
  EXPECT_EQ(m.specular, Vec3(0.2));
  EXPECT_EQ(m.shininess, 30);
  EXPECT_FALSE(m.transparent());
  Scene scene;
  scene.add(Node{.surface = sphere(1)});  // no material
  const Snapshot snapshot = snap(scene);
  EXPECT_EQ(snapshot.materials[snapshot.nodes[0].material.index].diffuse, Vec3(0.7));
}

TEST(Scene, BadConstantsAreRefusedWhenAdded) {
  Scene scene;
  expectSceneError(
      [&] {
        scene.add(Material{.name = "red", .diffuse = {-1, 0, 0}});
      },
      {"red", "diffuse", "-1"});
  expectSceneError([&] { scene.add(Material{.name = "red", .ambient = Vec3(kNaN)}); },
                   {"red", "ambient", "nan"});
  expectSceneError([&] { scene.add(Material{.specular = Vec3(0, 0, INFINITY)}); }, {"specular", "inf"});
  expectSceneError([&] { scene.add(Material{.shininess = -3}); }, {"shininess", "-3"});
  for (const double opacity : {-0.1, 1.1, kNaN})
    expectSceneError([&] { scene.add(Material{.opacity = opacity}); }, {"opacity", "0 to 1"});
  expectSceneError([&] { scene.add(Node{.name = "n", .translation = Vec3(kNaN)}); },
                   {"n", "translation", "nan"});
  expectSceneError([&] { scene.add(Node{.name = "n", .scale = Vec3(INFINITY)}); }, {"n", "scale", "inf"});
  expectSceneError([&] { scene.add(Node{.name = "n", .light = Light{.intensity = -1}}); },
                   {"n", "intensity", "-1"});
  expectSceneError([&] { scene.add(Node{.name = "n", .light = Light{.color = Vec3(kNaN)}}); },
                   {"n", "color"});
  expectSceneError(
      [&] {
        scene.add(Node{.name = "n", .segments = Segments{0, 4}});
      },
      {"n", "segments", "0 x 4"});
  expectSceneError([&] { scene.set(RenderSettings{.tolerance = 0}); },
                   {"tolerance", "from 1e-06 to 1000000"});
  expectSceneError([&] { scene.set(RenderSettings{.ambient = Vec3(-1)}); }, {"ambient"});
  EXPECT_TRUE(scene.nodes().empty());
}

TEST(Scene, BadMomentsAreNamedWithTheirTime) {
  const auto reject = [](Node node, const std::vector<std::string>& texts) {
    Scene scene;
    node.name = "arm";
    if (!node.surface.valid()) node.surface = sphere(1);
    scene.add(std::move(node));
    expectSceneError([&] { (void)snap(scene, 2.5); }, texts);
  };
  reject({.translation = [](double) { return Vec3(kNaN); }}, {"arm", "2.5", "translation"});
  reject({.scale = [](double) { return Vec3(INFINITY); }}, {"arm", "2.5", "scale"});
  reject({.rotation = Rotation{{0, 0, 0}, 1}}, {"arm", "zero axis"});
  reject({.rotation = Rotation{{0, 1, 0}, kNaN}}, {"arm", "rotation", "nan"});
  reject({.surface = flag({.phase = [](double t) { return t < 1 ? t : kNaN; }})},
         {"arm", "parameter", "flag"});

  Scene still;
  still.add(Node{.rotation = Rotation{{0, 0, 0}, 0}, .surface = sphere(1)});  // a zero axis turns by nothing
  EXPECT_EQ(snap(still).nodes[0].worldFromObject, Transform{});

  Scene huge;
  const NodeId parent = huge.add(Node{.scale = Vec3(kHuge)});
  huge.add(Node{.name = "tip", .parent = parent, .scale = Vec3(kHuge), .surface = sphere(1)});
  expectSceneError([&] { (void)snap(huge); }, {"tip", "not finite"});
  expectSceneError([&] { (void)snap(Scene{}, kNaN); }, {"time"});
}

TEST(SceneDeath, NamingWhatDoesNotExistIsAMistake) {
  Scene scene;
  const NodeId node = scene.add(Node{});
  EXPECT_DEATH(scene.add(Node{.parent = {7}}), "parent");
  EXPECT_DEATH(scene.add(Node{.material = {7}}), "material");
  EXPECT_DEATH(scene.add(Node{.light = Light{.casters = {{7}}}}), "casters");
  EXPECT_DEATH(scene.set(node, Node{.parent = node}), "parent");  // no node carries itself
}

}  // namespace
}  // namespace luxo
