// SPDX-License-Identifier: Apache-2.0
// Scene files as a user meets them: every mistake in one ends with exit code 3, a message that points at it,
// and no picture. Parameters, sweeps, built-in names.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "support/gpu_fixture.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;

/// A wave with a parameter; what the tests below break.
const char* const kWave = R"scene({
  "luxo": 1,
  "render": { "size": [64, 48] },
  "params": { "k": { "value": 3, "range": [1, 12], "step": 1 }, "half": "k/2" },
  "surfaces": { "wave": { "type": "formula", "u": [-1, 1], "v": [-1, 1], "position": ["u", "0.2*sin(k*u)", "v"] } },
  "nodes": [ { "surface": "wave" },
             { "rotate": { "axis": [1, 0, 0], "angle": "-60deg" }, "light": { "type": "directional" } } ]
}
)scene";

/// The wave with one part replaced.
std::string waveWith(const std::string& part, const std::string& instead) {
  std::string text = kWave;
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), instead);
}

class SceneFiles : public RenderTest {
 protected:
  /// Renders a file with that text and expects exit code 3, the words, and nothing but the file left behind.
  void expectBad(const std::string& text, const std::string& said) const {
    writeText(folder / "bad.luxo.json", text);
    const Outcome outcome = run(folder, {"render", "bad.luxo.json", "-o", "a.png"});
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(contains(outcome.err, said)) << outcome.err << "\nlacks: " << said;
    EXPECT_EQ(folder.entries(), 1u) << said;
  }
};

TEST_F(SceneFiles, MistakesAreShownWithTheirPlace) {
  const std::string wave = kWave;
  expectBad(wave.substr(0, wave.size() / 2), "bad.luxo.json:5:");
  expectBad(waveWith("\"size\": [64, 48]", "\"size\": \"large\""), "bad.luxo.json:3:");
  expectBad(waveWith("\"position\"", "\"postion\""), "did you mean 'position'?");
  expectBad(waveWith("\"half\"", "\"k\""), "bad.luxo.json:4:");
  expectBad(waveWith("\"surface\": \"wave\"", "\"surface\": \"wafe\""), "did you mean 'wave'?");
  expectBad(waveWith("\"value\": 3", "\"value\": \"half\""), "bad.luxo.json:4:");
  expectBad(waveWith("\"value\": 3", "\"value\": 13"), "12");
  expectBad(waveWith("sin(k*u)", "sin(uk)"), "'uk'");
  expectBad(waveWith("0.2*sin(k*u)", "log(-1-u^2)"), "bad.luxo.json:5:");
  expectBad(waveWith("\"u\": [-1, 1]", "\"u\": [1, 1]"), "bad.luxo.json:5:");
  expectBad(waveWith("[64, 48]", "[64, 1e999]"), "bad.luxo.json:3:");
  expectBad(waveWith("\"type\": \"formula\"", "\"type\": \"sphere\", \"radius\": 0, \"x-was\": 0"),
            "bad.luxo.json:5:");
  expectBad("\xff\xfe garbage", "bad.luxo.json:1:1");
  expectBad("", "bad.luxo.json:1:1");
}

/// It is not in the picture, in files as in the window, and nobody has to ask for more to be told.
TEST_F(SceneFiles, WhatALightSaysOfAnotherShadowIsTold) {
  const ScopedVariable x11("DISPLAY", nullptr), wayland("WAYLAND_DISPLAY", nullptr);
  const std::string said = "warning: map.luxo.json:8:",
                    what = "only a light whose shadow is \"map\" has a map";
  const auto told = [&](const std::string& light, const Arguments& command) {
    writeText(folder / "map.luxo.json",
              waveWith("\"directional\"", "\"directional\",\n\"shadow\": " + light));
    Arguments arguments{command.front(), "map.luxo.json"};
    arguments.insert(arguments.end(), command.begin() + 1, command.end());
    return run(folder, arguments).err;
  };
  const Arguments file{"render", "--engine", "reference", "--size", "9x9", "-o", "a.png"}, window{"view"};
  for (const Arguments& command : {file, window}) {
    const std::string err = told(R"("exact", "map": { "bias": 0.1 })", command);
    EXPECT_TRUE(contains(err, said) && contains(err, what)) << err;
    EXPECT_EQ(err.find("warning"), err.rfind("warning")) << err;
    EXPECT_FALSE(contains(told(R"("map", "map": { "bias": 0.1 })", command), "warning"));
    Arguments quiet = command;
    quiet.push_back("-q");
    EXPECT_FALSE(contains(told(R"("exact", "map": { "bias": 0.1 })", quiet), "warning"));
  }
}

TEST_F(SceneFiles, SizesHaveOneLimit) {
  for (const char* size : {"16385", "65536"}) {
    expectBad(waveWith("[64, 48]", fmt::format("[{}, 48]", size)),
              fmt::format("bad.luxo.json:3:24: this is {}; it must be a whole number from 1 to 16384", size));
    const std::string wave = waveWith("[64, 48]", fmt::format("[48, {}]", size));
    writeText(folder / "bad.luxo.json", wave);
    expectFailure(run(folder, {"render", "bad.luxo.json", "--engine", "reference", "-o", "a.png"}), 3,
                  "from 1 to 16384");
  }
}

TEST_F(SceneFiles, NumbersBeyondFloatAreRefusedWithTheirPlace) {
  const std::string red = R"("materials": { "red": { "diffuse": [1e39, 0, 0] } }, "surfaces")";
  expectBad(waveWith("\"surfaces\"", red), "bad.luxo.json:5:39: this is 1e+39; it must be from 0 to 1e18");
  expectBad(waveWith("\"directional\"", "\"directional\", \"intensity\": 1e38"), "this is 1e+38; it must be");
  // What a formula gives at a moment is shown with it.
  expectBad(waveWith("\"directional\"", "\"directional\", \"intensity\": \"sqrt(t-1)\""),
            "at time 0 this is not a number; it must be from 0 to 1e30");
  for (const char* color : {"1/t", "log(t-1)", "v*0 - 1 + 0*t", "1/t + 0*u"})
    expectBad(waveWith("\"surfaces\"",
                       fmt::format(R"("materials": {{ "red": {{ "diffuse": ["{}", 0, 0] }} }}, "surfaces")",
                                   color)),
              "bad.luxo.json:5:40: ");
}

TEST_F(SceneFiles, ArgumentsOfSurfacesAreShownOnce) {
  for (const auto& [radius, is] : {std::pair("1/t", "inf"), std::pair("sqrt(t-1)", "not a number")}) {
    writeText(folder / "bad.luxo.json",
              fmt::format(R"({{ "luxo": 1, "surfaces": {{ "s": {{ "type": "sphere", "radius": "{}" }} }}, )"
                          R"("nodes": [ {{ "surface": "s" }} ] }})",
                          radius));
    const std::string said = run(folder, {"render", "bad.luxo.json", "-o", "a.png"}).err;
    EXPECT_TRUE(contains(said, fmt::format("at time 0 this is {}; it must be finite", is))) << said;
    EXPECT_EQ(said.find("bad.luxo.json"), said.rfind("bad.luxo.json")) << said;
  }
}

TEST_F(SceneFiles, DepthAndSizeCrashNothing) {
  expectBad(std::string(1 << 20, '['), "bad.luxo.json:1:");
  expectBad(std::string(100 << 20, 'x'), "bad.luxo.json:1:1");
  std::string deep = "u";
  for (int i = 0; i < 10'000; ++i) deep = "(" + deep + ")";
  expectBad(waveWith("0.2*sin(k*u)", deep), "bad.luxo.json:5:");
  expectBad(
      R"({ "luxo": 1, "surfaces": { "s": { "type": "sphere", "radius": 1e308 } }, "nodes": [ { "surface": "s" } ] })",
      "radius");
}

TEST_F(SceneFiles, CirclesOfParametersNameTheOption) {
  writeText(folder / "wave.luxo.json", kWave);
  for (const char* circle : {"k=k", "k=half", "k=2*half+1"})
    expectFailure(run(folder, {"render", "wave.luxo.json", "-P", circle, "-o", "a.png"}), 2,
                  fmt::format("'-P {}': parameters need each other in a circle: ", circle),
                  "give one of them a value without the others");
}

TEST_F(SceneFiles, NodesWithoutANameAreNamedByTheirPlace) {
  expectBad(waveWith("\"rotate\":",
                     "\"children\": [{}, { \"scale\": [1, 1, 0], \"light\": { \"type\": "
                     "\"directional\" } }], \"rotate\":"),
            "node nodes[1].children[1] at time 0: its light has no direction");
}

TEST_F(SceneFiles, AllMistakesAtOnce) {
  writeText(folder / "bad.luxo.json",
            R"({ "luxo": 1, "nodes": [ { "surfac": "a" }, { "material": "b" }, 7 ] })");
  const Outcome outcome = run(folder, {"render", "bad.luxo.json", "-o", "a.png"});
  EXPECT_EQ(outcome.code, 3);
  for (const char* said : {"'surface'?", "'b'", "bad.luxo.json:1:65"})
    EXPECT_TRUE(contains(outcome.err, said)) << outcome.err << "\nlacks: " << said;
}

TEST_F(SceneFiles, WhatIsNoFile) {
  std::filesystem::create_directory(folder / "folder.luxo.json");
  for (const char* name : {"folder.luxo.json", "missing.luxo.json", "./missing"}) {
    const Outcome outcome = run(folder, {"render", name, "-o", "a.png"});
    EXPECT_EQ(outcome.code, 3) << name;
    EXPECT_TRUE(contains(outcome.err, name)) << outcome.err;
  }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST_F(SceneFiles, ParametersOnTheCommandLine) {
  writeText(folder / "wave.luxo.json", kWave);
  const auto refused = [&](const Arguments& extra, const std::string& said) {
    Arguments arguments = {"render", "wave.luxo.json", "-o", "a.png"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, said)) << outcome.err << "\nlacks: " << said;
  };
  refused({"-P", "hal=2"}, "did you mean 'half'?");
  refused({"-P", "k=13"}, "12");
  refused({"-P", "k=2+"}, "nothing on its right");
  refused({"--sweep", "hal=1:2:1"}, "did you mean 'half'?");
  refused({"--sweep", "k=0:2:1"}, "range from 1 to 12");
  EXPECT_EQ(folder.entries(), 1u);
}

class SceneFilePictures : public DeviceRenderTest {
 protected:
  [[nodiscard]] std::string picture(Arguments arguments) const {
    arguments.insert(arguments.end(), {"-q", "-o", "a.pfm"});
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return textOf(folder / "a.pfm");
  }
};

TEST_F(SceneFilePictures, SweptPicturesAreThoseOfTheirValues) {
  writeText(folder / "wave.luxo.json", kWave);
  const Outcome outcome = run(
      folder, {"render", "wave.luxo.json", "--sweep", "k=2:8:3", "-o", "s.pfm", "-q", "--report", "r.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json frames = Json::parse(textOf(folder / "r.json"))["frames"];
  ASSERT_EQ(frames.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const double k = 2 + 3 * i;
    EXPECT_EQ(frames[i]["frame"], i + 1);
    EXPECT_EQ(frames[i]["file"], fmt::format("s.{:04}.pfm", i + 1));
    EXPECT_EQ(frames[i]["parameters"]["k"], k);
    EXPECT_EQ(frames[i]["parameters"]["half"], k / 2);
    EXPECT_TRUE(textOf(folder / fmt::format("s.{:04}.pfm", i + 1)) ==
                picture({"render", "wave.luxo.json", "-P", fmt::format("k={}", k)}))
        << "k = " << k;
  }
  EXPECT_TRUE(picture({"render", "wave.luxo.json"}) == picture({"render", "wave.luxo.json", "-P", "k=6/2"}));
  EXPECT_FALSE(picture({"render", "wave.luxo.json"}) == picture({"render", "wave.luxo.json", "-P", "k=4"}));
}

TEST_F(SceneFilePictures, TheLampIsTheSameFromItsFileAndFromItsCode) {
  const std::string file = picture({"render", "luxo-grandpa", "--size", "64x36"});
  ASSERT_EQ(run({.arguments = {"--size", "64x36", "-q", "-o", "b.pfm"},
                 .folder = folder.path(),
                 .program = LUXO_LAMP_PROGRAM})
                .code,
            0);
  EXPECT_TRUE(file == textOf(folder / "b.pfm"));
}

TEST_F(SceneFilePictures, WhatOverflowsAlmostEverywhereIsAHole) {
  writeText(folder / "wave.luxo.json", waveWith("\"u\", \"0.2", "\"1e308*u*1e308\", \"0.2"));
  const Outcome outcome = run(folder, {"render", "wave.luxo.json", "-v", "-o", "a.png"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "hole")) << outcome.err;
}

TEST_F(SceneFilePictures, AHoleHurtsNobodyElse) {
  const auto withHole = [&](const std::string& formula) {
    writeText(folder / "hole.luxo.json",
              fmt::format(R"({{ "luxo": 1, "render": {{ "size": [64, 48], "ambient": 1 }},
    "surfaces": {{ "ball": {{ "type": "sphere", "radius": 1 }},
                   "odd": {{ "type": "formula", "u": [-1, 1], "v": [0, 1], "position": ["u+50", "{}", "v"] }} }},
    "nodes": [ {{ "surface": "ball" }}, {{ "surface": "odd" }} ], "camera": {{ "eye": [0, 0, 5] }} }})",
                          formula));
    return picture({"render", "hole.luxo.json"});
  };
  EXPECT_TRUE(withHole("0") == withHole("1/u")) << "the odd one is out of sight either way";
}

TEST_F(SceneFiles, BuiltinScenesAreListed) {
  const Outcome outcome = run(folder, {"render", "--list"});
  EXPECT_EQ(outcome.code, 0);
  for (const char* name : {"luxo-grandpa", "primitives", "teapot", "flag"})
    EXPECT_TRUE(contains(outcome.out, name)) << outcome.out;
}

}  // namespace
}  // namespace luxo::test
