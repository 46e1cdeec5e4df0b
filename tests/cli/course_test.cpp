// SPDX-License-Identifier: Apache-2.0
// Programs in the course's style, as users meet them: mistakes at their own place in either file, what luxo
// inspect says.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <sstream>
#include <string>
#include <utility>

#include "cli/program.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kVertex =
    "#version 120\nattribute vec3 tangent;\nuniform float time;\nvarying vec3 n;\n"
    "void main() { n = gl_NormalMatrix * gl_Normal + time * tangent; gl_Position = ftransform(); }\n";
constexpr const char* kFragment =
    "#version 120\nuniform vec3 paint = vec3(1.0);  // @color\nuniform sampler2D skin;\nvarying vec3 n;\n"
    "void main() { gl_FragColor = vec4(paint * n.z, 1.0) * texture2D(skin, vec2(0.5)); }\n";

class CourseFiles : public DeviceRenderTest {
 protected:
  void expectError(const std::string& vertex, const std::string& fragment, const std::string& begins) const {
    writeText(folder / "m.vert", vertex);
    writeText(folder / "m.frag", fragment);
    const Outcome outcome = run(folder, {"render", "m.frag", "-o", "a.png", "--size", "16x12"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, StartsWith("error: " + begins));
    EXPECT_THAT(outcome.err, Not(HasSubstr("gL_")));
    for (const char* prefix : {"luxoFragment", "luxoVertex"})
      EXPECT_THAT(outcome.err, Not(HasSubstr(prefix)));
  }
};

TEST_F(CourseFiles, StandAsAScene) {
  writeText(folder / "m.vert", kVertex);
  writeText(folder / "m.frag", kFragment);
  const Outcome outcome = run(folder, {"render", "m.frag", "-o", "a.png", "--size", "16x12", "-P",
                                       "paint=#ff8000", "-P", "skin=glow_map"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(run(folder, {"render", "m.frag", "-o", "a.png", "-P", "skin=3"}).code, 2);
}

TEST_F(CourseFiles, MistakesAreAtTheirPlace) {
  // Each program's own, with the names that it has.
  expectError(kVertex, "void main() {\n  gl_FragColor = gl_LightSource[0].difuse;\n}\n",
              "m.frag:2:36: 'difuse' : no such field\n"
              "  2 |   gl_FragColor = gl_LightSource[0].difuse;\n");
  expectError("void main() {\n  gl_Vertex = vec4(0.0);\n  gl_Position = ftransform();\n}\n", kFragment,
              "m.vert:2:");
  expectError("void main() { gl_Position = ftransfrm(); }\n", "void main() { gl_FragColor = vec4(1.0); }\n",
              "m.vert:1:29: 'ftransfrm' : no matching overloaded function found");
  expectError(kVertex, "varying vec3 n;\nvoid main() { n = vec3(0.0); gl_FragColor = vec4(n, 1.0); }\n",
              "m.frag:2:");
  expectError(kVertex, "void main() { gl_FragColor = vec4(gl_Vertx); }\n",
              "m.frag:1:35: 'gl_Vertx' : undeclared identifier");
  // Of the language: components that a vector has not, or twice; what cannot be converted.
  for (const char* wrong : {"v2.z", "v4.xgp", "v4.xx = vec2(9.0, 3.0)", "v4.yz = 11.0", "v2 = v4"})
    expectError(kVertex,
                "void main() {\n  vec2 v2 = vec2(1.0); vec4 v4 = vec4(1.0);\n  " + std::string(wrong) +
                    ";\n  gl_FragColor = v4;\n}\n",
                "m.frag:3:");
  // Of both together.
  expectError(kVertex, "// m\nvarying vec3 m;\nvoid main() { gl_FragColor = vec4(m, 1.0); }\n",
              "m.frag:2:14: the vertex program 'm.vert' has no varying 'm'");
  expectError(kVertex, "varying vec4 n;\nvoid main() { gl_FragColor = n; }\n",
              "m.frag:1:14: the varying 'n' is of type vec4 here, and of type vec3 in the vertex program");
  expectError(kVertex,
              "uniform vec2 time;\nvarying vec3 n;\nvoid main() { gl_FragColor = vec4(n, time.x); }\n",
              "m.frag:1:14: the uniform 'time' is of type vec2 here");
  expectError("uniform float a = 1.0;\nvoid main() { gl_Position = a * ftransform(); }\n",
              "uniform float a = 2.0;\nvoid main() { gl_FragColor = vec4(a); }\n",
              "m.frag:1:15: the uniform 'a' begins at 2.0 here, and at 1.0 in the vertex program");
  expectError("attribute vec3 tangnt;\nvoid main() { gl_Position = ftransform() + vec4(tangnt, 0.0); }\n",
              "void main() { gl_FragColor = vec4(1.0); }\n", "m.vert:1:16: 'tangnt' is no attribute");
  expectError("void main() { }\n", "void main() { gl_FragColor = vec4(1.0); }\n",
              "m.vert: the program does not write gl_Position");
  expectError(kVertex, "varying vec3 n;\nvoid main() { vec3 m = n; }\n",
              "m.frag: the program does not write gl_FragColor");
  expectError(kVertex, "#pragma luxo course\nvec4 f() { return vec4(1.0); }\n",
              "m.frag: there is no function 'void main()'");
  // What there is not.
  expectError("void main() {\n  discard;\n  gl_Position = ftransform();\n}\n", kFragment,
              "m.vert:2:3: 'discard' : undeclared identifier");
  expectError(kVertex, "uniform sampler3D s;\nvoid main() { gl_FragColor = texture3D(s, vec3(0.0)); }\n",
              "m.frag:1:9: 'sampler3D': a material's maps are images");
  expectError("!!ARBvp1.0\nEND\n", kFragment, "m.vert:1:1: '!!ARBvp1.0': this is an assembly program");
  expectError("void main() { gl_Position = ftransform(); EmitVertex(); }\n", kFragment,
              "m.vert:1:43: 'EmitVertex': there are no geometry programs");
  std::filesystem::remove(folder / "m.vert");
  const Outcome alone = run(folder, {"render", "m.frag", "-o", "a.png"});
  EXPECT_EQ(alone.code, 3);
  EXPECT_THAT(alone.err,
              HasSubstr("m.frag:4:14: 'n' is a varying, and there is no vertex program that writes it"));
  EXPECT_THAT(alone.err, HasSubstr("m.vert"));
}

// The vertex program by itself, or either of the two, is the scene.
TEST_F(CourseFiles, AVertexProgramStandsAsAScene) {
  const auto picture = [&](const std::string& file, const Arguments& more = {}) {
    Arguments arguments{"render", file, "-o", "a.png", "--size", "40x30"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return textOf(folder / "a.png");
  };
  const std::string vertex =
      "uniform vec3 hue = vec3(1.0); // @color\nvoid main() { gl_FrontColor = vec4(hue * gl_Normal, 1.0); "
      "gl_Position = ftransform(); }\n";
  writeText(folder / "v.vert", vertex);
  writeText(folder / "both.vert", vertex);
  writeText(folder / "both.frag", "void main() { gl_FragColor = gl_Color; }\n");
  EXPECT_EQ(picture("v.vert"), picture("both.frag"));
  EXPECT_EQ(picture("both.vert"), picture("both.frag"));
  EXPECT_EQ(picture("v.vert", {"-P", "hue=#ff8000"}), picture("both.frag", {"-P", "hue=#ff8000"}));
  EXPECT_NE(picture("v.vert", {"-P", "hue=#ff8000"}), picture("v.vert"));
  writeText(folder / "broken.vert", "void main() {\n  gl_FrontColor = gl_Colr;\n}\n");
  expectFailure(run(folder, {"render", "broken.vert", "-o", "b.png"}), 3,
                "broken.vert:2:19: 'gl_Colr' : undeclared identifier");
}

TEST_F(CourseFiles, ScenesNameBothPrograms) {
  writeText(folder / "a.vert", kVertex);
  writeText(folder / "m.frag", kFragment);
  writeText(folder / "own.frag", "vec4 material(Point p) { return vec4(1); }\n");
  const auto drawn = [&](const std::string& material) {
    writeText(folder / "s.luxo.json", R"({ "luxo": 1, "materials": { "own": )" + material +
                                          R"( }, "surfaces": { "ball": { "type": "sphere" } },
  "nodes": [ { "surface": "ball", "material": "own" } ] })");
    return run(folder, {"render", "s.luxo.json", "-o", "a.png", "--size", "16x12"});
  };
  EXPECT_EQ(
      drawn(R"({ "shader": "m.frag", "vertex": "a.vert", "uniforms": { "time": "t", "skin": 1 } })").code, 0);
  const auto expectRefused = [&](const std::string& material, const std::string& said) {
    const Outcome outcome = drawn(material);
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr(said));
  };
  expectRefused(R"({ "shader": "m.frag", "vertex": "b.vert" })",
                "s.luxo.json:1:68: cannot read the shader 'b.vert'");
  EXPECT_EQ(drawn(R"({ "vertex": "a.vert", "uniforms": { "time": "t" } })").code, 0);
  expectRefused(R"({ "vertex": "own.frag" })", "own.frag: it is no vertex program in the course's style");
  expectRefused(R"({ "vertex": "a.vert", "diffuse": ["u", 0, 0] })",
                "s.luxo.json:1:48: the diffuse colour or opacity uses u or v, and there is a shader, too");
  expectRefused(R"({ "shader": "own.frag", "vertex": "a.vert" })", "it is no program in the course's style");
  expectRefused(R"({ "shader": "m.frag", "vertex": "a.vert", "uniforms": { "skin": 3 } })",
                "there is no map 3");
}

// As pictures have it so do models, and what is wrong with it is told where it is.
TEST_F(CourseFiles, VertexProgramsMoveMeshes) {
  const auto program = [&](const std::string& place) {
    writeText(folder / "m.vert", "uniform float rise;\nvoid main() {\n  gl_Position = " + place + ";\n}\n");
  };
  writeText(folder / "m.frag", "void main() { gl_FragColor = vec4(1.0); }\n");
  writeText(folder / "flat.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const auto sceneOf = [&](const std::string& surface) {
    writeText(folder / "s.luxo.json", R"({ "luxo": 1,
  "materials": { "m": { "shader": "m.frag", "vertex": "m.vert", "uniforms": { "rise": "2*t + 0.25" } } },
  "surfaces": { "s": )" + surface + R"( }, "nodes": [ { "surface": "s", "material": "m" } ] })");
  };
  sceneOf(R"({ "type": "mesh", "file": "flat.obj" })");
  program("gl_ModelViewProjectionMatrix * vec4(gl_Vertex.xy, rise * gl_Vertex.x, 1.0)");
  for (const auto& [time, height] : {std::pair("0", 0.25), std::pair("0.5", 1.25)}) {
    const Outcome outcome = run(folder, {"export", "s.luxo.json", "-o", "moved.obj", "--time", time});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    std::istringstream lines(textOf(folder / "moved.obj"));
    int vertices = 0;
    for (std::string line; std::getline(lines, line);) {
      double x = 0, y = 0, z = 0;
      if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) != 3) continue;
      EXPECT_EQ(z, height * x);
      ++vertices;
    }
    EXPECT_EQ(vertices, 4);
  }
  EXPECT_THAT(run(folder, {"export", "s.luxo.json", "-o", "moved.obj"}).err, HasSubstr("stand still"));
  const Arguments verify{"verify", "s.luxo.json", "--size", "40x30"};
  EXPECT_EQ(run(folder, verify).code, 0);
  const auto expectRefused = [&](const std::string& place, const std::string& said) {
    program(place);
    for (const Arguments& arguments :
         {verify,
          {"render", "s.luxo.json", "-o", "a.png", "--size", "16x12"},
          {"render", "s.luxo.json", "-o", "a.png", "--size", "16x12", "--engine", "reference"}}) {
      const Outcome outcome = run(folder, arguments);
      EXPECT_EQ(outcome.code, 3);
      EXPECT_THAT(outcome.err, HasSubstr(said));
    }
  };
  expectRefused("gl_Vertex", "m.vert:3:3: where the program moves vertices is not the same for all views");
  expectRefused("vec4(gl_Vertx)", "m.vert:3:22: 'gl_Vertx' : undeclared identifier");
  expectRefused("vec4(0.0)", "m.vert:3:3: of the vertex (");
  sceneOf(R"({ "type": "sphere" })");
  program("gl_ModelViewProjectionMatrix * vec4((1.5 + rise) * gl_Vertex.xyz, 1.0)");
  expectFailure(run(folder, {"render", "s.luxo.json", "-o", "a.png", "--size", "16x12"}), 3,
                "the vertex program moves the vertex");
}

TEST_F(CourseFiles, InspectTellsAttributesUniformsAndVaryings) {
  writeText(folder / "m.vert", kVertex);
  writeText(folder / "m.frag", kFragment);
  const Json json = Json::parse(run(folder, {"inspect", "m.frag", "--json"}).out);
  const auto listed = [&](const char* kind) {
    std::string text;
    for (const Json& one : json.at(kind))
      text += one.at("type").get<std::string>() + " " + one.at("name").get<std::string>() + "; ";
    return text;
  };
  EXPECT_EQ(listed("uniforms"), "vec3 paint; sampler2D skin; float time; ");
  EXPECT_EQ(listed("attributes"), "vec4 gl_Vertex; vec3 gl_Normal; vec3 tangent; ");
  EXPECT_EQ(listed("varyings"), "vec4 gl_Position; vec3 n; ");
  EXPECT_THAT(run(folder, {"inspect", "m.vert"}).out, HasSubstr("varyings\n"));
  const auto stages = [&](const char* kind) {
    std::string text;
    for (const Json& one : json.at(kind)) text += one.at("stages").dump() + " ";
    return text;
  };
  EXPECT_EQ(stages("attributes"), R"(["vertex"] ["vertex"] ["vertex"] )");
  EXPECT_EQ(stages("varyings"), R"(["vertex"] ["vertex","fragment"] )");
  EXPECT_EQ(json.at("stage"), "fragment");
  const Json vertex = Json::parse(run(folder, {"inspect", "m.vert", "--json"}).out);
  EXPECT_EQ(vertex.at("stage"), "vertex");
  for (const Json& one : vertex.at("uniforms")) EXPECT_EQ(one.at("stages").dump(), R"(["vertex"])");
}

}  // namespace
}  // namespace luxo::test
