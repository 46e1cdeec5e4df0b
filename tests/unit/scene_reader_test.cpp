// SPDX-License-Identifier: Apache-2.0
// Scene files: every kind of mistake with its line and column, all of them at once, and nothing that crashes.
#include "scene/scene_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/scene_builder.h"
#include "scene/scene_problems.h"
#include "scene/snapshot.h"
#include "scene_examples.h"

namespace luxo {
namespace {

/// What reading and building a text throws, or nothing.
std::string errorOf(const std::string& text) {
  try {
    const Scene scene = buildScene(parseScene(text, "s"));
    static_cast<void>(takeSnapshot(scene, scene.settings().time, {64, 64}));
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene) << error.what();
    return error.what();
  }
}

/// A scene with `members` in line 2.
std::string scene(std::string_view members) { return "{ \"luxo\": 1,\n" + std::string(members) + "\n}"; }

/// With `position` as the formulas of a surface, the first quote in column 1 of line 3.
std::string formula(std::string_view position, std::string_view more = {}) {
  return scene("\"surfaces\": { \"f\": { \"type\": \"formula\"" + std::string(more) + ", \"position\": [\n" +
               std::string(position) + "] } }");
}

struct Mistake {
  std::string text;
  std::string_view where;      ///< "line:column"
  std::string_view message;    ///< its beginning
  std::string_view help = {};  ///< a part of it
};

void expectAll(const std::vector<Mistake>& mistakes) {
  for (const auto& [text, where, message, help] : mistakes) {
    const std::string error = errorOf(text),
                      expected = "s:" + std::string(where) + ": " + std::string(message);
    EXPECT_EQ(error.substr(0, expected.size()), expected) << text << "\n" << error;
    EXPECT_EQ(error.find("\ns:"), std::string::npos) << "more than one error in\n" << text << "\n" << error;
    EXPECT_NE(error.find(help), std::string::npos) << error;
  }
}

TEST(SceneReader, AnEmptySceneIsAScene) { EXPECT_EQ(errorOf(scene("\"x-mine\": [1, 2]")), ""); }

TEST(SceneReader, PointsAtMistakesOfForm) {
  expectAll({
      {"[]", "1:1", "expected a scene: an object, found an array"},
      {"{}", "1:1", "a scene needs \"luxo\"", "write \"luxo\": 1 as the first key"},
      {"{ \"luxo\": 2 }", "1:11", "this luxo reads version 1 of the format, not 2"},
      {"{ \"luxo\": \"1\" }", "1:11", "expected the version of the format, found a text"},
      {scene("\"node\": []"), "2:1", "unknown key \"node\" in a scene", "did you mean 'nodes'?"},
      {scene("\"nodes\": {}"), "2:10", "expected an array of nodes, found an object"},
      {scene("\"nodes\": [5]"), "2:11", "expected a node: an object, found a number"},
      {scene("\"nodes\": [{ \"translate\": 5 }]"), "2:26", "expected an array of 3 numbers, found a number"},
      {scene("\"nodes\": [{ \"translate\": [1, 2] }]"), "2:26", "expected 3 numbers, found 2"},
      {scene("\"nodes\": [{ \"translate\": [1, 2, {}] }]"), "2:33",
       "expected a number or a formula, found an object"},
      {scene("\"nodes\": [{ \"translate\": [1, 2, true] }]"), "2:33",
       "expected a number or a formula, found true"},
      {scene("\"nodes\": [{ \"rotate\": { \"axis\": [0, 1, 0] } }]"), "2:23", "a rotation needs \"angle\""},
      {scene(R"("nodes": [{ "scale": 2 }])"), "2:22", "expected an array of 3 numbers, found a number",
       "write [2, 2, 2]"},
      {scene(R"("nodes": [{ "translate": "0, 1.5, -2" }])"), "2:26",
       "expected an array of 3 numbers, found a text", "write [0, 1.5, -2]"},
      {scene(R"("render": { "size": "1280x720" })"), "2:21", "expected an array of 2 numbers, found a text",
       "write [1280, 720]"},
      {scene(R"("nodes": [{ "rotate": { "axis": "y", "angle": 1 } }])"), "2:33",
       "expected an array of 3 numbers, found a text", "write [0, 1, 0]"},
      {scene(R"("nodes": [{ "rotate": { "axis": "-z", "angle": 1 } }])"), "2:33",
       "expected an array of 3 numbers, found a text", "write [0, 0, -1]"},
      {scene(R"("nodes": [{ "rotate": [0, 90, 0] }])"), "2:23",
       "expected an axis and an angle, found an array", R"(write { "axis": [0, 1, 0], "angle": "90deg" })"},
      {scene(R"("nodes": [{ "rotate": [-1.5, 0, 0] }])"), "2:23",
       "expected an axis and an angle, found an array", R"(write { "axis": [1, 0, 0], "angle": -1.5 })"},
      {scene(R"("nodes": [{ "rotate": [10, 20, 30] }])"), "2:23",
       "expected an axis and an angle, found an array", R"(write { "axis": [0, 1, 0], "angle": "90deg" })"},
      {scene(R"("nodes": [{ "rotate": 30 }])"), "2:23", "expected an axis and an angle, found a number",
       R"(write { "axis": )"},
      {scene(R"("nodes": [{ "surface": { "type": "sphere" } }])"), "2:24", "expected a name, found an object",
       "define it in \"surfaces\" and write its name here"},
      {scene(R"("nodes": [{ "material": { "diffuse": 1 } }])"), "2:25", "expected a name, found an object",
       "define it in \"materials\" and write its name here"},
      {scene("\"camera\": { \"eye\": [3, 3, 3, \"look_at\": [0, 0, 0] }"), "2:39",
       "expected ',' or ']', found ':'", "the '[' was opened at line 2, column 20"},
      {scene("\"nodes\": [{ \"scale\": [1, 1, 1 }]"), "2:31", "expected ',' or ']', found '}'",
       "the '[' was opened at line 2, column 22"},
      {scene("\"nodes\": [{ \"name\": 1 }]"), "2:21", "expected a name, found a number"},
      {scene("\"nodes\": [{ \"name\": \"\" }]"), "2:21", "a name is empty"},
      {scene("\"nodes\": [{ \"name\": \"a\" },\n{ \"name\": \"a\" }]"), "3:11", "two nodes have the name 'a'",
       "in line 2"},
      {scene("\"nodes\": [{ \"light\": { \"type\": \"spot\" } }]"), "2:32", "unknown word 'spot'",
       "a spot is a point light with a cone"},
      {scene("\"nodes\": [{ \"light\": { \"type\": \"pont\" } }]"), "2:32", "unknown word 'pont'", "'point'"},
      {scene("\"nodes\": [{ \"light\": { \"type\": \"area\" } }]"), "2:32", "unknown word 'area'",
       "one of point, directional"},
      {scene("\"nodes\": [{ \"light\": { \"shadow\": \"exakt\" } }]"), "2:34", "unknown word 'exakt'",
       "'exact'"},
      {scene("\"nodes\": [{ \"light\": { \"casters\": \"none\" } }]"), "2:35",
       "expected \"all\" or an array of node names"},
      {scene("\"materials\": { \"m\": 3 }"), "2:21", "expected a material: an object, found a number"},
      {scene("\"materials\": { \"m\": { \"color\": 3 } }"), "2:23", "unknown key \"color\" in a material"},
      {scene("\"materials\": { \"m\": { \"two_sided\": 1 } }"), "2:36", "expected true, false or \"auto\""},
      {scene("\"materials\": { \"m\": { \"diffuse\": \"#12345g\" } }"), "2:34", "'#12345g' is not a colour"},
      {scene("\"materials\": { \"m\": { \"diffuse\": {} } }"), "2:34", "expected a colour, found an object",
       "#rrggbb"},
      {scene(R"("materials": { "m": { "diffuse": "red" } })"), "2:34", "'red' is no colour and no parameter",
       "write a colour as \"#rrggbb\" or [r, g, b]"},
      {scene(R"("materials": { "m": { "specular": "gloos" } }, "params": { "gloss": 1 })"), "2:35",
       "'gloos' is no colour and no parameter", "did you mean 'gloss'?"},
      {scene(R"("render": { "background": "skyblue" })"), "2:27", "'skyblue' is no colour", "#rrggbb"},
      {scene(R"("materials": { "m": { "diffuse": "1 - red" } })"), "2:39", "unknown name 'red'"},
      {scene("\"materials\": { \"m\": { \"shading\": \"fong\" } }"), "2:34", "unknown word 'fong'",
       "gouraud, phong"},
      {scene("\"materials\": { \"m\": {}, \"m\": {} }"), "2:25", "the name \"m\" is given twice"},
      {scene("\"materials\": { \"\": {} }"), "2:16", "a name is empty"},
      {scene("\"materials\": []"), "2:14", "expected an object of names and what they stand for"},
      {scene("\"params\": { \"k\": [] }"), "2:18", "expected a number, a formula, or an object"},
      {scene("\"params\": { \"k\": { \"range\": [0, 1] } }"), "2:18", "a parameter needs \"value\""},
      {scene("\"surfaces\": { \"s\": 1 }"), "2:20", "expected a surface: an object, found a number"},
      {scene("\"surfaces\": { \"s\": {} }"), "2:20", "a surface needs \"type\"", "formula, revolve"},
      {scene("\"surfaces\": { \"s\": { \"type\": \"shpere\" } }"), "2:30", "unknown surface type 'shpere'",
       "'sphere'"},
      {scene("\"surfaces\": { \"s\": { \"type\": \"sphere\", \"radios\": 1 } }"), "2:40",
       "unknown key \"radios\" in a surface of type sphere", "'radius'"},
      {scene("\"surfaces\": { \"s\": { \"type\": \"rectangle\", \"size\": 1 } }"), "2:51",
       "expected an array of 2 numbers"},
      {scene("\"surfaces\": { \"s\": { \"type\": \"formula\" } }"), "2:20",
       "a formula surface needs \"position\""},
      {scene("\"surfaces\": { \"s\": { \"type\": \"mesh\" } }"), "2:20", "a mesh needs \"file\""},
      {scene(R"("surfaces": { "s": { "type": "mesh", "file": "a.obj", "normals": "round" } })"), "2:66",
       "unknown word 'round'", "smooth"},
      {scene(R"("surfaces": { "s": { "type": "cloth", "sides": 4 } })"), "2:39",
       "unknown key \"sides\" in a cloth"},
      {scene(R"("surfaces": { "s": { "type": "cloth", "pins": "back" } })"), "2:47",
       "expected an array of corners, edges and points [u, v]", "\"back_left\""},
      {scene(R"("surfaces": { "s": { "type": "cloth", "pins": ["back_lift"] } })"), "2:48",
       "unknown word 'back_lift'", "back_left"},
      {scene(R"("surfaces": { "s": { "type": "cloth", "ball": {} } })"), "2:47",
       "the ball of a cloth needs \"radius\""},
      {scene("\"surfaces\": { \"s\": { \"type\": \"bezier\", \"control_points\": [[]] } }"), "2:59",
       "a patch has 16 control points, this one 0"},
      {scene("\"surfaces\": { \"s\": { \"type\": \"bezier\", \"control_points\": [[0,0,0]], \"patches\": "
             "[[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1]] } }"),
       "2:112", "there is no control point 1"},
      {scene("\"camera\": { \"fov\": 1 }"), "2:13", "unknown key \"fov\" in a camera"},
      {scene("\"camera\": {}, \"cameras\": { \"camera\": {} }"), "2:28", "there are two cameras 'camera'"},
  });
}

/// A number is refused just outside its range, at its place, and taken at its end.
TEST(SceneReader, RangesOfNumbers) {
  struct Range {
    const char* place;  ///< of one number, "@"
    std::vector<const char*> in, out;
  };
  const Range ranges[] = {
      {R"("render": { "size": [@, 1] })", {"1", "16384"}, {"0", "-1", "16385", "65536", "1e300"}},
      {R"("render": { "size": [1, @] })", {"1", "16384"}, {"0", "16385", "\"2^16\""}},
      {R"("render": { "samples": @ })", {"1", "256"}, {"0", "257"}},
      {R"("render": { "fps": @ })", {"1e-6", "1e6"}, {"5e-324", "0.99e-6", "1.01e6", "-1"}},
      {R"("render": { "tolerance": @ })", {"1e-6", "1e6"}, {"5e-324", "0", "0.99e-6", "1.01e6", "1e308"}},
      {R"("render": { "background": [@, 0, 0] })", {"0", "1e18"}, {"-5e-324", "1.01e18", "1e39", "1e308"}},
      {R"("render": { "ambient": @ })", {"0", "1e18"}, {"-1", "1e39"}},
      {R"("materials": { "m": { "diffuse": [0, 0, @] } })", {"0", "1e18"}, {"-1", "1e39", "\"1e39\""}},
      {R"("materials": { "m": { "diffuse": ["u", 0, @] } })", {"0", "1e18"}, {"-1", "1e39", "\"1e39\""}},
      {R"("materials": { "m": { "diffuse": [0, "@+0*u", 0] } })", {"0", "1e18"}, {"-1", "1e39"}},
      {R"("materials": { "m": { "ambient": @ } })", {"0", "1e18"}, {"-1", "1e39"}},
      {R"("materials": { "m": { "specular": @ } })", {"0", "1e18"}, {"-1", "1e39"}},
      {R"("materials": { "m": { "shininess": @ } })", {"0", "1e18"}, {"-1", "1e39"}},
      {R"("materials": { "m": { "opacity": @ } })", {"0", "1"}, {"-5e-324", "1.0001"}},
      {R"("nodes": [{ "light": { "color": [@, 1, 1] } }])", {"0", "1e18"}, {"-1", "1e38", "1e39"}},
      {R"("nodes": [{ "light": { "intensity": @ } }])", {"0", "1e30"}, {"-1", "1e38", "1e39"}},
      {R"("nodes": [{ "light": { "radius": @ } }])", {"0", "1e9", "1e18"}, {"-1", "1e19", "1e39"}},
      {R"("nodes": [{ "light": { "type": "directional", "radius": @ } }])",
       {"0", "\"90deg\""},
       {"-1", "1.58", "1e9"}},
      {R"("nodes": [{ "light": { "spot": { "inner": @, "outer": "90deg" } } }])",
       {"0", "1.57"},
       {"-1", "1.58", "1e300", "\"90deg\""}},
      {R"("nodes": [{ "light": { "spot": { "outer": @ } } }])",
       {"1e-9", "\"90deg\""},
       {"0", "5e-324", "1e-10", "1.58", "1e300"}},
      {R"("nodes": [{ "light": { "shadow_samples": @ } }])", {"1", "1024"}, {"0", "2.5", "1025", "1e39"}},
      {R"("nodes": [{ "light": { "shadow": "map", "map": { "size": @ } } }])",
       {"1", "8192"},
       {"0", "2.5", "8193"}},
      {R"("nodes": [{ "translate": [@, 0, 0] }])", {"-1e18", "1e18"}, {"-1.01e18", "1.01e18", "1e308"}},
      {R"("nodes": [{ "scale": [1, @, 1] }])", {"-1e18", "0", "1e18"}, {"1.01e18", "1e308"}},
      {R"("camera": { "eye": [@, 0, 5] })", {"-1e18", "1e18"}, {"1.01e18"}},
      {R"("camera": { "look_at": [@, 0, 0] })", {"-1e18", "1e18"}, {"1.01e18"}},
      {R"("camera": { "near": @ })", {"1e-18", "1e18"}, {"0", "5e-324", "1.01e18"}},
      {R"("camera": { "fov_y": @ })", {"1e-9", "3.14159"}, {"0", "5e-324", "3.1416"}},
      {R"("camera": { "type": "orthographic", "height": @ })", {"1e-18", "1e18"}, {"0", "5e-324", "1e19"}},
      {R"("surfaces": { "s": { "type": "sphere", "radius": @ } })", {"1e-12", "1e12"}, {"5e-324", "1e13"}},
  };
  for (const auto& [place, in, out] : ranges) {
    const auto with = [where = std::string(place)](const std::string& number) {
      std::string text = where;
      return "{ \"luxo\": 1,\n" + text.replace(text.find('@'), 1, number) + " }";
    };
    for (const char* number : in) {
      SCOPED_TRACE(with(number));
      EXPECT_NO_THROW(static_cast<void>(buildScene(parseScene(with(number), "s"))));
    }
    for (const char* number : out) {
      SCOPED_TRACE(with(number));
      try {
        static_cast<void>(buildScene(parseScene(with(number), "s")));
        ADD_FAILURE() << "taken";
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Scene);
        EXPECT_TRUE(std::string(error.what()).starts_with("s:2:")) << error.what();
        EXPECT_NE(std::string(error.what()).find("must be"), std::string::npos) << error.what();
      }
    }
  }
}

TEST(SceneReader, PointsAtMistakesOfMeaning) {
  expectAll({
      {scene("\"nodes\": [{ \"surface\": \"bal\" }], \"surfaces\": { \"ball\": { \"type\": \"sphere\" } }"),
       "2:24", "there is no surface 'bal'", "'ball'"},
      {scene("\"nodes\": [{ \"surface\": \"ball\" }]"), "2:24", "there is no surface 'ball'",
       "the scene has no surfaces"},
      {scene("\"nodes\": [{ \"material\": \"rde\" }], \"materials\": { \"red\": {} }"), "2:25",
       "there is no material 'rde'", "'red'"},
      {scene("\"nodes\": [{ \"light\": { \"casters\": [\"x\"] } }]"), "2:36", "there is no node 'x'"},
      {scene("\"nodes\": [{ \"translate\": [0, \"1/0\", 0] }]"), "2:31", "this is inf; it must be finite"},
      {scene("\"nodes\": [{ \"translate\": [0, \"sqrt(-1)\", 0] }]"), "2:31",
       "this is not a number; it must be finite"},
      {scene("\"nodes\": [{ \"translate\": [0, \"1 + u\", 0] }]"), "2:35", "'u' is not known here",
       "only surfaces"},
      {scene("\"nodes\": [{ \"translate\": [0, \"2*tt\", 0] }]"), "2:33", "unknown name 'tt'"},
      {scene("\"nodes\": [{ \"rotate\": { \"axis\": [0, 0, 0], \"angle\": 1 } }]"), "2:23",
       "a rotation about a zero axis"},
      {scene("\"nodes\": [{ \"light\": { \"intensity\": -1 } }]"), "2:37",
       "this is -1; it must be from 0 to 1e30"},
      {scene("\"materials\": { \"m\": { \"opacity\": \"1 + 1\" } }"), "2:35",
       "this is 2; it must be from 0 to 1"},
      {scene("\"materials\": { \"m\": { \"diffuse\": [0, \"-1\", 0] } }"), "2:39",
       "this is -1; it must be from 0 to 1e18"},
      {scene("\"materials\": { \"m\": { \"diffuse\": [0, \"1/(u-u)\", \"v\"] } }"), "2:39",
       "this is inf; it must be from 0 to 1e18"},
      {scene("\"materials\": { \"m\": { \"ambient\": [\"u\", 0, 0] } }"), "2:36", "'u' is not known here",
       "diffuse"},
      {scene("\"surfaces\": { \"s\": { \"type\": \"sphere\", \"radius\": 0 } }"), "2:50",
       "sphere: radius is 0"},
      {scene("\"surfaces\": { \"s\": { \"type\": \"sphere\", \"radius\": 1e308 } }"), "2:50",
       "sphere: radius is 1e+308"},
      {scene("\"surfaces\": { \"s\": { \"type\": \"torus\", \"major\": 1, \"minor\": 2 } }"), "2:30",
       "torus: its arguments do not go together"},
      {scene("\"surfaces\": { \"s\": { \"type\": \"sphere\", \"segments\": [0, 4] } }"), "2:53",
       "this is 0; it must be a whole number from 1"},
      {scene("\"camera\": { \"fov_y\": \"180deg\" }"), "2:23", "this is 3.14159"},
      {scene("\"camera\": { \"fov_y\": 50 }"), "2:22", "this is 50 radians; it must be from 1e-9 to below pi",
       "write \"50deg\""},
      {scene("\"camera\": { \"type\": \"orthographic\", \"height\": 0 }"), "2:47",
       "this is 0; it must be from 1e-18 to 1e18"},
      {scene("\"render\": { \"size\": [1.5, 1] }"), "2:22", "this is 1.5; it must be a whole number from 1"},
      {scene("\"render\": { \"time\": \"t\" }"), "2:22", "this is read once: it cannot depend on t"},
      {scene("\"render\": { \"fps\": 0 }"), "2:20", "this is 0; it must be from 1e-6 to 1e6"},
      {scene("\"params\": { \"k\": { \"value\": 13, \"range\": [1, 12] } }"), "2:29",
       "parameter 'k' is 13, outside its range from 1 to 12"},
      {scene("\"params\": { \"k\": { \"value\": 1, \"range\": [2, 1] } }"), "2:42",
       "the range from 2 to 1 is empty"},
      {scene("\"params\": { \"k\": { \"value\": 1, \"range\": [0, \"a\"] }, \"a\": 2 }"), "2:46",
       "this cannot depend on t or on parameters"},
      {scene("\"params\": { \"k\": { \"value\": 1, \"step\": 0 } }"), "2:40",
       "this is 0; it must be finite and above 0"},
      {scene("\"params\": { \"k\": \"log(-1)\" }"), "2:18", "parameter 'k' is "},
      {scene("\"params\": { \"t\": 1 }"), "2:13", "the name 't' is taken"},
      {scene("\"params\": { \"cos\": 1 }"), "2:13", "'cos' is the name of a function"},
      {scene("\"params\": { \"a b\": 1 }"), "2:13", "'a b' cannot be a name"},
      {scene("\"params\": { \"a\": \"b\", \"b\": \"c + 1\", \"c\": \"2a\" }"), "2:18",
       "parameters need each other in a circle: a -> b -> c -> a"},
      {scene("\"params\": { \"a\": \"a\" }"), "2:18", "parameters need each other in a circle: a -> a"},
  });
}

TEST(SceneReader, PointsIntoFormulas) {
  expectAll({
      {formula("\"uv\", \"v\", \"0\""), "3:2", "unknown name 'uv'", "u*v"},
      {formula("\"u\", \"sin(v\", \"0\""), "3:10", "this '(' is never closed"},
      {formula("\"u\", \"v\", \"foo(u)\""), "3:12", "unknown function 'foo'"},
      {formula("\"1/0\", \"1/0\", \"0\""), "2:15", "surface 'f' "},
      {formula("\"1\", \"2\", \"3\""), "2:15", "surface 'f' "},
      {formula("\"log(-1 - u^2)\", \"v\", \"0\""), "2:15", "surface 'f' "},
      {formula("\"u\", \"v\", \"0\"", ", \"u\": [1, 1]"), "2:47", "the range from 1 to 1 is empty"},
      {formula("\"u\", \"v\", \"0\"", ", \"u\": [1e12, -2.5e-10]"), "2:47",
       "the range from 1e+12 to -2.5e-10 is empty"},
      {formula("\"u\", \"v\", \"0\"", ", \"u\": [1, \"-pi\"]"), "2:47", "the range from 1 to -3.14",
       "the smaller number first"},
      {formula("\"u\", \"v\", \"0\"", ", \"v\": [0, \"u\"]"), "2:51", "'u' is not known here",
       "a range cannot depend on it"},
      {formula("\"u\", \"v\", \"0\"", ", \"closed\": [true, false]"), "2:51",
       "the surface is not closed in u"},
      {formula("\"u\", \"v\", \"abs(u - 0.5)\"", ", \"closed\": [true, false]"), "2:51",
       "the surface is not closed in u"},
      {formula("\"u\", \"v\", \"a\"", ", \"let\": { \"a\": \"b\", \"b\": \"a\" }"), "2:66",
       "'a' depends on itself"},
      {formula("\"u\", \"v\", \"0\"", ", \"let\": { \"u\": \"1\" }"), "2:50", "the name 'u' is taken"},
      {scene("\"surfaces\": { \"s\": { \"type\": \"revolve\", \"radius\": \"1 + u\", \"height\": \"v\" } }"),
       "2:56", "'u' is not known here", "a profile depends on v alone"},
      {scene(
           "\"surfaces\": { \"s\": { \"type\": \"tube\", \"radius\": 0.1, \"curve\": [\"u\", \"v\", 0] } }"),
       "2:68", "the curve of a tube cannot depend on v"},
  });
}

TEST(SceneReader, BothRangesOfASurfaceAreReported) {
  const std::string error = errorOf(formula("\"u\", \"v\", \"0\"", R"(, "u": [1, 0], "v": [3, 2])"));
  EXPECT_NE(error.find("s:2:47: the range from 1 to 0 is empty"), std::string::npos) << error;
  EXPECT_NE(error.find("s:2:60: the range from 3 to 2 is empty"), std::string::npos) << error;
}

TEST(SceneReader, ColoursMayBeParametersWithTheNamesOfColours) {
  EXPECT_EQ(errorOf(scene(R"("render": { "background": "red" }, "params": { "red": 0.5 },
    "materials": { "m": { "diffuse": "red", "specular": "e" }, "n": { "diffuse": "u", "specular": "t" } })")),
            "");
}

TEST(SceneReader, EscapesInAFormulaPointAtAllOfIt) {
  expectAll({{formula("\"\\u0075v\", \"v\", \"0\""), "3:1", "unknown name 'uv'"}});
}

TEST(SceneReader, ShadowMapsHaveTheirOwnKeys) {
  const auto light = [](const char* map) {
    return scene(fmt::format(R"("nodes": [{{ "light": {{ "shadow": "map", "map": {} }} }}])", map));
  };
  EXPECT_EQ(errorOf(light(R"({ "size": 512, "bias": 0.01, "slope_bias": "1 + 0.5t", "normal_offset": 2,
                               "pcf": 5, "receiver_plane": true })")),
            "");
  for (const auto& [map, said] : {std::pair{R"({ "pcf": 4 })", "it must be odd"},
                                  {R"({ "size": 8193 })", "from 1 to 8192"},
                                  {R"({ "bias": -1 })", "from 0 to 1e18"},
                                  {R"({ "sise": 1 })", "unknown key \"sise\" in a shadow map"},
                                  {R"({ "receiver_plane": 1 })", "receiver_plane"},
                                  {"3", "a shadow map"}})
    EXPECT_NE(errorOf(light(map)).find(said), std::string::npos) << map << ": " << errorOf(light(map));
}

TEST(SceneReader, ReportsEverythingAtOnceInTheOrderOfTheFile) {
  const std::string error = errorOf(R"_({ "luxo": 1,
    "params": { "k": "k2 +" },
    "materials": { "m": { "shinyness": 1 } },
    "surfaces": { "s": { "type": "sphere", "radius": [] } },
    "nodes": [ { "surface": "r", "translate": [0, 0] },
               { "visible": "if(t)" ,} ]
  })_");
  std::size_t at = 0;
  for (const char* const line : {"s:2:", "s:3:27", "s:4:54", "s:5:29", "s:5:47", "s:6:30", "s:6:37"}) {
    const std::size_t next = error.find(line, at);
    ASSERT_NE(next, std::string::npos) << line << " is missing or too early in\n" << error;
    at = next + 1;
  }
}

TEST(SceneReader, ASurfaceThatCannotBeReadIsStillThere) {
  const std::string error = errorOf(
      scene("\"surfaces\": { \"s\": { \"type\": \"shpere\" } },\n\"nodes\": [{ \"surface\": \"s\" }]"));
  EXPECT_EQ(error.find("there is no surface"), std::string::npos) << error;
}

TEST(SceneReader, ShowsTwentyErrorsAndCountsTheOthers) {
  std::string nodes = "\"nodes\": [";
  for (int i = 0; i < 57; ++i) nodes += "{ \"surface\": \"none\" },\n";
  const std::string error = errorOf(scene(nodes + "{}]"));
  std::size_t shown = 0;
  for (std::size_t at = 0; (at = error.find("there is no surface", at)) != std::string::npos; ++at) ++shown;
  EXPECT_EQ(shown, kMaxShownProblems);
  EXPECT_TRUE(error.ends_with("\nand 37 more errors")) << error;
}

TEST(SceneReader, LongNamesAndManyMistakesStayShort) {
  const std::string name(2'000'000, 'x');
  for (const std::string& members :
       {"\"" + name + "\": 1", name + ": 1", "'" + name + "': 1",
        "\"params\": { \"" + name + "\": \"" + name + "\" }",
        "\"nodes\": [{ \"surface\": \"" + name + "\" }], \"surfaces\": { \"s\": {} }"}) {
    const std::string error = errorOf(scene(members));
    EXPECT_FALSE(error.empty());
    EXPECT_LT(error.size(), 20000u);
  }
  std::string nodes = "\"surfaces\": { ";
  for (int i = 0; i < 100; ++i) nodes += fmt::format("\"s{}\": {{ \"type\": \"sphere\" }}, ", i);
  nodes += "\"s\": { \"type\": \"sphere\" } }, \"nodes\": [";
  for (int i = 0; i < 6000; ++i) nodes += "{ \"surface\": \"none\" }, ";
  EXPECT_TRUE(errorOf(scene(nodes + "{}]")).ends_with("\nand 5980 more errors"));
}

// Memory goes to nodes alone, and no more of it than the limit allows.
TEST(SceneReader, NodesAndParametersHaveLimits) {
  std::string fives, params;
  for (int i = 0; i < 3'000'000; ++i) fives += "5,";
  const std::string error = errorOf(scene("\"nodes\": [" + fives + "5]"));
  EXPECT_TRUE(error.ends_with("\nand 2999981 more errors"));
  for (std::size_t i = 0; i <= kMaxSceneParameters; ++i) params += fmt::format("\"p{}\": {},", i, i);
  EXPECT_NE(errorOf(scene("\"params\": { " + params + "\"x-\": 0 }"))
                .find("the scene has more than 4096 parameters"),
            std::string::npos);
}

TEST(SceneReader, DeepHierarchiesHaveALimit) {
  const auto nested = [](int depth) {
    std::string text = "\"nodes\": [";
    for (int i = 0; i < depth; ++i) text += "{ \"children\": [";
    for (int i = 0; i < depth; ++i) text += "] }";
    return scene(text + "]");
  };
  EXPECT_EQ(errorOf(nested(250)), "");
  EXPECT_NE(errorOf(nested(300)).find("nested more than 512 deep"), std::string::npos);
  EXPECT_NE(errorOf(nested(100000)).find("nested more than 512 deep"), std::string::npos);
}

TEST(SceneReader, ChainsOfParametersMayBeLong) {
  std::string params = "\"params\": { \"p0\": 1";
  for (int i = 1; i < 2000; ++i) params += fmt::format(", \"p{}\": \"p{} + 1\"", i, i - 1);
  EXPECT_EQ(errorOf(scene(params + "}")), "");
}

TEST(SceneReader, EveryTruncationOfASceneIsAnError) {
  const std::string whole = test::sourceText("apps/scenes/flag.luxo.json");
  EXPECT_EQ(errorOf(whole), "");
  const std::size_t last = whole.find_last_of('}');
  for (std::size_t size = 0; size <= last; ++size) {
    EXPECT_THROW(static_cast<void>(parseScene(whole.substr(0, size), "cut")), Error) << size;
  }
}

TEST(SceneReader, GarbageIsAnError) {
  std::mt19937_64 random(7);
  for (const std::size_t size : {1u, 100u, 10000u, 20000000u}) {
    std::string bytes(size, '\0'), letters(size, '\0');
    for (std::size_t i = 0; i < size; ++i) {
      const auto bits = static_cast<unsigned>(random());
      bytes[i] = static_cast<char>(bits);
      letters[i] = R"({}[]",:0123456789abctrue -.e+)"[bits % 29];
    }
    EXPECT_THROW(static_cast<void>(parseScene(std::move(bytes), "bytes")), Error);
    EXPECT_THROW(static_cast<void>(parseScene(std::move(letters), "letters")), Error);
  }
}

TEST(SceneReader, OneChangedByteNeverCrashes) {
  const std::string whole = test::sourceText("apps/scenes/flag.luxo.json");
  std::mt19937_64 random(11);
  for (int i = 0; i < 400; ++i) {
    std::string changed = whole;
    changed[random() % changed.size()] = R"({}[]",:'0-.e+*/(u t)"[random() % 20];
    try {
      static_cast<void>(buildScene(parseScene(changed, "changed")));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Scene);
      EXPECT_FALSE(std::string_view(error.what()).empty());
    }
  }
}

TEST(SceneReader, FilesThatCannotBeReadSaySo) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const auto expectError = [](const std::filesystem::path& path, std::string_view text) {
    try {
      static_cast<void>(readSceneFile(path));
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Scene);
      EXPECT_NE(std::string_view(error.what()).find(path.string()), std::string_view::npos) << error.what();
      EXPECT_NE(std::string_view(error.what()).find(text), std::string_view::npos) << error.what();
    }
  };
  expectError(folder, "it is a directory");
  expectError(folder / "no such scene.luxo.json", "there is no such file");
  expectError(std::string(5000, 'x'), "ame too long");
}

TEST(SceneReader, ReadsTheExamples) {
  for (const std::filesystem::path& path : test::exampleScenes()) {
    try {
      const SceneFile file = readSceneFile(path);
      EXPECT_EQ(file.source.name, path.string());
      EXPECT_FALSE(file.nodes.empty()) << path;
      static_cast<void>(buildScene(file));
    } catch (const Error& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

}  // namespace
}  // namespace luxo
