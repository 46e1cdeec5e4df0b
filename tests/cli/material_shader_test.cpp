// SPDX-License-Identifier: Apache-2.0
// Materials with shaders, as users meet them: errors at their own file, line and column, what luxo inspect
// and luxo verify say.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class MaterialShaderProgram : public DeviceRenderTest {
 protected:
  [[nodiscard]] Outcome drawn(const std::string& shader, const std::string& uniforms = "{}",
                              const Arguments& more = {}) const {
    writeText(folder / "m.frag", shader);
    writeText(folder / "s.luxo.json", R"({ "luxo": 1,
  "params": { "k": 0.5 },
  "materials": { "own": { "shader": "m.frag",
    "uniforms": )" + uniforms + R"( } },
  "surfaces": { "ball": { "type": "sphere" } },
  "nodes": [ { "surface": "ball", "material": "own" }, { "translate": [3, 4, 5], "light": { "type": "point" } } ] })");
    Arguments arguments = {"render", "s.luxo.json", "-o", "a.png", "--size", "32x24"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(folder, arguments);
  }
  void expectError(const std::string& shader, const std::string& said,
                   const std::string& uniforms = "{}") const {
    const Outcome outcome = drawn(shader, uniforms);
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr(said));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
  }
};

TEST_F(MaterialShaderProgram, ErrorsAreAtTheirOwnLine) {
  const Outcome outcome =
      drawn("uniform float a;\nvec4 material(Point p) {\n  for (;;) { float b = p.norml.x; }\n}\n");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, StartsWith("error: m.frag:3:26: 'norml' : no such field in structure 'p'\n"
                                      "  3 |   for (;;) { float b = p.norml.x; }\n"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("lib/")));
  writeText(folder / "inc.glsl", "\nfloat twice(float x) { return x * y; }\n");
  expectError("#include \"inc.glsl\"\nvec4 material(Point p) { return vec4(twice(1.0)); }\n",
              "inc.glsl:2:35: 'y' : undeclared identifier\n");
}

/// What passes by itself would be an error in luxo's own text once they are joined.
TEST_F(MaterialShaderProgram, NamesOfWhatItIsGivenAreRefusedAtTheirPlace) {
  const std::string rest = "vec4 material(Point p) { return vec4(1); }\n";
  expectError("uniform float light = 0.5;\n" + rest, "m.frag:1:15: 'light' is a name of luxo's own");
  expectError("const vec3 ambientLight = vec3(1);\n" + rest, "m.frag:1:12: 'ambientLight'");
  expectError("#define material foo\n" + rest,
              "m.frag:1:9: 'material' is a name of luxo's own, which no macro has");
  expectError("\n#pragma luxo opacty\n" + rest, "m.frag:2:14: '#pragma luxo opacty' is not known");
  EXPECT_EQ(drawn("layout(location = 2) uniform float x;\nuniform layout(location = 3) vec3 y = vec3(1);\n"
                  "vec4 material(Point p) { float light = x; return vec4(y * light, 1); }\n")
                .code,
            0);
}

/// One error, at its place, and what to write.
TEST_F(MaterialShaderProgram, WhatFollowsFromAnErrorIsNotTold) {
  const auto said = [&](const std::string& shader) {
    const Outcome outcome = drawn(shader);
    EXPECT_EQ(outcome.code, 3);
    return outcome.err;
  };
  EXPECT_THAT(said("#version 330\nin vec3 n; out vec4 c;\nvoid main() { c = vec4(1); }\n"),
              testing::AllOf(StartsWith("error: m.frag:3:6: 'main' is of a program"),
                             HasSubstr("write vec4 material(Point p)"), Not(HasSubstr("lib/"))));
  EXPECT_THAT(said("#include \"m.frag\"\nvec4 material(Point p) { return vec4(1); }\n"),
              testing::AllOf(StartsWith("error: m.frag:1:10: 'm.frag' includes itself\n"),
                             Not(HasSubstr("m.frag:2"))));
  writeText(folder / "one.glsl", "#include \"two.glsl\"\n");
  writeText(folder / "two.glsl", "#include \"one.glsl\"\n");
  EXPECT_THAT(said("#include \"one.glsl\"\nvec4 material(Point p) { return vec4(1); }\n"),
              StartsWith("error: one.glsl:1:10: 'one.glsl' includes itself, by way of 'two.glsl'\n"));
  writeText(folder / "open.glsl", "float halved(float x) {\n  return 0.5 * x;\n");
  EXPECT_THAT(
      said("#include \"open.glsl\"\nuniform float q;\nvec4 material(Point p) { return vec4(halved(q)); }\n"),
      testing::AllOf(StartsWith("error: open.glsl:1:23: this '{' has no '}'\n"), Not(HasSubstr("m.frag"))));
  EXPECT_THAT(said("void main() { gl_FragData[0] = vec4(1); }\n"),
              testing::AllOf(HasSubstr("m.frag:1:15: 'gl_FragData'"), HasSubstr("write gl_FragColor")));
}

/// Arrays that shaders only read element by element take no room of a point; others do.
TEST_F(MaterialShaderProgram, ArraysThatAreCopiedAreLimited) {
  const std::string sum = "float sum(float x[20000]) { return x[3]; }\n";
  expectError("uniform float a[20000];\n" + sum + "vec4 material(Point p) { return vec4(sum(a)); }\n",
              "its variables take");
  EXPECT_EQ(
      drawn(
          "uniform float a[20000];\nvec4 material(Point p) { return vec4(vec3(a[int(p.uv.x * 9.0)]), 1); }\n")
          .code,
      0);
}

TEST_F(MaterialShaderProgram, HostileOnesAreErrors) {
  expectError("#include \"m.frag\"\nvec4 material(Point p) { return vec4(1); }\n", "m.frag:1:");
  expectError(
      "float f(float x) { return x > 0.0 ? f(x - 1.0) : 0.0; }\nvec4 material(Point p) { return "
      "vec4(f(1.0)); }\n",
      "m.frag:1:7: the function 'f' calls itself");
  std::string doubling = "float f0(float x) { return sin(x); }\n";
  for (int i = 1; i < 20; ++i)
    doubling += "float f" + std::to_string(i) + "(float x) { return f" + std::to_string(i - 1) + "(x) + f" +
                std::to_string(i - 1) + "(2.0 * x); }\n";
  expectError(doubling + "vec4 material(Point p) { return vec4(f19(p.uv.x)); }\n",
              "at most 32768 are compiled");
  expectError("float a[100000000];\nvec4 material(Point p) { return vec4(a[int(p.uv.x)]); }\n",
              "m.frag: its variables take 400000");
  expectError("#define AGAIN while\nvec4 material(Point p) { AGAIN (p.uv.x > -9.0) { } return vec4(1); }\n",
              "a macro spells a loop");
  expectError(
      "#define G while\nvec4 material(Point p) { luxoStops(); G (p.uv.x > -9.0) { } return vec4(1); }\n",
      "m.frag:2:26: 'luxoStops' is a name of luxo's own");
  expectError(
      "uniform float k = 1.0;\nfloat twice = 2.0 * k;\nvec4 material(Point p) { return vec4(twice); }\n",
      "m.frag:2:7: 'twice' is computed before any uniform has its value");
  expectError("struct S { float x; };\nuniform S s;\nvec4 material(Point p) { return vec4(s.x); }\n",
              "m.frag:2:11: the uniform 's' is of type S");
  expectError("vec4 colour(Point p) { return vec4(1); }\n", "there is no function 'vec4 material(Point p)'");
  expectError("float x = " + std::string(20000, '(') + "1.0" + std::string(20000, ')') + ";\n", "m.frag:1:");
  expectError("uniform B { float x; } b;\nvec4 material(Point p) { return vec4(b.x); }\n",
              "the block 'B' has no values");
  expectError("vec4 material(Point p) { gl_FragDepth = 0.5; return vec4(1); }\n",
              "'gl_FragDepth' is an input or output");
}

TEST_F(MaterialShaderProgram, AFileMayBeginWithAByteOrderMark) {
  EXPECT_EQ(drawn("\xef\xbb\xbfvec4 material(Point p) { return vec4(1); }\n").code, 0);
}

TEST_F(MaterialShaderProgram, NamesOfLuxosOwnFilesAreRefused) {
  std::filesystem::create_directory(folder / "lib");
  writeText(folder / "lib/scene.glsl", "float own() { return 1.0; }\n");
  expectError("#include \"lib/scene.glsl\"\nvec4 material(Point p) { return vec4(own()); }\n",
              "'lib/scene.glsl' has the name of one of luxo's own");
}

TEST_F(MaterialShaderProgram, ValuesHaveNamesAndTypes) {
  const std::string shader =
      "uniform vec3 tint;\nuniform float gloss, idle;\nuniform int steps;\n"
      "vec4 material(Point p) { return vec4(tint * gloss * float(steps), 1); }\n";
  expectError(shader, "s.luxo.json:4:26: the shader 'm.frag' has no uniform 'tnt'",
              R"({ "tnt": [1, 0, 0] })");
  EXPECT_THAT(drawn(shader, R"({ "tnt": [1, 0, 0] })").err, HasSubstr("did you mean 'tint'?"));
  expectError(shader, "is of type vec3: 3 numbers, not 2", R"({ "tint": [1, 0] })");
  expectError(shader, "is of type int, not true or false", R"({ "steps": true })");
  expectError(shader, "is of type vec3, not true or false", R"({ "tint": [true, false, true] })");
  expectError(shader, "expected true and false, or numbers", R"({ "tint": [1, false, 0] })");
  expectError(shader, "is of type int, and this is 0.5", R"({ "steps": "k" })");
  const Outcome outcome =
      drawn(shader, R"({ "tint": "#ff8000", "gloss": "k", "steps": 1, "idle": 2 })", {"-P", "k=0.25"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("nothing in the shader 'm.frag' uses the uniform 'idle'"));
}

TEST_F(MaterialShaderProgram, VerifyLeavesItsColoursOut) {
  ASSERT_EQ(drawn("vec4 material(Point p) { return vec4(p.uv, 9, 1); }\n").code, 0);
  const Outcome outcome = run(folder, {"verify", "s.luxo.json", "--size", "32x24", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["wrong"]["pixels"], 0);
  EXPECT_EQ(json["color"]["by_shader"], json["coverage"]["covered"]);
  EXPECT_GT(json["color"]["by_shader"], 50);
  const Outcome truth =
      run(folder, {"render", "s.luxo.json", "--engine", "reference", "-o", "b.png", "--size", "8x8"});
  EXPECT_EQ(truth.code, 0);
  EXPECT_THAT(truth.err, HasSubstr("cannot run the shader of 'own'"));
}

TEST_F(MaterialShaderProgram, InspectTellsItsUniforms) {
  writeText(folder / "m.frag",
            "uniform vec2 size;\nuniform float idle;\nvec4 material(Point p) { return vec4(size, 0, 1); }\n");
  const Json json = Json::parse(run(folder, {"inspect", "m.frag", "--json"}).out);
  EXPECT_EQ(json["material"], true);
  EXPECT_EQ(json["uniforms"][0]["name"], "size");
  EXPECT_EQ(json["uniforms"][0]["type"], "vec2");
  EXPECT_EQ(json["uniforms"][0]["active"], true);
  EXPECT_EQ(json["uniforms"][1]["active"], false);
  writeText(folder / "p.vert",
            "#version 460\nlayout(location = 3) in vec4 place;\nlayout(std140, set = 1, binding = 2) uniform "
            "B { mat4 m; };\n"
            "void main() { gl_Position = m * place; }\n");
  const Outcome vertex = run(folder, {"inspect", "p.vert"});
  EXPECT_EQ(vertex.code, 0) << vertex.err;
  EXPECT_THAT(vertex.out, HasSubstr("place"));
  EXPECT_THAT(vertex.out, HasSubstr("block B: uniform, 64 bytes, set 1, binding 2"));
}

}  // namespace
}  // namespace luxo::test
