// SPDX-License-Identifier: Apache-2.0
// luxo inspect: what it says of scenes and of pictures. No device is needed.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cli/program.h"
#include "image/format.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;

class Inspect : public RenderTest {
 protected:
  [[nodiscard]] Json inspected(const std::string& what, const Arguments& extra = {}) const {
    Arguments arguments = {"inspect", what, "--json"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }
};

TEST_F(Inspect, TheLamp) {
  const Json lamp = inspected("luxo-grandpa");
  EXPECT_EQ(lamp["count"]["nodes"], 11);
  EXPECT_EQ(lamp["count"]["shown"], 9);
  EXPECT_EQ(lamp["count"]["surfaces"], 6);
  EXPECT_EQ(lamp["count"]["lights"], 2);
  EXPECT_EQ(lamp["time"], 21.0);
  EXPECT_GT(lamp["picture"]["triangles"], 100);
  EXPECT_LE(lamp["picture"]["bound_px"], 0.5);
  ASSERT_EQ(lamp["nodes"].size(), 11u);
  EXPECT_EQ(lamp["nodes"][0]["name"], "floor");
  EXPECT_EQ(lamp["nodes"][0]["bounds"]["max"][0], 30.0);
  EXPECT_EQ(lamp["nodes"][8]["name"], "shade");
  EXPECT_EQ(lamp["nodes"][8]["depth"], 4);
  EXPECT_EQ(lamp["cameras"][0]["name"], "orbit");
  EXPECT_NEAR(lamp["cameras"][0]["fov_y_degrees"], 50, 1e-12);
}

TEST_F(Inspect, ParametersSurfacesAndWarnings) {
  writeText(folder / "s.luxo.json", R"({ "luxo": 1,
    "params": { "k": { "value": 3, "range": [1, 12], "step": 1, "label": "lobes" }, "a": "k+t" },
    "surfaces": { "band": { "type": "mobius" },
                  "odd": { "type": "formula", "u": [-1, 1], "v": [0, 1], "position": ["u", "1/u", "v"] } },
    "nodes": [ { "surface": "band" }, { "surface": "odd" } ] })");
  const Json scene = inspected("s.luxo.json", {"-P", "k=5", "--time", "2"});
  const Json k = scene["parameters"][0], a = scene["parameters"][1];
  EXPECT_EQ(k["value"], 5.0);
  EXPECT_EQ(k["range"], (Json{1.0, 12.0}));
  EXPECT_EQ(k["label"], "lobes");
  EXPECT_EQ(k["moves"], false);
  EXPECT_EQ(a["value"], 7.0);
  EXPECT_EQ(a["moves"], true);
  EXPECT_EQ(scene["surfaces"][0]["orientable"], false);
  EXPECT_EQ(scene["surfaces"][0]["euler_characteristic"], 0);
  const std::string warnings = scene["warnings"].dump();
  EXPECT_TRUE(contains(warnings, "one side")) << warnings;
  EXPECT_TRUE(contains(warnings, "hole")) << warnings;

  const Outcome text = run(folder, {"inspect", "s.luxo.json"});
  for (const char* said : {"lobes", "one-sided", "warnings", "range (1, 12)"})
    EXPECT_TRUE(contains(text.out, said)) << text.out << "\nlacks: " << said;
}

TEST_F(Inspect, Pictures) {
  saveImage(Image(3, 2, 3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, -1, 16, 17}), folder / "a.pfm");
  const Json image = inspected("a.pfm", {"--pixel", "1,1"});
  EXPECT_EQ(image["size"], (Json{3, 2}));
  EXPECT_EQ(image["pixel"]["value"], (Json{12.0, 13.0, 14.0}));
  EXPECT_EQ(image["channels"][0]["min"], -1.0);
  EXPECT_EQ(image["channels"][0]["max"], 12.0);
  EXPECT_EQ(image["channels"][2]["mean"], 57 / 6.0);  // 2 + 5 + 8 + 11 + 14 + 17
  expectFailure(run(folder, {"inspect", "a.pfm", "--pixel", "3,0"}), 2, "3 x 2 pixels", "312,88");
  expectFailure(run(folder, {"inspect", "a.pfm", "--pixel", "1;0"}), 2, "not a pixel", "312,88");
}

/// A ball of radius 2 under a lamp, and a mirrored ring out of the picture.
const char* const kBallAndRing = R"scene({ "luxo": 1,
  "render": { "size": [64, 48], "ambient": 0.25, "background": [0.1, 0.2, 0.3], "samples": 4 },
  "materials": { "red": { "diffuse": [0.5, 0.1, 0], "specular": 0 } },
  "surfaces": { "ball": { "type": "sphere", "radius": 2 }, "ring": { "type": "torus", "major": 2, "minor": 0.5 } },
  "nodes": [ { "name": "ball", "translate": [0, 0, 1], "surface": "ball", "material": "red" },
             { "name": "ring", "translate": [30, 0, 0], "scale": [-1, 1, 1], "surface": "ring" },
             { "name": "lamp", "translate": [0, 0, 7], "light": { "intensity": 8, "attenuation": "inverse-square" } } ],
  "camera": { "eye": [0, 0, 11], "fov_y": "40deg" }
})scene";

void expectVector(const Json& json, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(json.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(json[i].get<double>(), expected[i], tolerance) << json << ", " << i;
}

TEST_F(Inspect, APixelOfABall) {
  writeText(folder / "s.luxo.json", kBallAndRing);
  const Json told = inspected("s.luxo.json", {"--pixel", "31,23", "--size", "63x47"});  // the middle one
  expectVector(told["ray"]["direction"], {0, 0, -1}, 1e-14);
  ASSERT_EQ(told["points"].size(), 2u);
  const Json& point = told["points"][0];
  EXPECT_EQ(point["node"], "ball");
  EXPECT_EQ(point["number"], 1);
  EXPECT_EQ(point["material"], "red");
  EXPECT_EQ(point["seen"], true);
  EXPECT_EQ(point["certified"], true);
  expectVector(point["position"], {0, 0, 3}, 1e-12);
  expectVector(point["normal"], {0, 0, 1}, 1e-12);
  expectVector(point["normal_lit"], {0, 0, 1}, 1e-12);
  EXPECT_NEAR(point["depth"].get<double>(), 8, 1e-12);
  EXPECT_NEAR(point["curvature"]["gaussian"].get<double>(), 0.25, 1e-12);
  EXPECT_NEAR(point["curvature"]["mean"].get<double>(), 0.5, 1e-12);
  EXPECT_LT(point["residual_px"].get<double>(), 1e-9);
  ASSERT_EQ(point["lights"].size(), 1u);
  EXPECT_EQ(point["lights"][0]["node"], "lamp");
  EXPECT_EQ(point["lights"][0]["state"], "seen");
  expectVector(point["lights"][0]["share"], {0.25, 0.05, 0}, 1e-12);  // 8 / 4^2 of the colour
  expectVector(point["ambient"], {0.125, 0.025, 0}, 1e-12);
  expectVector(told["color"]["linear"], {0.375, 0.075, 0}, 1e-12);
  EXPECT_EQ(told["color"]["srgb8"], (Json{165, 77, 0}));
  EXPECT_EQ(told["points"][1]["seen"], false);
  EXPECT_FALSE(told["points"][1].contains("lights"));
  expectVector(told["vertex"]["model"], {0, 0, 2}, 1e-12);
  expectVector(told["vertex"]["screen"], {31.5, 23.5}, 1e-9);
  EXPECT_TRUE(contains(told["pipeline"]["faces"], "counter-clockwise"));
  EXPECT_TRUE(contains(told["pipeline"]["output"], "the mean of 4 samples"));

  const Outcome text = run(folder, {"inspect", "s.luxo.json", "--pixel", "31,23", "--size", "63x47"});
  for (const char* said :
       {"ball (sphere, red), outer side, 8 m deep", "K 0.25, H 0.5", "lamp, seen, 4 m away",
        "sRGB [165,77,0]", "pipeline", "inner side, 12 m deep, behind"})
    EXPECT_TRUE(contains(text.out, said)) << text.out << "\nlacks: " << said;
}

/// A spot of which half of the cone is between 30 and 60 degrees, seen from where it is: of a floor 2 m
/// below.
TEST_F(Inspect, ASpotAndAPixelsShareOfIt) {
  writeText(folder / "s.luxo.json", R"({ "luxo": 1, "render": { "ambient": 0 },
    "materials": { "m": { "diffuse": 0.5, "specular": 0 } },
    "surfaces": { "floor": { "type": "rectangle", "size": [40, 40] } },
    "camera": { "eye": [0, 2, 0], "look_at": [0, 0, 0], "up": [0, 0, -1], "fov_y": "90deg" },
    "nodes": [ { "name": "floor", "surface": "floor", "material": "m" },
               { "name": "stage", "translate": [0, 2, 0], "rotate": { "axis": [1, 0, 0], "angle": "-90deg" },
                 "light": { "spot": { "inner": "30deg", "outer": "45deg" } } } ] })");
  const auto lightAt = [&](const char* pixel) {
    return inspected("s.luxo.json", {"--pixel", pixel, "--size", "101x101"})["points"][0]["lights"][0];
  };
  const Json axis = lightAt("50,50");  // the middle one
  EXPECT_EQ(axis["type"], "spot");
  EXPECT_EQ(axis["state"], "seen");
  EXPECT_EQ(axis["cone"], 1);
  expectVector(axis["share"], {0.5, 0.5, 0.5}, 1e-12);
  // 40 of the 50.5 pixels from the middle to the border, which is at 45 degrees.
  const double cosine = std::cos(std::atan(40 / 50.5));
  const double part = (cosine - std::sqrt(0.5)) / (std::sqrt(0.75) - std::sqrt(0.5));
  const Json middle = lightAt("90,50");
  EXPECT_NEAR(middle["cone"].get<double>(), part * part, 1e-12);
  EXPECT_NEAR(middle["share"][0].get<double>(), 0.5 * part * part * cosine, 1e-12);
  const Json outside = lightAt("99,99");
  EXPECT_EQ(outside["state"], "outside its cone");
  expectVector(outside["share"], {0, 0, 0}, 0);

  const Json light = inspected("s.luxo.json", {})["lights"][0];
  EXPECT_EQ(light["type"], "spot");
  expectVector(light["cone"]["axis"], {0, -1, 0}, 1e-15);
  EXPECT_NEAR(light["cone"]["inner_degrees"].get<double>(), 30, 1e-12);
  EXPECT_NEAR(light["cone"]["outer_degrees"].get<double>(), 45, 1e-12);
  const Outcome text = run(folder, {"inspect", "s.luxo.json"});
  EXPECT_TRUE(contains(text.out, "spot, at (0, 2, 0)")) << text.out;
  EXPECT_TRUE(contains(text.out, "from 30 to 45 degrees")) << text.out;
  const Outcome pixel = run(folder, {"inspect", "s.luxo.json", "--pixel", "99,99", "--size", "101x101"});
  EXPECT_TRUE(contains(pixel.out, "stage, outside its cone")) << pixel.out;
}

/// Of a shader the colour is the picture's, and of the light what arrives there: what becomes of that the
/// shader alone knows.
TEST_F(Inspect, APixelOfAShader) {
  requireDevice();
  writeText(folder / "red.frag", "vec4 material(Point p) { return vec4(1.0, 0.25, 0.0, 1.0); }\n");
  const Json told = inspected("red.frag", {"--pixel", "15,16", "--size", "48x32"});
  expectVector(told["color"]["linear"], {1, 0.25, 0}, 1e-6);
  EXPECT_EQ(told["color"]["srgb8"], (Json{255, 137, 0}));
  EXPECT_TRUE(contains(told["points"][0]["shader"], "red.frag"));
  for (const char* unknown : {"reflected", "diffuse", "ambient"})
    EXPECT_FALSE(told["points"][0].contains(unknown)) << unknown;
  // A light of (4, 2, 1) at 2 m, which fades by the square, beside one behind the ball and one behind a
  // plate.
  writeText(folder / "s.luxo.json", R"({ "luxo": 1, "materials": { "m": { "shader": "red.frag" } },
  "surfaces": { "ball": { "type": "sphere" }, "plate": { "type": "rectangle", "size": [1, 1] } },
  "nodes": [ { "name": "ball", "surface": "ball", "material": "m" },
    { "name": "near", "translate": [0, 0, 3], "light": { "type": "point", "color": [1, 0.5, 0.25], "intensity": 4,
      "attenuation": "inverse-square" } },
    { "name": "behind", "translate": [0, 0, -3], "light": { "type": "point", "intensity": 4 } },
    { "name": "above", "translate": [0, 9, 1.5], "light": { "type": "point", "intensity": 4, "shadow": "exact" } },
    { "translate": [0, 4, 1.2], "surface": "plate", "material": "m" } ],
  "camera": { "eye": [0, 0, 5], "look_at": [0, 0, 0] } })");
  const Json lit = inspected("s.luxo.json", {"--pixel", "31,23", "--size", "63x47"});
  const Json& lights = lit["points"][0]["lights"];
  ASSERT_EQ(lights.size(), 3u);
  expectVector(lights[0]["radiance"], {1, 0.5, 0.25}, 1e-12);
  expectVector(lights[0]["arriving"], {1, 0.5, 0.25}, 1e-12);
  EXPECT_FALSE(lights[0].contains("share"));
  expectVector(lights[1]["radiance"], {4, 4, 4}, 1e-12);
  expectVector(lights[1]["arriving"], {4, 4, 4}, 1e-12);  // shaders are told of lights behind, too
  expectVector(lights[2]["radiance"], {4, 4, 4}, 1e-12);
  expectVector(lights[2]["arriving"], {0, 0, 0}, 0);
  EXPECT_EQ(lights[2]["state"], "in shadow");
  const Outcome text = run(folder, {"inspect", "s.luxo.json", "--pixel", "31,23", "--size", "63x47"});
  for (const char* said :
       {": (1, 0.5, 0.25) arrives of (1, 0.5, 0.25)", "as the shader decides, of what arrives"})
    EXPECT_TRUE(contains(text.out, said)) << text.out << "\nlacks: " << said;
  writeText(folder / "red.frag", "vec4 material(Point p) { return vec4(nothing); }\n");
  EXPECT_EQ(run(folder, {"inspect", "red.frag", "--pixel", "15,16", "--size", "48x32"}).code, 3);
  writeText(folder / "red.frag",
            "uniform float k = 0.5; // @slider 0\nvec4 material(Point p) { return vec4(k); }\n");
  EXPECT_EQ(run(folder, {"inspect", "red.frag"}).code, 3);
}

TEST_F(Inspect, StagesThatNoMaterialHas) {
  writeText(folder / "a.geom",
            "#version 460\nlayout(points) in;\nlayout(triangle_strip, max_vertices = 3) out;\n"
            "layout(std430, row_major, binding = 1) buffer B { mat3x2 m; float items[]; };\n"
            "void main() { gl_Position = vec4(items[0], m[1], 1.0); EmitVertex(); }\n");
  const Json told = inspected("a.geom", {});
  EXPECT_EQ(told["stage"], "geometry");
  EXPECT_EQ(told["layout"], (Json{"points", "triangle_strip", "max_vertices = 3", "invocations = 1"}));
  EXPECT_EQ(told["blocks"][0]["members"][0]["row_major"], true);
  EXPECT_EQ(told["blocks"][0]["members"][1]["array"], Json::array({0}));
  const Outcome text = run(folder, {"inspect", "a.geom"});
  for (const char* said :
       {"a.geom: a geometry shader", "layout points, triangle_strip, max_vertices = 3",
        "32 bytes and what its last member has", "row major", "items[]", "as long as the buffer is"})
    EXPECT_TRUE(contains(text.out, said)) << text.out << "\nlacks: " << said;
  writeText(folder / "a.tesc",
            "#version 460\nlayout(vertices = 4) out;\nvoid main() { gl_TessLevelOuter[0] = 1.0; }\n");
  EXPECT_TRUE(contains(run(folder, {"inspect", "a.tesc"}).out, "a tessellation control shader"));
  writeText(folder / "a.tese", "#version 460\nlayout(quads) in;\nvoid main() { gl_Position = vec4(1.0); }\n");
  EXPECT_TRUE(contains(run(folder, {"inspect", "a.tese"}).out, "a tessellation evaluation shader"));
  writeText(folder / "b.tese", "#version 460\nlayout(quads) in;\nvoid main() { gl_Position = none; }\n");
  expectFailure(run(folder, {"inspect", "b.tese"}), 3, "b.tese:3:29: 'none' : undeclared identifier");
  expectFailure(run(folder, {"render", "a.geom", "-o", "a.png"}), 2,
                "is a shader that draws nothing by itself", "luxo inspect tells");
  // SPIR-V of a stage that is not read: a kernel with nothing in it.
  const std::uint32_t kernel[] = {0x07230203, 0x00010000, 0,          6,              // header
                                  0x00020011, 4,          0x00020011, 6,              // Addresses, Kernel
                                  0x0003000e, 1,          2,                          // physical32, OpenCL
                                  0x0004000f, 6,          3,          0x00000061,     // entry point "a"
                                  0x00020013, 1,          0x00030021, 2,          1,  // void, void()
                                  0x00050036, 1,          3,          0,          2,
                                  0x000200f8, 4,          0x000100fd, 0x00010038};
  writeText(folder / "k.spv", std::string(reinterpret_cast<const char*>(kernel), sizeof kernel));
  EXPECT_EQ(run(folder, {"inspect", "k.spv"}).code, 3);
}

TEST_F(Inspect, APixelOfTheBackground) {
  writeText(folder / "s.luxo.json", kBallAndRing);
  const Json told = inspected("s.luxo.json", {"--pixel", "0,0"});
  EXPECT_EQ(told["points"], Json::array());
  expectVector(told["color"]["linear"], {0.1, 0.2, 0.3}, 0);
  EXPECT_FALSE(told.contains("vertex"));
  EXPECT_TRUE(contains(run(folder, {"inspect", "s.luxo.json", "--pixel", "0,0"}).out, "the background"));
}

// What is told is what is drawn.
TEST_F(Inspect, PixelsOfTheLampAreThoseOfItsPicture) {
  EXPECT_EQ(
      run(folder, {"render", "luxo-grandpa", "--engine", "reference", "--size", "67x45", "-o", "a.pfm"}).code,
      0);
  const Image picture = loadImage(folder / "a.pfm");
  for (const auto& [x, y] : {std::pair{33, 22}, {40, 18}, {10, 30}, {36, 33}}) {
    const Json told = inspected("luxo-grandpa", {"--size", "67x45", "--pixel", fmt::format("{},{}", x, y)});
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(float(told["color"]["linear"][std::size_t(c)].get<double>()),
                picture.pixel(x, y)[std::size_t(c)]);
  }
}

// By hand: translated, then looked at from 11 m, with the seeds' formulas in columns.
TEST_F(Inspect, AVertexOnItsWayToTheScreen) {
  writeText(folder / "s.luxo.json", kBallAndRing);
  const Json vertex = inspected("s.luxo.json", {"--vertex", "ball:0,0.5"})["vertex"];
  expectVector(vertex["model"], {2, 0, 0}, 1e-12);
  expectVector(vertex["world"], {2, 0, 1}, 1e-12);
  expectVector(vertex["world_from_model"][2], {0, 0, 1, 1}, 0);
  expectVector(vertex["camera"], {2, 0, -10}, 1e-12);
  expectVector(vertex["camera_from_world"][2], {0, 0, 1, -11}, 1e-12);
  const double y = 1 / std::tan(20 * 3.14159265358979323846 / 180), x = y * 48 / 64;
  expectVector(vertex["clip"], {2 * x, 0, 0.1, 10}, 1e-12);
  expectVector(vertex["clip_from_camera"][0], {x, 0, 0, 0}, 1e-12);
  expectVector(vertex["clip_from_camera"][2], {0, 0, 0, 0.1}, 1e-12);
  expectVector(vertex["clip_from_camera"][3], {0, 0, -1, 0}, 1e-12);
  expectVector(vertex["ndc"], {0.2 * x, 0, 0.01}, 1e-12);
  expectVector(vertex["screen"], {32 + 32 * 0.2 * x, 24}, 1e-9);
  expectVector(vertex["normal_world"], {1, 0, 0}, 1e-12);
  EXPECT_EQ(vertex["in_view"], true);

  // Mirrored: the normal keeps pointing out of the ring. By its number, too.
  const Json ring = inspected("s.luxo.json", {"--vertex", "ring:0,0"});
  expectVector(ring["vertex"]["world"], {27.5, 0, 0}, 1e-12);
  expectVector(ring["vertex"]["normal_world"], {-1, 0, 0}, 1e-12);
  EXPECT_EQ(ring["vertex"]["in_view"], false);
  EXPECT_EQ(inspected("s.luxo.json", {"--vertex", "2:0,0"})["vertex"], ring["vertex"]);
  EXPECT_TRUE(contains(ring["pipeline"]["drawn"], "no: "));
  EXPECT_TRUE(contains(run(folder, {"inspect", "s.luxo.json", "--vertex", "ball:0,0.5"}).out, "screen"));

  writeText(folder / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  const Json model = inspected("m.obj", {"--vertex", "1:2"});
  EXPECT_EQ(model["index"], 2);
  EXPECT_TRUE(contains(model["pipeline"]["geometry"], "triangles, as they are"));
}

TEST_F(Inspect, RefusalsOfPixelsAndVertices) {
  writeText(folder / "s.luxo.json", kBallAndRing);
  const auto refused = [&](const Arguments& extra, const std::string& said, const std::string& help = "") {
    Arguments arguments = {"inspect", "s.luxo.json"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    expectFailure(run(folder, arguments), 2, said, help);
  };
  refused({"--pixel", "64,0"}, "64 x 48 pixels", "312,88");
  refused({"--pixel", "-1,0"}, "64 x 48 pixels");
  refused({"--pixel", "1.5,0"}, "not a pixel");
  refused({"--vertex", "ball"}, "not NODE:U,V", "ball:0.5,0.25");
  refused({"--vertex", "ball:0.5"}, "not NODE:U,V");
  refused({"--vertex", "ball:a,b"}, "not NODE:U,V");
  refused({"--vertex", "bal:0,0"}, "no surface of a node 'bal'", "did you mean 'ball'?");
  refused({"--vertex", "lamp:0,0"}, "no surface of a node 'lamp'");
  refused({"--vertex", "ball:0,1.5"}, "no point of", "v from 0 to 1");
  refused({"--pixel", "0,0", "--vertex", "ball:0,0"}, "exclude each other");
  writeText(folder / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  expectFailure(run(folder, {"inspect", "m.obj", "--vertex", "1:3"}), 2, "no vertex of", "3, from 0");
  saveImage(Image(2, 2, 3), folder / "a.png");
  expectFailure(run(folder, {"inspect", "a.png", "--vertex", "1:0,0"}), 2, "a picture has no vertices");
}

TEST_F(Inspect, Refusals) {
  expectFailure(run(folder, {"inspect"}), 2, "nothing is named", "luxo-grandpa");
  expectFailure(run(folder, {"inspect", "a.frag"}), 3, "cannot read the shader 'a.frag'", "");
  expectFailure(run(folder, {"inspect", "missing.png"}), 3, "missing.png", "");
  EXPECT_EQ(run(folder, {"inspect", "missing.luxo.json"}).code, 3);
}

}  // namespace
}  // namespace luxo::test
