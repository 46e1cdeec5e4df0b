// SPDX-License-Identifier: Apache-2.0
// The displacement of a material in scene files: what it makes of the surfaces of its nodes, and what is
// wrong with it.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/snapshot.h"
#include "scene_test_support.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

std::string textOf(const std::string& members) { return "{ \"luxo\": 1,\n" + members + "\n}"; }

Scene sceneOf(const std::string& members, std::vector<Diagnostic>* warnings = nullptr) {
  return buildScene(parseScene(textOf(members), "s"), {}, warnings);
}

TEST(SceneDisplacement, IsThatOfTheSurfaceOfEachNode) {
  const Scene scene = sceneOf(R"("params": { "k": 2 },
    "materials": { "plain": {}, "bumpy": { "let": { "a": "0.1k" }, "displacement": "a*sin(pi*v)+0.01t" },
                   "same": { "diffuse": 0.3, "let": { "a": "0.1k" }, "displacement": "a*sin(pi*v)+0.01t" },
                   "none": { "displacement": "0*k" } },
    "surfaces": { "ball": { "type": "sphere", "radius": 2 }, "ring": { "type": "torus" } },
    "nodes": [ { "surface": "ball", "material": "plain" }, { "surface": "ball", "material": "bumpy" },
               { "surface": "ball", "material": "bumpy" }, { "surface": "ball", "material": "same" },
               { "surface": "ball", "material": "none" }, { "surface": "ring", "material": "bumpy" } ])");
  const Snapshot snapshot = takeSnapshot(scene, 3, {8, 8});
  ASSERT_EQ(snapshot.nodes.size(), 6U);
  const auto surface = [&](std::size_t i) { return snapshot.nodes[i].surface; };
  // k = 2 and t = 3: 0.2 + 0.03 at the equator, 0.03 at the poles.
  const auto& parameters = snapshot.nodes[1].parameters;
  expectNear(surface(1).position(0.25, 0.5, parameters), {0, 0, -2.23}, 1e-14);
  expectNear(surface(1).position(0.25, 1, parameters), {0, 2.03, 0}, 1e-14);
  EXPECT_GE(snapshot.nodes[1].boundsObject.max.x, 2.23);
  EXPECT_TRUE(surface(1).closed());
  // One shape for what is displaced alike.
  EXPECT_EQ(surface(2).identity(), surface(1).identity());
  EXPECT_EQ(surface(3).identity(), surface(1).identity());
  EXPECT_NE(surface(1).identity(), surface(0).identity());
  EXPECT_EQ(surface(4).identity(), surface(0).identity());
  expectNear(surface(0).position(0.25, 0.5), {0, 0, -2}, 1e-14);
  EXPECT_NE(snapshot.nodes[3].material.index, snapshot.nodes[1].material.index);
}

TEST(SceneDisplacement, ColorsReadTheDisplacedSurface) {
  const Scene scene = sceneOf(R"("materials": { "m": { "diffuse": ["x", 0, "ny"], "displacement": 0.5 } },
    "surfaces": { "ball": { "type": "sphere", "radius": 2 } }, "nodes": [ { "surface": "ball", "material": "m" } ])");
  const Snapshot snapshot = takeSnapshot(scene, 0, {8, 8});
  const Material& material = snapshot.materials[snapshot.nodes[0].material.index];
  EXPECT_NEAR(material.diffuseAt(0, 0.5).x, 2.5, 1e-12);
}

TEST(SceneDisplacement, OpensSeamsThatItIsNotTheSameOn) {
  const auto of = [](const std::string& displacement, const std::string& surface) {
    return takeSnapshot(sceneOf(R"("materials": { "m": { "displacement": ")" + displacement +
                                R"(" } }, "surfaces": { "s": { "type": ")" + surface +
                                R"(" } }, "nodes": [ { "surface": "s", "material": "m" } ])"),
                        0, {8, 8})
        .nodes[0]
        .surface;
  };
  EXPECT_TRUE(of("0.1cos(tau*u)*cos(pi*(v-0.5))", "sphere").closed());
  EXPECT_TRUE(of("0.1sin(4tau*(u+2v))", "torus").closed());
  EXPECT_FALSE(of("0.1u", "sphere").closed());
  EXPECT_FALSE(of("0.1u", "torus").closed());
  EXPECT_TRUE(of("0.1u", "torus").topology().seamV());
  // At time 0 it is none, and afterwards no seam is closed.
  EXPECT_FALSE(of("0.1u*t", "torus").closed());
  // Too narrow for points here and there to tell.
  EXPECT_FALSE(of("0.1exp(-1e6(v-0.377)^2)*exp(-1e6u^2)", "torus").closed());
  EXPECT_FALSE(of("0.1exp(-1e6(u-0.377)^2)", "sphere").closed());
}

TEST(SceneDisplacement, IsWrittenAsItIsRead) {
  const SceneFile file = parseScene(
      textOf(
          R"json("materials": { "a": { "displacement": "0.1*sin(u)" }, "b": { "displacement": 0.25 } })json"),
      "s");
  EXPECT_EQ(file, parseScene(writeScene(file), "again")) << writeScene(file);
}

TEST(SceneDisplacement, KinksAndHolesAreTold) {
  std::vector<Diagnostic> warnings;
  static_cast<void>(sceneOf(R"json("materials": { "m": { "displacement": "0.1sqrt(u-0.5)" } },
    "surfaces": { "s": { "type": "torus" } }, "nodes": [ { "surface": "s", "material": "m" } ])json",
                            &warnings));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].message.find("surface 's', displaced by material 'm', has a hole"), std::string::npos)
      << warnings[0].message;
}

TEST(SceneDisplacement, MistakesAreToldWithTheirPlace) {
  const auto with = [](const std::string& displacement, const std::string& surface) {
    return R"("materials": { "m": { "displacement": )" + displacement + R"( } },
"surfaces": { "s": )" +
           surface + R"( }, "nodes": [ { "surface": "s", "material": "m" } ])";
  };
  const std::string ball = R"({ "type": "sphere" })";
  const std::pair<std::string, std::vector<std::string>> kMistakes[] = {
      {with(R"("0.1*w")", ball), {"s:2:44", "unknown name 'w'"}},
      {with(R"("0.1*(u")", ball), {"s:2:"}},
      {with("[1, 2, 3]", ball), {"s:2:39", "a number or a formula"}},
      {with("true", ball), {"s:2:39", "a number or a formula"}},
      {with("1e19", ball), {"s:2:39", "1e18"}},
      {with(R"("0.1*nx")", ball), {"s:2:39", "cannot use the place, normal or curvature", "with u and v"}},
      {with("0.1", R"({ "type": "cloth" })"),
       {"s:3:", "material 'm' displaces", "'s' is a mesh", "give that node"}},
      {with("0.1", R"({ "type": "superellipsoid" })"),
       {"s:3:", "'superellipsoid': where v = 0 its Su x Sv is 0", "does not show the normal"}},
  };
  for (const auto& mistake : kMistakes)
    expectSceneError([&] { static_cast<void>(sceneOf(mistake.first)); }, mistake.second);
}

}  // namespace
}  // namespace luxo::test
