// SPDX-License-Identifier: Apache-2.0
// A shader file where a scene is taken: its uniforms by name, time, mainImage, presets, what is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/format.h"
#include "open_scene.h"
#include "scene/snapshot.h"
#include "shader_scene.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr int kWide = 48, kHigh = 32;
// Where the ball of luxo's own scene covers the whole pixel: its centre is at x = -1.35, y = 1, 7.7 m away.
constexpr int kBallX = 15, kBallY = 16;

class ShaderFile : public DeviceRenderTest {
 protected:
  [[nodiscard]] Outcome render(const std::string& shader, const Arguments& more = {}) const {
    writeText(folder / "a.frag", shader);
    Arguments arguments = {"render", "a.frag", "-o", "a.png", "--size", "48x32", "--validate"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(folder, arguments);
  }
  [[nodiscard]] Image picture() const { return loadImage(folder / "a.png"); }
  /// The 8-bit code of a channel there.
  [[nodiscard]] static int code(const Image& image, int x, int y, int channel) {
    const double linear = image.pixel(x, y)[static_cast<std::size_t>(channel)];
    const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<int>(std::lround(255 * encoded));
  }
  void expectBall(int red, int green, int blue) const {
    const Image image = picture();
    EXPECT_EQ(code(image, kBallX, kBallY, 0), red);
    EXPECT_EQ(code(image, kBallX, kBallY, 1), green);
    EXPECT_EQ(code(image, kBallX, kBallY, 2), blue);
  }
};

const std::string kTinted =
    "uniform vec3 tint = vec3(1.0, 0.5, 0.0);  // @color\n"
    "uniform float gain = 1.0;                 // @slider 0 2\n"
    "uniform int mode = 0;                     // @select plain|swapped\n"
    "uniform float time, idle;\n"
    "vec4 material(Point p) {\n"
    "  vec3 c = gain * tint + vec3(0.0, 0.0, time);\n"
    "  return vec4(mode == 1 ? c.bgr : c, 1.0);\n}\n";

// 188 is sRGB's code of 0.5: 1.055 * 0.5^(1 / 2.4) - 0.055 = 0.735357; 137 that of 0.25.
TEST_F(ShaderFile, IsTheMaterialOfABallAndARing) {
  ASSERT_EQ(render(kTinted).code, 0);
  expectBall(255, 188, 0);
  ASSERT_EQ(render(kTinted, {"--time", "0.25"}).code, 0);
  expectBall(255, 188, 137);
  ASSERT_EQ(render(kTinted, {"-P", "gain=0.5"}).code, 0);
  expectBall(188, 137, 0);
  ASSERT_EQ(render(kTinted, {"-P", "tint=#00ff00", "-P", "time=1"}).code, 0);
  expectBall(0, 255, 255);
  ASSERT_EQ(render(kTinted, {"-P", "mode=swapped"}).code, 0);
  expectBall(0, 188, 255);
  ASSERT_EQ(render(kTinted, {"-P", "tint=t/4,0,t/2", "--time", "1", "-P", "time=0"}).code, 0);
  expectBall(137, 0, 188);
}

TEST_F(ShaderFile, ValuesHaveNamesTypesAndRanges) {
  expectFailure(render(kTinted, {"-P", "gian=1"}), 2, "-P: the shader 'a.frag' has no uniform 'gian'",
                "did you mean 'gain'?");
  expectFailure(render(kTinted, {"-P", "tint=1,2"}), 2, "'tint=1,2': it is of type vec3: 3 numbers, not 2");
  expectFailure(render(kTinted, {"-P", "gain=3"}), 2, "outside its range from 0 to 2");
  expectFailure(render(kTinted, {"-P", "mode=other"}), 2, "there is no such choice", "plain, swapped");
  expectFailure(render(kTinted, {"-P", "mode=0.5"}), 2, "there is no such choice");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
  const Outcome outcome = render(kTinted, {"-P", "idle=1"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("nothing in the shader uses the uniform 'idle'"));
}

TEST_F(ShaderFile, NamesThatFormulasHaveAreNoHindrance) {
  ASSERT_EQ(render("uniform float t = 0.5, e = 0.25, sin, u;\n"
                   "vec4 material(Point p) { return vec4(t, e, u, 1.0 + 0.0 * sin); }\n",
                   {"-P", "u=1"})
                .code,
            0);
  expectBall(188, 137, 255);
}

TEST_F(ShaderFile, WhatHasNoWidgetIsGivenAllItsNumbers) {
  const std::string shader =
      "uniform mat2 m = mat2(1.0);\nuniform float a[2] = float[2](0.5, 0.25);\n"
      "vec4 material(Point p) { return vec4(m[1][0], a[0], a[1], 1); }\n";
  ASSERT_EQ(render(shader).code, 0);
  expectBall(0, 188, 137);
  ASSERT_EQ(render(shader, {"-P", "m=0,0.5,0,0", "-P", "a=0,1"}).code, 0);
  expectBall(188, 0, 255);  // rows: the second number is of the second column's first row
}

TEST_F(ShaderFile, ErrorsAreAtTheirOwnPlace) {
  const auto expectError = [&](const std::string& shader, const std::string& said) {
    const Outcome outcome = render(shader);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(said));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
  };
  expectError("uniform float a; // @slider a b\nvec4 material(Point p) { return vec4(a); }\n",
              "error: a.frag:1:29: 'a' is no number\n  1 | uniform float a; // @slider a b\n");
  expectError("vec4 material(Point p) { return vec4(p.norml, 1); }\n", "error: a.frag:1:40: 'norml'");
  expectError("float other() { return 1.0; }\n", "there is no function 'vec4 material(Point p)'");
  expectError("#include \"a.frag\"\nvec4 material(Point p) { return vec4(1); }\n", "a.frag:1:");
  expectError("", "a.frag");
  EXPECT_EQ(run(folder, {"render", "none.frag", "-o", "a.png"}).code, 3);
  EXPECT_EQ(run(folder, {"render", "luxo-grandpa", "-o", "a.png", "--shadertoy"}).code, 2);
}

TEST_F(ShaderFile, MainImageFillsThePicture) {
  ASSERT_EQ(render("void mainImage(out vec4 fragColor, in vec2 fragCoord) {\n"
                   "  fragColor = vec4(fragCoord / iResolution.xy, iTime, 0.0);\n}\n",
                   {"--time", "0.5"})
                .code,
            0);
  const Image image = picture();
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x) {
      ASSERT_NEAR(code(image, x, y, 0), 255 * (x + 0.5) / kWide, 0.51) << x << ',' << y;
      ASSERT_NEAR(code(image, x, y, 1), 255 * (kHigh - y - 0.5) / kHigh, 0.51) << x << ',' << y;
      ASSERT_NEAR(code(image, x, y, 2), 127.5, 0.51);
    }
}

TEST_F(ShaderFile, MainImageHasExactPixelsAndWhatElseItIsGiven) {
  ASSERT_EQ(
      render("uniform float red = 0.25; // @slider 0 1\n"
             "void mainImage(out vec4 c, in vec2 at) {\n"
             "  bool exact = fract(at) == vec2(0.5) && iResolution == vec3(48, 32, 1) && iFrame == 90;\n"
             "  c = vec4(red, exact ? 1.0 : 0.0, iMouse.x, 1.0);\n}\n",
             {"--time", "1.5", "-P", "red=0.6", "-P", "iMouse=0.2,0,0,0"})
          .code,
      0);
  const Image image = picture();
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x) {
      ASSERT_EQ(code(image, x, y, 0), 153);
      ASSERT_EQ(code(image, x, y, 1), 255) << x << ',' << y;
      ASSERT_EQ(code(image, x, y, 2), 51);
    }
}

TEST_F(ShaderFile, MainImageIsChosenBesideAMaterial) {
  const std::string both =
      "void mainImage(out vec4 c, in vec2 at) { c = vec4(0.2, 0.4, 0.6, 1.0); }\n"
      "vec4 material(Point p) { return vec4(1.0, 0.0, 0.0, 1.0); }\n";
  ASSERT_EQ(render(both).code, 0);
  expectBall(255, 0, 0);
  ASSERT_EQ(render(both, {"--shadertoy"}).code, 0);
  expectBall(51, 102, 153);
}

/// The material that is beside it has what it is given, too.
TEST_F(ShaderFile, AMaterialBesideMainImageKnowsItsNumbers) {
  const std::string both =
      "void mainImage(out vec4 c, in vec2 at) { c = vec4(at / iResolution.xy, iTime, 1.0); }\n"
      "vec4 material(Point p) { vec4 c; mainImage(c, 0.5 * iResolution.xy); return c; }\n";
  ASSERT_EQ(render(both, {"--time", "0.25"}).code, 0);
  expectBall(188, 188, 137);
  EXPECT_EQ(run(folder, {"inspect", "a.frag"}).code, 0);
}

/// What a material is given has names that a picture may have for something else.
TEST_F(ShaderFile, MainImageMayHaveNamesOfLuxosOwn) {
  const std::string own =
      "struct Light { vec3 color; float k; };\nstruct Hit { float distance; };\n"
      "struct Point { vec2 at; };\nconst float lightCount = 0.2;\n"
      "vec3 ambientLight() { return vec3(lightCount, 0.0, 0.0); }\n"
      "Hit trace(vec3 direction) { return Hit(direction.y); }\n"
      "Light light(int i) { Light l; l.color = vec3(0.0, trace(vec3(0.4)).distance, 0.0); return l; }\n"
      "vec4 material(vec3 p) { return vec4(0.0, 0.0, p.z, 1.0); }\n"
      "void mainImage(out vec4 c, in vec2 at) {\n"
      "  Point p = Point(at);\n"
      "  c = vec4(ambientLight() + light(3).color, 1.0) + material(vec3(0.6));\n}\n";
  const Outcome outcome = render(own);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expectBall(51, 102, 153);
  EXPECT_EQ(run(folder, {"inspect", "a.frag"}).code, 0);
  const Outcome wrong = render(
      "float light(float x) { return x; }\nvoid mainImage(out vec4 c, in vec2 at) {\n"
      "  c = vec4(light(at, 1.0, at));\n}\n");
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, StartsWith("error: a.frag:3:12: 'light' : no matching overloaded function found\n"));
}

/// What a picture only uses keeps its meaning.
TEST_F(ShaderFile, MainImageMayUseWhatMaterialsAreGiven) {
  for (const std::string& text :
       {std::string(
            "vec3 f(in Light l) { return l.direction; }\nvoid mainImage(out vec4 c, in vec2 at) { c = "
            "vec4(f(light(0)).x * 0.0 + 0.2); }\n"),
        std::string("#define LAMP light\nvoid mainImage(out vec4 c, in vec2 at) { c = "
                    "vec4(LAMP(0).direction.x * 0.0 + 0.2); }\n")}) {
    const Outcome outcome = render(text);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    expectBall(51, 51, 51);
  }
}

TEST_F(ShaderFile, TruthIsGivenByName) {
  const std::string shader =
      "uniform bool on = true;\nuniform bvec3 which = bvec3(false);\n"
      "vec4 material(Point p) { return vec4(on ? vec3(which) : vec3(0.5), 1.0); }\n";
  ASSERT_EQ(render(shader).code, 0);
  expectBall(0, 0, 0);
  ASSERT_EQ(render(shader, {"-P", "which=true,true,false"}).code, 0);
  expectBall(255, 255, 0);
  ASSERT_EQ(render(shader, {"-P", "on=false"}).code, 0);
  expectBall(188, 188, 188);
  expectFailure(render(shader, {"-P", "on=2"}), 2, "it is of type bool", "give true or false");
  const Json told = Json::parse(run(folder, {"inspect", "a.frag", "--json"}).out);
  EXPECT_EQ(told["uniforms"][0]["type"], "bool");
  EXPECT_EQ(told["uniforms"][1]["type"], "bvec3");
  ASSERT_EQ(
      render(
          "uniform bool on = true;\nvoid mainImage(out vec4 c, in vec2 at) { c = vec4(on ? 0.2 : 0.4); }\n",
          {"-P", "on=false"})
          .code,
      0);
  expectBall(102, 102, 102);
}

/// Numbers that parameters are not: a uniform keeps them, and whoever gives them is told.
TEST_F(ShaderFile, NumbersBeyondThoseOfScenes) {
  const std::string shader =
      "uniform float x = 1e30, y = 1;\nuniform uint n = 4000000000u;\n"
      "vec4 material(Point p) { return vec4(x == 1e30 ? 1 : 0, n == 4000000000u ? 1 : 0, y, 1); }\n";
  ASSERT_EQ(render(shader).code, 0);
  expectBall(255, 255, 255);
  expectFailure(render(shader, {"-P", "y=1e30"}), 2, "'y=1e30': numbers are from -1e+18 to 1e+18", "");
  expectFailure(render("uniform sampler2D wood;\nvec4 material(Point p) { return texture(wood, p.uv); }\n",
                       {"-P", "wood=gone.png", "-q"}),
                3, "the texture of the uniform 'wood' of '", "");
  writeText(folder / "a.frag.presets.json", R"({ "presets": { "far": { "gain": 9 } } })");
  expectFailure(render(kTinted, {"--preset", "far"}), 3,
                "the preset's 'gain' is 9, outside its range from 0 to 2",
                "the comment at the uniform says the range");
}

TEST_F(ShaderFile, WhatMainImageDoesNotGetIsRefused) {
  const auto expectError = [&](const std::string& shader, const std::string& said,
                               const Arguments& more = {}) {
    const Outcome outcome = render(shader, more);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(said));
  };
  expectError("// iChannel1\nvoid mainImage(out vec4 c, in vec2 at) { c = texture(iChannel0, at); }\n",
              "a.frag:2:54: there is no 'iChannel0'");
  expectError("void mainImage(out vec4 c, in vec2 at) { c = vec4(nothing); }\n", "a.frag:1:51: 'nothing'");
  expectError("vec4 material(Point p) { return vec4(1); }\n", "there is no function 'void mainImage(",
              {"--shadertoy"});
  expectError("void mainImage(out vec4 c, in vec2 at) { while (true) c = vec4(1); }\n", "32768");
  ASSERT_EQ(render("void mainImage(out vec4 c, in vec2 at) { c = vec4(sqrt(at.x - 1e9)); }\n").code, 0);
  const Image image = picture();
  EXPECT_EQ(code(image, 7, 7, 0), 255);
  EXPECT_EQ(code(image, 7, 7, 1), 0) << "what is no number is magenta";
  EXPECT_EQ(code(image, 7, 7, 2), 255);
}

TEST_F(ShaderFile, PresetsAreBesideIt) {
  writeText(folder / "a.frag.presets.json",
            R"({ "presets": { "blue": { "tint": [0, 0, 1], "mode": "plain", "old": 1 } } })");
  const Outcome outcome = render(kTinted, {"--preset", "blue"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("the preset has a value for 'old'"));
  expectBall(0, 0, 255);
  ASSERT_EQ(render(kTinted, {"--preset", "blue", "-P", "tint=1,0,0"}).code, 0);
  expectBall(255, 0, 0);
  expectFailure(render(kTinted, {"--preset", "bleu"}), 2, "'a.frag' has no preset 'bleu'",
                "did you mean 'blue'?");
  writeText(folder / "a.frag.presets.json", "{ \"presets\": { \"blue\": ");
  EXPECT_EQ(render(kTinted, {"--preset", "blue"}).code, 3);
  writeText(folder / "a.frag.presets.json", R"({ "presets": { "blue": { "tint": null } } })");
  EXPECT_EQ(render(kTinted, {"--preset", "blue"}).code, 3);
}

TEST_F(ShaderFile, IsTakenByTheOtherVerbs) {
  writeText(folder / "a.frag", kTinted);
  const Outcome verified = run(folder, {"verify", "a.frag", "--size", "32x24", "--json", "-P", "gain=0.5"});
  EXPECT_EQ(verified.code, 0) << verified.err;
  const Json json = Json::parse(verified.out);
  EXPECT_EQ(json["wrong"]["pixels"], 0);
  EXPECT_GT(json["color"]["by_shader"], 50);
  EXPECT_THAT(run(folder, {"inspect", "a.frag"}).out, StartsWith("a.frag: the shader of a material\n"));
  const Outcome pixel = run(folder, {"inspect", "a.frag", "--size", "48x32", "--pixel", "15,16", "--json"});
  EXPECT_EQ(pixel.code, 0) << pixel.err;
  EXPECT_EQ(Json::parse(pixel.out)["points"][0]["node"], "ball");
  writeText(folder / "b.frag", "void mainImage(out vec4 c, in vec2 at) { c = vec4(iTime); }\n");
  EXPECT_THAT(run(folder, {"inspect", "b.frag"}).out, HasSubstr("iTime"));
  // Of a file that has both, the one that is meant.
  writeText(folder / "c.frag", kTinted + "void mainImage(out vec4 c, in vec2 at) { c = vec4(1); }\n");
  EXPECT_THAT(run(folder, {"inspect", "c.frag"}).out, Not(HasSubstr("iTime")));
  EXPECT_THAT(run(folder, {"inspect", "c.frag", "--shadertoy"}).out, HasSubstr("iTime"));
  EXPECT_THAT(run(folder, {"inspect", "c.frag", "--shadertoy", "--size", "48x32", "--pixel", "0,0"}).out,
              HasSubstr("picture"));
  expectFailure(run(folder, {"inspect", "a.frag", "--shadertoy"}), 3, "there is no function",
                "leave out --shadertoy");
  expectFailure(run(folder, {"inspect", "teapot", "--shadertoy"}), 2, "'teapot' is none");
  writeText(folder / "a.frag.presets.json", R"({ "presets": { "blue": { "tint": [0, 0, 1], "old": 1 } } })");
  const Outcome preset = run(folder, {"inspect", "a.frag", "--preset", "blue", "--json"});
  EXPECT_THAT(preset.err, HasSubstr("the preset has a value for 'old'"));
  const Json told = Json::parse(preset.out);
  EXPECT_FALSE(told["uniforms"].empty());
  for (const Json& uniform : told["uniforms"])
    EXPECT_EQ(uniform.value("value", "none"), uniform["name"] == "tint" ? "0,0,1" : "none") << uniform;
  EXPECT_THAT(run(folder, {"inspect", "a.frag", "--preset", "blue"}).out, HasSubstr("is 0,0,1"));
}

TEST(Lab, RefusesWhatItCannotShow) {
  const ScratchFolder folder;
  writeText(folder / "a.frag", kTinted);
  writeText(folder / "m.frag", "void mainImage(out vec4 c, in vec2 at) { c = vec4(1); }\n");
  expectFailure(run(folder, {"lab"}), 2, "SHADER is required");
  expectFailure(run(folder, {"lab", "none.frag"}), 3, "there is no such file");
  expectFailure(run(folder, {"lab", "a.txt"}), 2, "'a.txt' is no shader file");
  expectFailure(run(folder, {"lab", "a.frag", "none.luxo.json"}), 3, "there is no such file");
  expectFailure(run(folder, {"lab", "a.frag", "-"}), 2, "no scene that can be read again");
  expectFailure(run(folder, {"lab", "a.frag", "primitives"}), 2, "made by a program");
  expectFailure(run(folder, {"lab", "a.frag", "flag", "--material", "none"}), 2, "has no material 'none'");
  expectFailure(run(folder, {"lab", "m.frag", "flag"}), 2, "fills the picture by itself");
}

TEST(Lab, GivesTheShaderToMaterialsOfAScene) {
  const ScratchFolder folder;
  const std::string shader = folder / "a.frag", scene = folder / "s.luxo.json", model = folder / "tri.obj";
  writeText(shader, kTinted);
  writeText(scene, R"({ "luxo": 1, "params": { "gain": 2 },
  "materials": { "seen": { "diffuse": ["u", 0, 0], "opacity": 0.5 }, "other": { "diffuse": 1 } },
  "surfaces": { "ball": { "type": "sphere" } },
  "nodes": [ { "surface": "ball", "material": "seen" }, { "surface": "ball", "material": "other" },
             { "name": "bare", "surface": "ball" } ] })");
  const auto shadersOf = [](const Scene& built) {
    const Snapshot snapshot = takeSnapshot(built, 0, {8, 8}, Camera{});
    std::string text;
    for (const SnapshotNode& node : snapshot.nodes) {
      const Material& material = snapshot.materials[node.material.index];
      text += material.shader ? 'y' : 'n';
      for (const UniformValue& uniform : material.uniforms)
        if (uniform.name == "gain") {
          EXPECT_EQ(uniform.values.front(), 2) << "the scene's parameter of that name";
        }
    }
    return text;
  };
  EXPECT_EQ(shadersOf(openShader(shader, {.scene = scene}).scene), "yyy");
  EXPECT_EQ(shadersOf(openShader(shader, {.scene = scene, .material = "seen"}).scene), "ynn");
  writeText(model, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::vector<NamedFile> inputs;
  const OpenedShader opened = openShader(shader, {.scene = model}, {.inputs = &inputs});
  EXPECT_EQ(opened.scene.parameters().size(), 5);  // three of the tint, gain, mode
  EXPECT_EQ(opened.controls.size(), 3);
  EXPECT_TRUE(std::ranges::any_of(inputs, [&](const NamedFile& file) { return file.path == model; }));
}

}  // namespace
}  // namespace luxo::test
