// SPDX-License-Identifier: Apache-2.0
// From descriptions to scenes: every key has its meaning, formulas mean what the same C++ means, parameters
// turn everything and recompile nothing.
#include "scene/scene_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/srgb_curve.h"
#include "luxo_grandpa/lamp.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene_examples.h"
#include "scene_test_support.h"

namespace luxo {
namespace {

using test::expectNear;

Scene build(const std::string& text, std::span<const ParameterOverride> overrides = {}) {
  return buildScene(parseScene("{ \"luxo\": 1, " + text + " }", "test"), overrides);
}

Snapshot builtSnapshot(const Scene& scene, double time = 0) { return takeSnapshot(scene, time, {64, 48}); }

const SnapshotNode& nodeNamed(const Scene& scene, const Snapshot& snapshot, std::string_view name) {
  for (const SnapshotNode& node : snapshot.nodes)
    if (scene[node.id].name == name) return node;
  throw std::runtime_error("no such node");
}

TEST(SceneBuilder, DefaultsAreThoseOfTheEngine) {
  const Scene scene =
      build(R"_("materials": { "m": {} }, "nodes": [{ "light": {} }], "cameras": { "c": {} })_");
  EXPECT_EQ(scene.settings(), RenderSettings{});
  EXPECT_EQ(scene[MaterialId{1}].at(0), Material{.name = "m"});
  const Node& node = scene[NodeId{0}];
  EXPECT_EQ(node.scale.at(0), Vec3(1));
  EXPECT_EQ(node.rotation.at(0), Rotation{});
  EXPECT_EQ(node.light->intensity.at(0), Light{}.intensity.at(0));
  EXPECT_EQ(node.light->color.at(0), Vec3(1));
  EXPECT_EQ(node.light->type, Light::Type::Point);
  const Camera& camera = scene[CameraId{0}];
  EXPECT_EQ(camera.eye.at(0), Camera{}.eye.at(0));
  EXPECT_NEAR(camera.fovY.at(0), Camera{}.fovY.at(0), 1e-15);
  EXPECT_EQ(camera.near.at(0), Camera{}.near.at(0));
  EXPECT_EQ(camera.height.at(0), Camera{}.height.at(0));
}

TEST(SceneBuilder, EveryKeyHasItsMeaning) {
  const Scene scene = build(R"_(
    "render": { "size": [320, "16*15"], "time": 2, "fps": 30, "samples": 4, "tolerance": 0.25, "shading": "gouraud",
                "background": "#ff8000", "ambient": 0.3 },
    "materials": { "m": { "diffuse": [0.1, "0.2", "t"], "ambient": "1/4", "specular": 0.8, "shininess": 60,
                          "opacity": 0.5, "two_sided": true, "shading": "flat", "lecture_specular": true },
                   "n": { "two_sided": false }, "o": { "two_sided": "auto" } },
    "surfaces": { "s": { "type": "sphere", "radius": 2, "segments": [8, 4] } },
    "nodes": [ { "name": "a", "translate": [1, "t", 3], "scale": [1, 2, 3], "visible": true, "surface": "s",
                 "material": "m", "children": [ { "name": "b", "visible": "t < 1" }, { "name": "c" } ] },
               { "name": "d", "visible": false,
                 "light": { "type": "directional", "color": [1, 0.5, 0], "intensity": "2t",
                            "attenuation": "inverse-square", "shadow": "exact", "casters": ["a", "d"] } } ],
    "camera": { "eye": ["t", 1, 2], "look_at": [3, 4, 5], "up": [0, 0, 1], "fov_y": "50deg", "near": 0.2,
                "type": "orthographic", "height": 7 },
    "cameras": { "top": { "eye": [0, 9, 0] } })_");

  const RenderSettings expected{.size = {320, 240},
                                .time = 2,
                                .fps = 30,
                                .samples = 4,
                                .tolerance = 0.25,
                                .shading = Shading::Gouraud,
                                .background = {1, linearFromSrgb(128 / 255.0), 0},
                                .ambient = Vec3(0.3)};
  EXPECT_EQ(scene.settings(), expected);

  const Material material{.name = "m",
                          .diffuse = {0.1, 0.2, 7},
                          .ambient = Vec3(0.25),
                          .specular = Vec3(0.8),
                          .shininess = 60,
                          .opacity = 0.5,
                          .twoSided = TwoSided::Yes,
                          .shading = Shading::Flat,
                          .lectureSpecular = true};
  EXPECT_EQ(scene[MaterialId{1}].at(7), material);
  EXPECT_EQ(scene[MaterialId{2}].at(0).twoSided, TwoSided::No);
  EXPECT_EQ(scene[MaterialId{3}].at(0).twoSided, TwoSided::Auto);

  const Node &a = scene[NodeId{0}], &b = scene[NodeId{1}], &c = scene[NodeId{2}], &d = scene[NodeId{3}];
  EXPECT_EQ(a.translation.at(5), Vec3(1, 5, 3));
  EXPECT_EQ(a.scale.at(0), Vec3(1, 2, 3));
  EXPECT_TRUE(a.visible.isConstant() && a.visible.at(0));
  EXPECT_EQ(a.segments, (Segments{8, 4}));
  EXPECT_NEAR(glm::length(a.surface.position(0.3, 0.4)), 2, 1e-14);
  EXPECT_EQ(a.material, MaterialId{1});
  EXPECT_EQ(b.parent, NodeId{0});
  EXPECT_EQ(c.parent, NodeId{0});
  EXPECT_FALSE(d.parent.valid());
  EXPECT_TRUE(b.visible.at(0.5));
  EXPECT_FALSE(b.visible.at(1.5));
  EXPECT_FALSE(d.visible.at(0));
  EXPECT_EQ(d.light->type, Light::Type::Directional);
  EXPECT_EQ(d.light->color.at(0), Vec3(1, 0.5, 0));
  EXPECT_EQ(d.light->intensity.at(3), 6);
  EXPECT_EQ(d.light->attenuation, Light::Attenuation::InverseSquare);
  EXPECT_EQ(d.light->shadow, Light::Shadow::Exact);
  EXPECT_EQ(d.light->casters, (std::vector<NodeId>{{0}, {3}}));

  const Camera& camera = scene[CameraId{0}];
  EXPECT_EQ(camera.name, "camera");
  EXPECT_EQ(camera.eye.at(4), Vec3(4, 1, 2));
  EXPECT_EQ(camera.lookAt.at(0), Vec3(3, 4, 5));
  EXPECT_EQ(camera.up.at(0), Vec3(0, 0, 1));
  EXPECT_NEAR(camera.fovY.at(0), radians(50), 1e-15);
  EXPECT_EQ(camera.near.at(0), 0.2);
  EXPECT_EQ(camera.projection, Projection::Orthographic);
  EXPECT_EQ(camera.height.at(0), 7);
  EXPECT_EQ(scene.findCamera("top"), CameraId{1});
}

// The same scene, the same picture: everything that is drawn compares bit by bit, but for surfaces, whose
// identity differs; their formulas are the catalogue's on both sides.
TEST(SceneBuilder, TheLampAsAFileIsTheLampInCpp) {
  const Scene cpp = luxoGrandpa();
  const Scene file = buildScene(parseScene(test::sourceText("apps/scenes/luxo-grandpa.luxo.json"), "lamp"));
  EXPECT_EQ(file.settings(), cpp.settings());
  for (const double time : {0.0, 21.0, 3.7, 1e6 + 0.125}) {
    const Snapshot a = builtSnapshot(file, time), b = builtSnapshot(cpp, time);
    EXPECT_EQ(a.view, b.view);
    EXPECT_EQ(a.lights, b.lights);
    EXPECT_EQ(a.ambient, b.ambient);
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
      EXPECT_EQ(file[a.nodes[i].id].name, cpp[b.nodes[i].id].name);
      EXPECT_EQ(a.nodes[i].worldFromObject, b.nodes[i].worldFromObject) << cpp[b.nodes[i].id].name;
      EXPECT_EQ(a.materials[a.nodes[i].material.index], b.materials[b.nodes[i].material.index]);
      for (const double u : {0.0, 0.3, 1.0})
        EXPECT_EQ(a.nodes[i].surface.position(u, 0.7), b.nodes[i].surface.position(u, 0.7));
    }
  }
}

TEST(SceneBuilder, FormulasMeanWhatTheSameCppMeans) {
  const Scene scene = build(R"_(
    "params": { "k": { "value": 3, "range": [1, 12] }, "deep": 0.25 },
    "surfaces": { "s": { "type": "formula", "u": [0, "tau"], "v": [-1, "1/2"],
                         "let": { "r": "1 + depth*cos(k*u + t)", "depth": "deep*v" },
                         "position": ["r*cos(u)", "2v", "-r*sin(u)"]
}
},
    "nodes": [ { "surface": "s" } ])_");
  const Surface& surface = scene[NodeId{0}].surface;
  EXPECT_EQ(surface.domain().u.hi, kTau);
  EXPECT_EQ(surface.domain().v, Interval(-1, 0.5));
  EXPECT_TRUE(surface.topology().seamU());
  const double time = 0.7;
  const std::vector<double> parameters = builtSnapshot(scene, time).nodes[0].parameters;
  for (const double u : {0.1, 2.0, 5.0})
    for (const double v : {-0.9, 0.3}) {
      const double r = 1 + 0.25 * v * std::cos(3 * u + time);
      expectNear(surface.position(u, v, parameters), {r * std::cos(u), 2 * v, -r * std::sin(u)}, 1e-14);
    }
}

TEST(SceneBuilder, RangesMayMove) {
  const Scene scene = build(R"_(
    "params": { "turns": { "value": 0.5, "range": [0, 1] } },
    "surfaces": { "s": { "type": "formula", "u": [0, "turns*tau"], "position": ["cos(u)", "v", "sin(u)"]
}
},
    "nodes": [ { "surface": "s" } ])_");
  Scene more = scene;
  more.setParameter(ParameterId{0}, 0.25);
  const auto end = [](const Scene& s) {
    const Snapshot snapshot = builtSnapshot(s);
    const Surface& surface = snapshot.nodes[0].surface;
    return surface.position(surface.domain().u.hi, 0, snapshot.nodes[0].parameters);
  };
  expectNear(end(scene), {-1, 0, 0}, 1e-15);
  expectNear(end(more), {0, 0, 1}, 1e-15);
}

TEST(SceneBuilder, ProfilesTurnAboutTheAxis) {
  const Scene scene = build(R"_(
    "surfaces": { "vase": { "type": "revolve", "v": [0, 2], "let": { "r": "1 + v" }, "radius": "r", "height": "v^2" },
                  "half": { "type": "revolve", "u": [0, "1/2"], "radius": 1, "height": "v" } },
    "nodes": [ { "surface": "vase" }, { "surface": "half" } ])_");
  const Surface &vase = scene[NodeId{0}].surface, &half = scene[NodeId{1}].surface;
  expectNear(vase.position(0, 1.5), {2.5, 2.25, 0}, 1e-15);
  expectNear(vase.position(0.25, 1.5), {0, 2.25, -2.5}, 1e-15);
  EXPECT_TRUE(vase.revolution());
  EXPECT_TRUE(vase.topology().seamU());
  expectNear(half.position(0.5, 1), {-1, 1, 0}, 1e-15);
  EXPECT_FALSE(half.revolution());
  EXPECT_FALSE(half.topology().seamU());
}

TEST(SceneBuilder, TubesAndPatches) {
  const Scene scene = build(R"_(
    "surfaces": { "ring": { "type": "tube", "u": [0, "tau"], "curve": ["2cos(u)", 0, "2sin(u)"], "radius": 0.5 },
                  "sheet": { "type": "bezier", "control_points": [[
                    [0,0,0], [1,0,0], [2,0,0], [3,0,0], [0,0,1], [1,0,1], [2,0,1], [3,0,1],
                    [0,0,2], [1,0,2], [2,0,2], [3,0,2], [0,0,3], [1,0,3], [2,0,3], ["1 + 2", 0, 3] ]] },
                  "twin": {
  "type" : "bezier",
           "control_points" : [ [ 0, 0, 0 ], [ 3, 0, 0 ], [ 0, 0, 3 ], [ 3, 0, 3 ] ],
                              "patches" : [[ 0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3 ]]
}
},
    "nodes": [ { "surface": "ring" }, { "surface": "sheet" }, { "surface": "twin" } ])_");
  const Surface& ring = scene[NodeId{0}].surface;
  for (const double v : {0.0, 0.3, 0.8}) {  // a torus, whichever way its frame starts
    const Vec3 p = ring.position(1.2, v);
    EXPECT_NEAR(std::hypot(std::hypot(p.x, p.z) - 2, p.y), 0.5, 1e-14);
  }
  // Evenly spaced control points: the linear map.
  expectNear(scene[NodeId{1}].surface.position(0.25, 0.75), {0.75, 0, 2.25}, 1e-15);
  expectNear(scene[NodeId{2}].surface.position(1, 1), {3, 0, 3}, 1e-15);
}

TEST(SceneBuilder, ArgumentsMayMove) {
  const Scene scene = build(R"_(
    "params": { "size": { "value": 2, "range": [1, 4] } },
    "surfaces": { "s": { "type": "sphere", "radius": "size + t" } },
    "nodes": [ { "surface": "s" } ])_");
  Scene large = scene;
  large.setParameter(ParameterId{0}, 4);
  const auto radius = [](const Scene& s, double time) {
    const Snapshot snapshot = builtSnapshot(s, time);
    return glm::length(snapshot.nodes[0].surface.position(0.2, 0.6, snapshot.nodes[0].parameters));
  };
  EXPECT_NEAR(radius(scene, 0), 2, 1e-14);
  EXPECT_NEAR(radius(scene, 1), 3, 1e-14);
  EXPECT_NEAR(radius(large, 1), 5, 1e-14);
}

TEST(SceneBuilder, WhatASurfaceDoesNotReadDoesNotChangeIt) {
  const Scene scene = build(R"_(
    "params": { "a": { "value": 1, "range": [0, 2] }, "b": { "value": 1, "range": [0, 2] } },
    "surfaces": { "s": { "type": "formula", "position": ["u*b", "v", "0"] } }, "nodes": [ { "surface": "s" } ])_");
  Scene other = scene;
  other.setParameter(ParameterId{0}, 2);
  EXPECT_EQ(builtSnapshot(scene).nodes[0].parameters, std::vector<double>{1});
  EXPECT_EQ(builtSnapshot(other).nodes[0], builtSnapshot(scene, 5).nodes[0]);
  other.setParameter(ParameterId{1}, 2);
  EXPECT_EQ(builtSnapshot(other).nodes[0].parameters, std::vector<double>{2});
  EXPECT_EQ(builtSnapshot(other).nodes[0].surface.identity(),
            builtSnapshot(scene).nodes[0].surface.identity());  // not recompiled
}

TEST(SceneBuilder, ColorsThatVaryOverASurfaceArePatterns) {
  const Scene scene = build(R"_(
    "params": { "n": { "value": 4, "range": [1, 9] } },
    "materials": { "m": { "diffuse": ["mod(floor(n*u) + floor(n*v), 2)", 0.5, "0.1 + t"] } })_");
  Scene fine = scene;
  fine.setParameter(ParameterId{0}, 8);
  const auto colorAt = [](const Scene& s, double u, double v, double time) {
    const Material material = builtSnapshot(s, time).materials[1];
    EXPECT_TRUE(material.diffusePattern.valid());
    return material.diffusePattern.colorAt(u, v, material.patternParameters);
  };
  EXPECT_EQ(colorAt(scene, 0.1, 0.1, 0), Vec3(0, 0.5, 0.1));
  EXPECT_EQ(colorAt(scene, 0.3, 0.1, 1), Vec3(1, 0.5, 1.1));
  EXPECT_EQ(colorAt(fine, 0.3, 0.1, 0), Vec3(0, 0.5, 0.1));
}

TEST(SceneBuilder, ParametersMayUseEachOtherInAnyOrder) {
  const Scene scene = build(R"_(
    "params": { "area": "pi*r^2", "r": "d/2", "d": { "value": 4, "range": [1, 8], "step": "1/2", "label": "width" },
                "wave": "sin(t)" },
    "nodes": [ { "translate": ["area", "wave", "d"] } ])_");
  ASSERT_EQ(scene.parameters().size(), 4u);
  const Parameter& d = scene[*scene.findParameter("d")];
  EXPECT_EQ(d.label, "width");
  EXPECT_EQ(d.range, Interval(1, 8));
  EXPECT_EQ(d.step, 0.5);
  const auto place = [](const Scene& s, double time) {
    const std::vector<double> parameters = s.parametersAt(time);
    return s[NodeId{0}].translation.at({time, parameters});
  };
  expectNear(place(scene, 1), {4 * kPi, std::sin(1.0), 4}, 1e-14);
  Scene wide = scene;
  wide.setParameter(*wide.findParameter("d"), 8);
  expectNear(place(wide, 1), {16 * kPi, std::sin(1.0), 8}, 1e-14);
  EXPECT_TRUE(scene.movesWithTime());
}

TEST(SceneBuilder, ParametersAloneDoNotMove) {
  EXPECT_FALSE(build(R"_("params": { "k": 1, "l": "2k" }, "materials": { "m": { "opacity": "k/2" } },
    "surfaces": { "s": { "type": "sphere", "radius": "k" } },
    "nodes": [ { "translate": [0, "k", 0], "rotate": [{ "axis": [0, 1, "k"], "angle": 1 }, { "axis": [1, 0, 0], "angle": "k" }],
                 "visible": "k > 0", "surface": "s", "material": "m" } ])_")
                   .movesWithTime());
  for (const char* const moving :
       {R"_("nodes": [ { "visible": "t" } ])_", R"_("nodes": [ { "scale": [1, "1 + t", 1] } ])_",
        R"_("nodes": [ { "rotate": { "axis": ["1 + t^2", 0, 0], "angle": 1 } } ])_",
        R"_("materials": { "m": { "opacity": "1/(1 + t^2)" } })_", R"_("camera": { "near": "1 + t^2" })_",
        R"_("params": { "k": "t" })_"})
    EXPECT_TRUE(build(moving).movesWithTime()) << moving;
}

TEST(SceneBuilder, OverridesReplaceValues) {
  const std::string text = R"_("params": { "k": { "value": 3, "range": [1, 12] }, "l": "k + 1" })_";
  const auto value = [&](std::vector<ParameterOverride> overrides, const char* name, double time = 0) {
    const Scene scene = build(text, overrides);
    return scene.parametersAt(time)[scene.findParameter(name)->index];
  };
  EXPECT_EQ(value({}, "l"), 4);
  EXPECT_EQ(value({{"k", 5}}, "l"), 6);
  EXPECT_EQ(value({{"k", "2 + 3"}, {"k", 7}}, "l"), 8);  // the last counts
  EXPECT_EQ(value({{"l", "t"}}, "l", 9), 9);
  EXPECT_EQ(value({{"k", "l"}, {"l", 2}}, "k"), 2);

  const auto error = [&](std::vector<ParameterOverride> overrides) -> std::string {
    try {
      static_cast<void>(build(text, overrides));
      return "nothing";
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::Usage) << e.what();
      return std::string(e.what()) + "|" + e.hint();
    }
  };
  EXPECT_EQ(error({{"kk", 5}}), "'-P kk=5': the scene has no parameter 'kk'|its parameters are k, l");
  EXPECT_EQ(error({{"k", 13}}), "'-P k=13': parameter 'k' is 13, outside its range from 1 to 12|");
  EXPECT_NE(error({{"k", "3 +"}}).find("-P k:1:"), std::string::npos);
  EXPECT_NE(error({{"k", "1/0"}}).find("'-P k=1/0': parameter 'k' is inf"), std::string::npos);
}

TEST(SceneBuilder, ConstantRateTurnsForEver) {
  const double late = 1e9 + 0.1;
  for (const char* const angle : {"0.5t", "t*0.5", "0.5*t"}) {
    const Scene scene = build(std::string(R"_("nodes": [ { "rotate": { "axis": [1, 5, 1], "angle": ")_") +
                              angle + R"_(" } } ])_");
    EXPECT_EQ(scene[NodeId{0}].rotation.at(late), spin({1, 5, 1}, 0.5).at(late)) << angle;
  }
  const Scene back = build(R"_("nodes": [ { "rotate": { "axis": [0, 1, 0], "angle": "-t" } } ])_");
  EXPECT_EQ(back[NodeId{0}].rotation.at(late), spin({0, 1, 0}, -1).at(late));
  // Not a rate: floor is flat almost everywhere, but no constant.
  const Scene steps = build(R"_("nodes": [ { "rotate": { "axis": [0, 1, 0], "angle": "floor(t)" } } ])_");
  EXPECT_EQ(steps[NodeId{0}].rotation.at(2.5).angle, 2);
}

TEST(SceneBuilder, ListsOfRotationsAreProducts) {
  const Scene scene = build(R"_("nodes": [
    { "rotate": [ { "axis": [0, 2, 0], "angle": "35deg" }, { "axis": [1, 0, 0], "angle": "-40deg" }, { "axis": [1, 1, 1], "angle": 2 } ] },
    { "rotate": [ { "axis": [0, 2, 0], "angle": "t" }, { "axis": [1, 0, 0], "angle": 0.5 } ] },
    { "rotate": [ { "axis": [0, 1, 0], "angle": 1 }, { "axis": [0, 1, 0], "angle": -1 } ] },
    { "rotate": [] } ])_");
  const auto matrix = [&](std::uint32_t node, double time) {
    const Rotation r = scene[NodeId{node}].rotation.at(time);
    return rotation(r.axis, r.angle);
  };
  const auto expectSame = [](const Mat3& a, const Mat3& b) {
    for (int column = 0; column < 3; ++column) expectNear(a[column], b[column], 1e-15);
  };
  expectSame(matrix(0, 0),
             rotation({0, 1, 0}, radians(35)) * rotation({1, 0, 0}, radians(-40)) * rotation({1, 1, 1}, 2));
  expectSame(matrix(1, 1.25), rotation({0, 1, 0}, 1.25) * rotation({1, 0, 0}, 0.5));
  expectSame(matrix(2, 0), Mat3(1));
  expectSame(matrix(3, 0), Mat3(1));
}

TEST(SceneBuilder, HexadecimalColorsAreSrgb) {
  const Scene scene = build(R"_("materials": { "m": { "diffuse": "#0080FF", "specular": "#fff" } })_");
  const Material material = scene[MaterialId{1}].at(0);
  // IEC 61966-2-1: 128/255 is 0.2158605 linear.
  expectNear(material.diffuse, {0, 0.21586050011389926, 1}, 1e-16);
  EXPECT_EQ(material.specular, Vec3(1));
}

TEST(SceneBuilder, ColoursWhoseFormulasSimplifyAreUniform) {
  const Scene scene = build(R"_("params": { "k": 0.25 }, "materials": {
    "a": { "diffuse": ["0.5+0*v", "u^0", "u-u"] }, "b": { "diffuse": ["k+0*v", "0.5t*u^0", "u - u + 1"] },
    "c": { "diffuse": "0.5 + (u - u)" } })_");
  const double k = 0.25;
  const auto materialAt = [&](std::uint32_t id, double time) {
    return scene[MaterialId{id}].at({time, {&k, 1}});
  };
  for (const std::uint32_t id : {1, 2, 3}) EXPECT_FALSE(materialAt(id, 0).diffusePattern.valid()) << id;
  EXPECT_TRUE(scene[MaterialId{1}].isConstant());
  EXPECT_EQ(materialAt(1, 0).diffuse, Vec3(0.5, 1, 0));
  EXPECT_EQ(materialAt(2, 0.5).diffuse, Vec3(0.25, 0.25, 1));
  EXPECT_TRUE(scene[MaterialId{2}].movesWithTime());
  EXPECT_EQ(materialAt(3, 0).diffuse, Vec3(0.5));
}

TEST(SceneBuilder, NamesInAnotherOrderThanUse) {
  const Scene scene = build(R"_("nodes": [
      { "name": "lamp", "light": { "shadow": "exact", "casters": ["shade"] } }, { "name": "shade" } ])_");
  EXPECT_EQ(scene[NodeId{0}].light->casters, std::vector<NodeId>{NodeId{1}});
}

TEST(SceneBuilder, DescriptionsMadeInCppNeedNoText) {
  SceneFile file;
  file.parameters.push_back({.name = "k", .value = 3, .range = QuantityPair{1, 12}});
  file.surfaces.push_back({.name = "s", .shape = FormulaShape{.position = {"u", "sin(k*u)", "v"}}});
  file.nodes.push_back({.surface = "s"});
  const Scene scene = buildScene(file);
  const Snapshot snapshot = builtSnapshot(scene);
  expectNear(nodeNamed(scene, snapshot, "").surface.position(0.5, 1, snapshot.nodes[0].parameters),
             {0.5, std::sin(1.5), 1}, 1e-15);

  file.nodes[0].translate[1] = "2 +* 3";
  file.nodes[0].material = "none";
  test::expectSceneError([&] { static_cast<void>(buildScene(file)); },
                         {"formula:1:3: ", "2 +* 3", "there is no material 'none'"});
}

/// "line:column message (hint)" of every warning.
std::vector<std::string> warningsOf(const std::string& text) {
  const SceneFile file = parseScene(text, "w");
  std::vector<Diagnostic> warnings;
  static_cast<void>(buildScene(file, {}, &warnings));
  std::vector<std::string> found;
  for (const Diagnostic& warning : warnings) {
    const TextPosition place = positionAt(*file.source.text, warning.where.begin);
    found.push_back(fmt::format("{}:{} {} ({})", place.line, place.column, warning.message, warning.hint));
  }
  return found;
}

TEST(SceneBuilder, WarnsOfARadiusWithoutUse) {
  const auto found = [](const std::string& light) {
    return warningsOf("{ \"luxo\": 1, \"nodes\": [{ \"light\": {\n" + light + "} }] }");
  };
  EXPECT_EQ(
      found(R"("radius": "t")"),
      (std::vector<std::string>{"2:11 a light without a shadow has no use for a radius (write \"shadow\": "
                                "\"exact\", or leave the radius out)"}));
  EXPECT_EQ(found(R"("shadow": "exact", "shadow_samples": 8)"),
            (std::vector<std::string>{"2:38 the shadow of a light without a radius is one sample (give the "
                                      "light a \"radius\", or leave \"shadow_samples\" out)"}));
  EXPECT_TRUE(found(R"("shadow": "exact", "radius": 0.1, "shadow_samples": 8)").empty());
}

TEST(SceneBuilder, WarnsOfWhatIsOfAnotherShadow) {
  const auto found = [](const std::string& light) {
    return warningsOf(
        "{ \"luxo\": 1, \"surfaces\": { \"floor\": { \"type\": \"rectangle\" } }, \"nodes\": "
        "[{ \"name\": \"floor\", \"surface\": \"floor\" }, { \"light\": {\n" +
        light + "} }] }");
  };
  EXPECT_EQ(found(R"("casters": ["floor"])"),
            (std::vector<std::string>{"2:13 a light without a shadow has no casters (write \"shadow\": "
                                      "\"exact\", or leave \"casters\" out)"}));
  EXPECT_EQ(found(R"("shadow": "exact", "shadow_plane": "floor")"),
            (std::vector<std::string>{"2:36 only a planar shadow falls on a plane alone (write \"shadow\": "
                                      "\"planar\", or leave \"shadow_plane\" out)"}));
  EXPECT_EQ(
      found(R"("shadow": "exact", "map": { "bias": 0.1 })"),
      (std::vector<std::string>{"2:27 only a light whose shadow is \"map\" has a map (write \"shadow\": "
                                "\"map\", or leave \"map\" out)"}));
  EXPECT_TRUE(found(R"("shadow": "planar", "shadow_plane": "floor", "casters": ["floor"])").empty());
  EXPECT_TRUE(found(R"("casters": [])").empty());
}

/// Not everything, as without casters.
TEST(SceneBuilder, OfNoCastersThereIsNoShadow) {
  const auto shadowOf = [](const std::string& casters) {
    const SceneFile file = parseScene(
        R"({ "luxo": 1, "nodes": [{ "light": { "shadow": "exact", "casters": )" + casters + " } }] }",
        "casters");
    EXPECT_EQ(parseScene(writeScene(file), "casters"), file);
    return buildScene(file)[NodeId{0}].light->shadow;
  };
  EXPECT_EQ(shadowOf("[]"), Light::Shadow::None);
  EXPECT_EQ(shadowOf("\"all\""), Light::Shadow::Exact);
}

/// One mistake, one message; and no help that would be refused.
TEST(SceneBuilder, TellsMistakesOfShadowsOnce) {
  const auto told = [](const std::string& light) -> std::string {
    try {
      static_cast<void>(
          buildScene(parseScene("{ \"luxo\": 1, \"nodes\": [{ \"light\": {" + light + "} }] }", "light")));
    } catch (const Error& error) {
      return std::string(error.what()) + error.hint();
    }
    return "";
  };
  const std::string pcf = told(R"("shadow": "map", "map": { "pcf": 2 })");
  EXPECT_NE(pcf.find("it must be odd"), std::string::npos) << pcf;
  EXPECT_EQ(pcf.find("odd"), pcf.rfind("odd")) << pcf;
  const std::string light = R"("type": "directional", "shadow": "exact", "radius": )";
  EXPECT_NE(told(light + "30").find("write \"30deg\""), std::string::npos) << told(light + "30");
  EXPECT_EQ(told(light + "1e9").find("deg\""), std::string::npos) << told(light + "1e9");
  const std::string huge = told(light + "1e9");
  EXPECT_NE(huge.find("this is 1000000000 radians; it must be from 0 to pi/2 radians, 90 degrees: a "
                      "directional light's radius is the half-angle of its disc"),
            std::string::npos)
      << huge;
}

TEST(SceneBuilder, FormulasThatAreFlatAreKnownAsThat) {
  const auto normalOf = [](const std::string& position) {
    const Scene scene = buildScene(parseScene(R"({ "luxo": 1, "params": { "k": { "value": 2 } },
      "surfaces": { "s": { "type": "formula", "u": [-1, 1], "v": [-1, 1], "position": [)" +
                                                  position + R"(] } }, "nodes": [ { "surface": "s" } ] })",
                                              "flat"));
    return scene[NodeId{0}].surface.flatNormal();
  };
  EXPECT_EQ(normalOf(R"("u", "0", "-v")"), Vec3(0, 1, 0));
  EXPECT_LT(
      glm::distance(normalOf(R"("u + 3", "2*u - v + 1", "-v")").value_or(Vec3(0)), unit(Vec3(-2, 1, -1))),
      1e-15);
  // Of what covers itself, or turns with a parameter, no more is known than of what is curved.
  for (const char* other : {R"("u*u", "0", "-v")", R"("u", "k*u", "-v")", R"("u", "u*v", "-v")"})
    EXPECT_FALSE(normalOf(other)) << other;
}

TEST(SceneBuilder, WarnsOfWhatIsProbablyNotMeant) {
  const std::vector<std::string> found = warningsOf(R"_({ "luxo": 1, "materials": { "m": {} },
"surfaces": { "hole": { "type": "formula", "u": [-1, 1], "v": [-1, 1], "position": ["u", "v", "sqrt(0.25 - u)"] },
"kink": { "type": "formula", "u": [-1, 1], "position": ["u", "v", "abs(u + v)"] },
"open": { "type": "formula", "u": [0, "tau"], "closed": [false, false], "position": ["cos(u)", "v + abs(u - 1)*(u - tau)*u", "sin(u)"] },
"fine": { "type": "formula", "u": [-1, 1], "position": ["u", "v", "1/2e1 + 1/2*u + u/(2v + 3)"] } },
"nodes": [ { "surface": "hole", "translate": ["1/2t", 0, 0] }, { "surface": "kink" }, { "surface": "open" } ] })_");
  const auto warned = [&](const std::string& text) {
    for (const std::string& warning : found)
      if (warning.starts_with(text)) return true;
    return false;
  };
  EXPECT_TRUE(warned("1:29 no node uses the material 'm'"));
  EXPECT_TRUE(warned("2:15 surface 'hole' has a hole: its formula has no value in u 0.25..1, v -1..1"));
  EXPECT_TRUE(warned("3:1 surface 'kink' has kinks or jumps"));
  EXPECT_TRUE(warned("4:57 the surface is closed in u")) << testing::PrintToString(found);
  EXPECT_TRUE(warned("5:1 no node uses the surface 'fine'"));
  EXPECT_TRUE(warned("6:49 what follows the number is multiplied"));
  EXPECT_EQ(found.size(), 6u) << testing::PrintToString(found);
}

TEST(SceneBuilder, WarnsOfColorsThatAreCut) {
  const std::vector<std::string> found = warningsOf(R"_({ "luxo": 1, "materials": {
"m": { "diffuse": ["1e30*u", "log(v)", "k"] }, "fine": { "diffuse": ["u", "sin(v)/v", 0] } }, "params": { "k": 1 },
"surfaces": { "s": { "type": "formula", "u": [-1, 1], "v": [-1, 1], "position": ["u", "v", 0] } },
"nodes": [ { "surface": "s", "material": "fine" },
{ "surface": "s", "material": "m" } ] })_");
  ASSERT_EQ(found.size(), 1u) << testing::PrintToString(found);
  EXPECT_TRUE(found[0].starts_with(
      "5:31 the colour or opacity of material 'm' has no value, or one above 1e18, in u -1..1, v -1..1"))
      << found[0];
}

TEST(SceneBuilder, WarnsOfSurfacesThatCannotBeSeen) {
  const std::string area = "(let its position depend on u and on v, in two directions)";
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {R"_("u", 0, 0)_", {"2:1 surface 's' has no area " + area}},
      {R"_("u + v", "sin(u + v)", "exp(u + v)")_", {"2:1 surface 's' has no area " + area}},
      {R"_("u", "t*v", 0)_", {"2:1 surface 's' has no area at time 0 " + area}},
      {R"_("u", "1e-9*v", 0)_", {}},
      {R"_("u", "v", "sqrt(-u)")_",  // the curve u = 0 is left
       {"2:1 surface 's' has no points: its formula has no value in u ",
        "(check the formula and its ranges)"}},
      {R"_("u", "v", "sqrt(0.25 - u)")_",
       {"2:1 surface 's' has a hole: its formula has no value in u 0.25..1, v 0..1 (the rest of it is "
        "drawn)"}},
      {R"_("u", "v", "sqrt(0.2 - (u - 0.5)^2 - (v - 0.5)^2)")_",  // a disk, in a square that is larger
       {"2:1 surface 's' ends inside of its rectangle: its formula has no value in parts of u 0..1, v 0..1 "
        "(the rest of it is drawn)"}},
      {R"_("u", "v", "sqrt((u - 0.5)^2 + (v - 0.5)^2 - 0.1)")_",  // outside of a disk of radius 0.3162
       {"2:1 surface 's' has a hole: its formula has no value in parts of u 0.1838..0.8162, v 0.1838..0.8162 "
        "(the rest of it is drawn)"}},
      {R"_("2u - 1", "2v - 1", "sin(u - 0.5)/(u - 0.5) + v")_", {}},  // its limit is known
      {R"_("2u - 1", "2v - 1", "sin(u - 0.5)/(u - 0.5)^2 + v")_",
       {"2:1 surface 's' has a hole: its formula has no value in u 0.5, v 0..1 (the rest of it is drawn)"}},
      {R"_("u", "v", "1/(u - 0.5)")_",
       {"2:1 surface 's' has a hole: its formula has no value in u 0.5, v 0..1 (the rest of it is drawn)"}},
  };
  for (const auto& [position, expected] : cases) {
    const std::vector<std::string> found = warningsOf(
        "{ \"luxo\": 1, \"surfaces\": {\n\"s\": { \"type\": " + std::string("\"formula\", \"position\": [") +
        position + "] } }, \"nodes\": [{ \"surface\": \"s\" }] }");
    EXPECT_EQ(found.size(), expected.empty() ? 0u : 1u) << position << testing::PrintToString(found);
    for (const std::string& part : expected)
      EXPECT_TRUE(!found.empty() && found[0].find(part) != std::string::npos)
          << position << testing::PrintToString(found);
  }
}

TEST(SceneBuilder, WarnsOfColoursThatCountTo255) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"[255, 20, 20]",
       "2:13 the diffuse colour of 'm' has the component 255: colours are 0..1 (write \"#ff1414\")"},
      {"[0, 1.6, 0]", "2:16 the diffuse colour of 'm' has the component 1.6: colours are 0..1 ()"},
      {"[0, 1.5, 0]", ""},
      {"3", "2:12 the diffuse colour of 'm' has the component 3: colours are 0..1 ()"},
  };
  for (const auto& [color, expected] : cases) {
    const std::vector<std::string> found =
        warningsOf("{ \"luxo\": 1, \"materials\": { \"m\": {\n\"diffuse\": " + color +
                   "} }, \"nodes\": [{ \"material\": \"m\" }] }");
    EXPECT_EQ(found, expected.empty() ? std::vector<std::string>{} : std::vector{expected});
  }
}

}  // namespace
}  // namespace luxo
