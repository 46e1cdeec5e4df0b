// SPDX-License-Identifier: Apache-2.0
// Materials with shaders, as users meet them: errors at their own file, line and column, what luxo inspect
// and luxo verify say.
#include <gmock/gmock.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/program.h"
#include "image/format.h"

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

/// Not where the file ends.
TEST_F(MaterialShaderProgram, WhatHasNoEndIsToldWhereItBegins) {
  const std::string rest = "vec4 material(Point p) { return vec4(1.0); }\n";
  expectError("// a\n  /* b\n" + rest, "m.frag:2:3: this comment has no end\n");
  expectError("#define N 2\n#if N > 1\n#ifdef A\n#endif\n" + rest,
              "m.frag:2:1: this condition has no '#endif'\n");
  expectError("#if 0\n" + rest, "m.frag:1:1: this condition has no '#endif'\n");
  expectError("float f(float x) {\n  if (x > 1.0) { x = 2.0;\n  return x;\n}\n" + rest,
              "m.frag:1:18: this '{' has no '}'\n");
  writeText(folder / "open.glsl", "#ifndef OPEN\nfloat f(float x) { return x; }\n");
  expectError("#include \"open.glsl\"\n" + rest, "open.glsl:1:1: this condition has no '#endif'\n");
  writeText(folder / "open.glsl", "float f(float x) { return x; }\n/* it does");
  expectError("#include \"open.glsl\"\n" + rest, "open.glsl:2:1: this comment has no end\n");
  expectError("#line 90\n" + rest, "m.frag:1:1: '#line' would move the places of errors\n");
}

/// At the word itself, as it was written: behind loops, which are given another word, in macros, in the
/// course's style, in what is included.
TEST_F(MaterialShaderProgram, ErrorsAreAtTheirWords) {
  expectError(
      "vec4 material(Point p) {\n\tfor (int i = 0; i < 3; ++i) { do { vec2 a = p.uv; vec2 b = p.position; } "
      "while "
      "(false); }\n\treturn vec4(1.0);\n}\n",
      "m.frag:2:59: '=' :  cannot convert from");
  expectError("#define LIT(x) (x).norml\nvec4 material(Point p) { return vec4(1.0, 0.0, LIT(p), 1.0); }\n",
              "m.frag:2:48: 'norml' : no such field in structure 'p', in what the macro 'LIT' stands for\n");
  expectError(
      "varying vec3 v;\nvoid main() { vec3 sample = v; gl_FragColor = vec4(sample, 1.0) + sample; }\n",
      "m.frag:2:65: '+' :  wrong operand types");
  expectError("void main() { vec3 sample = gl_Color.rgb; gl_FragColor = vec4(sample.r, 1.0, patch, 1.0); }\n",
              "m.frag:1:78: 'patch' : undeclared identifier\n");
  writeText(folder / "in.glsl", "// y\nfloat f(float x) { float z = x; return z * y; }\n");
  expectError("#include \"in.glsl\"\nvec4 material(Point p) { return vec4(f(1.0)); }\n",
              "in.glsl:2:44: 'y' : undeclared identifier\n");
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
  for (int i = 20; i < 60; ++i)
    doubling += "float f" + std::to_string(i) + "(float x) { return f" + std::to_string(i - 1) + "(x) + f" +
                std::to_string(i - 1) + "(2.0 * x); }\n";
  expectError(doubling + "vec4 material(Point p) { return vec4(f59(p.uv.x)); }\n",
              "at most 32768 are compiled");
  expectError(doubling + "void main() { gl_FragColor = vec4(f59(gl_Color.x)); }\n",
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
  expectError("layout(constant_id = 3) const float k = 1.0;\nvec4 material(Point p) { return vec4(k); }\n",
              "m.frag:1:8: 'constant_id' makes a specialization constant");
  expectError(
      "#ifdef LUXO_TEXTURED\nlayout(constant_id = 99) const float k = 1.0;\n#endif\n"
      "vec4 material(Point p) { return vec4(1); }\n",
      "m.frag:2:8: 'constant_id' makes a specialization constant");
  expectError("vec4 material(Point p) { gl_FragDepth = 0.5; return vec4(1); }\n",
              "'gl_FragDepth' is an input or output");
}

/// All that a search for words in the text meets, before a compiler does.
TEST_F(MaterialShaderProgram, LongLinesAreErrors) {
  constexpr int kMany = 250'000;
  const std::string rest = "\nvec4 material(Point p) { return vec4(1); }\n";
  for (const std::string& line :
       {std::string(kMany, 'a'), std::string(kMany, '('), "uniform float " + std::string(kMany, 'a') + ";",
        "const float " + std::string(kMany, '[') + ";"}) {
    const Outcome outcome = drawn(line + rest);
    EXPECT_EQ(outcome.code, 3) << line.substr(0, 20);
    EXPECT_THAT(outcome.err, HasSubstr("m.frag:1:")) << line.substr(0, 20);
  }
  EXPECT_EQ(drawn(std::string(kMany, ' ') + rest).code, 0);
  EXPECT_EQ(drawn("/*" + std::string(kMany, '*') + "*/" + rest).code, 0);
}

TEST_F(MaterialShaderProgram, BombsAreErrors) {
  std::string macros = "#define A0 x x\n";
  for (int i = 1; i < 40; ++i)
    macros +=
        "#define A" + std::to_string(i) + " A" + std::to_string(i - 1) + " A" + std::to_string(i - 1) + "\n";
  const std::string rest = "vec4 material(Point p) { return vec4(1); }\n";
  expectError(macros + "float f() { return A39; }\n" + rest,
              "m.frag:41:20: macros come to more than 262144 words");
  for (int i = 0; i < 30; ++i)
    writeText(folder / ("f" + std::to_string(i) + ".glsl"),
              i == 29 ? "\n"
                      : "#include \"f" + std::to_string(i + 1) + ".glsl\"\n#include \"f" +
                            std::to_string(i + 1) + ".glsl\"\n");
  expectError("#include \"f0.glsl\"\n" + rest, "files are included more than 1000 times");
  std::string structures = "struct S0 { float a; };\n";
  for (int i = 1; i < 40; ++i)
    structures += "struct S" + std::to_string(i) + " { S" + std::to_string(i - 1) + " a, b; };\n";
  expectError(structures + rest, "m.frag:8:20: this structure has more than 256 members");
}

/// As deep as is allowed, and compiled; and deeper.
TEST_F(MaterialShaderProgram, WhatIsNestedDeepIsCompiledOrAnError) {
  const auto repeated = [](const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  };
  const auto shaderOf = [&](const std::string& open, const std::string& close, int times) {
    return "vec4 material(Point p) { float x = p.uv.x; x = " + repeated(open, times) + "x" +
           repeated(close, times) + "; return vec4(vec3(x * 0.0), 1); }\n";
  };
  for (const auto& [open, close] : {std::pair{"(", ")"}, {"1.0+", ""}, {"- ", ""}, {"abs(", ")"}}) {
    const Outcome deep = drawn(shaderOf(open, close, 900));
    EXPECT_EQ(deep.code, 0) << open << deep.err;
    std::filesystem::remove(folder / "a.png");
    expectError(shaderOf(open, close, 2100), "brackets and operators are nested more than 2000 deep here");
  }
  const auto branches = [&](int times) {
    return "vec4 material(Point p) { float x = p.uv.x; " + repeated("if (x < 0.5) x += 0.1; else ", times) +
           "x = 1.0; return vec4(vec3(x * 0.0), 1); }\n";
  };
  expectError(branches(100), "m.frag: its branches are nested 100 deep");
  EXPECT_EQ(drawn(shaderOf("x>0.1?x:", "", 50)).code, 0);
  std::filesystem::remove(folder / "a.png");
  expectError(shaderOf("x>0.1?x:", "", 300), "branches are nested more than 256 deep here");
  expectError(branches(300), "branches are nested more than 256 deep here");
}

/// Drivers draw what is deeper than their stacks wrong, without a word.
TEST_F(MaterialShaderProgram, WhatIsNestedDeepIsDrawnRightOrRefused) {
  const auto branches = [](const std::string& each, int from, int to, const std::string& innermost) {
    std::string text, end;
    for (int i = from; i < to; ++i) {
      text += "if (x > " + std::to_string(i) + ".0) {" + each;
      end += "}";
    }
    return text + innermost + end;
  };
  // Each counts the steps that are taken, which are all.
  const auto nested = [&](int depth) {
    return "float f(float x) { float v = 0.0;\n" + branches(" v += cos(v * 0.0);\n", 0, depth, "") +
           "return v; }\n";
  };
  const auto calling = [&](int depth) {
    return "float g(float x, float v) {\n" + branches(" v += cos(v * 0.0);\n", depth / 2, depth, "") +
           "return v; }\nfloat f(float x) { float v = 0.0;\n" +
           branches(" v += cos(v * 0.0);\n", 0, depth / 2, "v = g(x, v);") + "return v; }\n";
  };
  const auto returning = [](int depth) {
    std::string text = "float f(float x) { float v = 0.0;\n";
    for (int i = 0; i < depth; ++i)
      text += "if (x < " + std::to_string(i) + ".0) return v; v += cos(v * 0.0);\n";
    return text + "return v - 1.0; }\n";
  };
  const auto shaderOf = [](const std::string& functions, int depth) {
    const std::string steps = std::to_string(depth);
    return functions + "vec4 material(Point p) { float v = f(" + steps +
           ".0 - 0.5 + p.uv.x * 0.0); return vec4(v == " + steps + ".0 ? 1.0 : 0.0, v == " + steps +
           ".0 - 1.0 ? 1.0 : 0.0, 0, 1); }\n";
  };
  for (const auto& [functions, green] :
       {std::pair{std::function<std::string(int)>(nested), 0.0}, {calling, 0.0}, {returning, 1.0}}) {
    const Outcome outcome = drawn(shaderOf(functions(50), 50));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Image image = loadImage(folder / "a.png");
    EXPECT_NEAR(image.pixel(16, 12)[0], 1.0 - green, 1e-6);
    EXPECT_NEAR(image.pixel(16, 12)[1], green, 1e-6);
    std::filesystem::remove(folder / "a.png");
    expectError(shaderOf(functions(100), 100), "m.frag: its branches are nested 1");
  }
}

TEST_F(MaterialShaderProgram, WordsInQuotesHideNoDirective) {
  expectError(
      "#if 0\n\" /* \"\n#endif\n#define LUXO_X\n#if 0\n\" */ \"\n#endif\nvec4 material(Point p) { return "
      "vec4(1); }\n",
      "m.frag:4:9: 'LUXO_X' is a name of luxo's own");
}

/// A call that a directive stands in does not change what is read of uniforms behind it.
TEST_F(MaterialShaderProgram, UniformsBehindADirectiveInACall) {
  const Outcome outcome = drawn(
      "float f(float a, float b) { return max(\n#ifdef HIGH\n a,\n#endif\n b, 1.0); }\nuniform bool on;\n"
      "vec4 material(Point p) { return vec4(on ? 1 : 0); }\n",
      R"({ "on": true })");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(MaterialShaderProgram, WhatOnlySomeDevicesHaveIsRefused) {
  const std::string rest = "vec4 material(Point p) { return vec4(1); }\n";
  expectError("#extension GL_EXT_ray_query : require\n" + rest,
              "m.frag:1:12: '#extension GL_EXT_ray_query': only some devices have it");
  expectError("#extension all : warn\n" + rest,
              "m.frag:1:12: '#extension all' asks for what only some devices");
  EXPECT_EQ(
      drawn("#extension GL_OES_standard_derivatives : enable\n#extension GL_EXT_ray_query : disable\n" + rest)
          .code,
      0);
  std::filesystem::remove(folder / "a.png");
  expectError("layout(early_fragment_tests) in;\n" + rest,
              "m.frag: it asks for early_fragment_tests, which only some devices have");
  for (const char* name : {"gl_SampleID", "gl_PrimitiveID", "gl_FrontFacing"})
    expectError("vec4 material(Point p) { return vec4(vec3(" + std::string(name) + "), 1); }\n",
                "'" + std::string(name) + "' is an input or output");
  expectError("vec4 material(Point p) { return vec4(gl_PointCoord, 0, 1); }\n",
              "'gl_PointCoord' is an input or output");
}

TEST_F(MaterialShaderProgram, LongTablesAreRefusedAtTheirPlace) {
  const auto shaderOf = [](int elements) {
    std::string list = "0.0";
    for (int i = 1; i < elements; ++i) list += ", " + std::to_string(i) + ".0";
    return "const float table[] = float[](" + list +
           ");\nvec4 material(Point p) { return vec4(vec3(table[int(p.uv.x * 9.0)]), 1); }\n";
  };
  EXPECT_EQ(drawn(shaderOf(256)).code, 0);
  std::filesystem::remove(folder / "a.png");
  expectError(shaderOf(257), "m.frag:1:30: an array of constants has 257 elements; at most 256 are compiled");
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

/// Of a material, of a program in the course's style, and of a picture: by the rules of std140.
TEST_F(MaterialShaderProgram, InspectTellsWhereUniformsAre) {
  const std::string uniforms = "uniform float x;\nuniform vec3 a[4];\nuniform mat2 m;\n";
  const std::string value = "vec4(a[int(x)] + vec3(m[1], x), 1.0)";
  for (const std::string& text :
       {uniforms + "vec4 material(Point p) { return " + value + "; }\n",
        uniforms + "void main() { gl_FragColor = " + value + "; }\n",
        uniforms + "void mainImage(out vec4 c, in vec2 at) { c = " + value + "; }\n"}) {
    writeText(folder / "m.frag", text);
    const Outcome told = run(folder, {"inspect", "m.frag", "--json"});
    ASSERT_EQ(told.code, 0) << told.err;
    std::vector<std::string> names;
    std::uint32_t first = 0;  // after those that a picture is given
    const Json json = Json::parse(told.out);
    for (const Json& uniform : json["uniforms"]) {
      names.push_back(uniform["name"]);
      EXPECT_EQ(uniform["stages"], Json::array({"fragment"})) << text;
      if (uniform["name"] == "x") first = uniform["offset"];
      if (uniform["name"] == "a") {
        EXPECT_EQ(uniform["type"], "vec3");
        EXPECT_EQ(uniform["array"], Json::array({4}));
        EXPECT_EQ(uniform["offset"], (first + 4 + 15) / 16 * 16);
        EXPECT_EQ(uniform["array_stride"], 16);
      }
      if (uniform["name"] == "m") {
        EXPECT_EQ(uniform["type"], "mat2");
        EXPECT_EQ(uniform["offset"], (first + 4 + 15) / 16 * 16 + 64);
        EXPECT_EQ(uniform["matrix_stride"], 16);
      }
    }
    EXPECT_THAT(names, testing::IsSupersetOf({"x", "a", "m"})) << text;
    EXPECT_THAT(run(folder, {"inspect", "m.frag"}).out, HasSubstr("a[4]")) << text;
  }
}

TEST_F(MaterialShaderProgram, InspectRefusesLongSpirv) {
  writeText(folder / "a.spv", std::string((std::size_t{1} << 18) + 4, 'a'));
  const Outcome outcome = run(folder, {"inspect", "a.spv"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("a.spv': it has 262148 bytes; at most 262144 are read"));
}

/// Words that begin as SPIR-V does and go on as anything.
TEST_F(MaterialShaderProgram, InspectRefusesDamagedSpirv) {
  std::uint32_t random = 1;
  for (int length : {0, 1, 5, 6, 40, 400}) {
    std::string bytes;
    for (int i = 0; i < length; ++i) {
      random = random * 1664525 + 1013904223;
      const std::uint32_t header[] = {0x07230203, 0x00010600, 0, 100, 0};
      const std::uint32_t word = i < 5        ? header[i]
                                 : i % 3 == 0 ? random
                                              : (random >> 28 << 16) + (random >> 8 & 255);
      bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
    }
    writeText(folder / "a.spv", bytes);
    const Outcome outcome = run(folder, {"inspect", "a.spv"});
    EXPECT_EQ(outcome.code, 3) << length;
    EXPECT_THAT(outcome.err, StartsWith("error: ")) << length;
    EXPECT_THAT(outcome.err, HasSubstr("SPIR-V")) << length;
  }
}

}  // namespace
}  // namespace luxo::test
