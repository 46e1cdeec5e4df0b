// SPDX-License-Identifier: Apache-2.0
// `luxo verify`: what it says of pictures whose error is bounded otherwise, and what it refuses.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "cli/program.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;

class VerifyTest : public testing::Test {
 protected:
  [[nodiscard]] Outcome verify(Arguments arguments) const {
    arguments.insert(arguments.begin(), "verify");
    return run(folder, arguments);
  }
  /// Of a mesh.
  [[nodiscard]] Json numbersOf(Arguments arguments) const {
    arguments.insert(arguments.end(), {"--json", "--shading", "phong"});
    const Outcome outcome = verify(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }

  ScratchFolder folder;
};

class VerifyPictureTest : public VerifyTest {
 protected:
  void SetUp() override { requireDevice(); }
};

TEST_F(VerifyPictureTest, AMeshIsAsFarOffAsItsBoundAllows) {
  const Json json = numbersOf({"sphere", "--size", "90x70"});
  const double bound = json["picture"]["bound_px"];
  EXPECT_GT(bound, 0.01);
  EXPECT_LE(json["position_px"]["max"], bound);
  EXPECT_GT(json["position_px"]["max"], bound / 20) << "bounds are that tight";
  EXPECT_LE(json["position_px"]["p99"], json["position_px"]["p99.9"]);
  EXPECT_LE(json["coverage"]["farthest_px"], bound);
  EXPECT_EQ(json["coverage"]["compared"], 90 * 70);
  EXPECT_EQ(json["coverage"]["wrong_layer"], 0);
  EXPECT_EQ(json["nan_pixels"], 0);
  EXPECT_LT(json["position_px"]["floor"], 1e-4);
  for (const char* metric :
       {"parameter_px", "point_px", "depth_ulp", "normal_deg", "normal_inside_deg", "light"})
    EXPECT_GT(json[metric]["max"], json[metric]["floor"]) << metric;
  EXPECT_EQ(json["position_px"]["worst"][0]["name"], "sphere");
  EXPECT_EQ(json["position_px"]["worst"][0]["error"], json["position_px"]["max"]);
  EXPECT_GT(json["color"]["psnr_linear"], 50);
  EXPECT_GT(json["color"]["flip"]["mean"], 0);
}

TEST_F(VerifyPictureTest, ASmallerToleranceIsASmallerError) {
  const Json coarse = numbersOf({"torus", "--size", "80x60", "--tolerance", "1"}),
             fine = numbersOf({"torus", "--size", "80x60", "--tolerance", "0.05"});
  EXPECT_LT(fine["position_px"]["max"], coarse["position_px"]["max"]);
  EXPECT_LE(fine["coverage"]["farthest_px"], 0.05);
  EXPECT_GT(fine["color"]["psnr_srgb"], coarse["color"]["psnr_srgb"]);
}

TEST_F(VerifyPictureTest, ARequirementDecidesTheExitCode) {
  const Arguments sphere = {"sphere", "--size", "60x60", "--shading", "phong", "--tolerance", "0.5"};
  Arguments enough = sphere, tooMuch = sphere;
  enough.insert(enough.end(), {"--require-error", "0.5px"});
  tooMuch.insert(tooMuch.end(), {"--require-error", "0.0001px"});
  EXPECT_EQ(verify(enough).code, 0);
  const Outcome missed = verify(tooMuch);
  EXPECT_EQ(missed.code, 6);
  EXPECT_TRUE(contains(missed.err, "more than the 0.0001 px required")) << missed.err;
  EXPECT_TRUE(contains(missed.out, "position on screen")) << "the numbers are printed all the same";
}

TEST_F(VerifyPictureTest, SomePixelsAreJudgedAlone) {
  const Json json = numbersOf({"flag", "--size", "200x150", "--pixels", "300"});
  EXPECT_LE(json["coverage"]["compared"], 300);
  EXPECT_GT(json["coverage"]["compared"], 280);
  EXPECT_TRUE(json["color"]["flip"].is_null());
  EXPECT_EQ(numbersOf({"flag", "--size", "40x30", "--pixels", "1e9"})["coverage"]["compared"], 40 * 30);
}

/// The light of 40 lights on a mesh is not drawn one by one; of 2 it is.
TEST_F(VerifyPictureTest, WhatIsNotJudgedIsTold) {
  const auto scene = [&](int lights) {
    writeText(folder / "soft.json", R"({ "luxo": 1, "materials": { "m": { "diffuse": [0.7, 0.6, 0.5] } },
      "surfaces": { "ball": { "type": "sphere", "radius": 1 }, "floor": { "type": "rectangle", "size": [9, 9] } },
      "camera": { "eye": [3, 3, 4], "look_at": [0, 0, 0] },
      "nodes": [ { "surface": "ball", "material": "m" },
                 { "surface": "floor", "material": "m", "translate": [0, -1, 0] },
                 { "translate": [4, 4, 2], "light": { "shadow": "exact", "radius": 0.3, "shadow_samples": )" +
                                        std::to_string(lights) + " } } ] }");
    return numbersOf({"soft.json", "--size", "60x45"})["color"]["unjudged"];
  };
  EXPECT_GT(scene(40), 100);
  EXPECT_EQ(scene(2), 0);
}

/// Of triangles in flat and Gouraud shading, too, whose colours the truth does not have, lights are judged:
/// those of coarse depth maps are not the truth's.
TEST_F(VerifyPictureTest, LightsOnTrianglesAreJudgedInEveryShading) {
  std::string model;  // rings of a cone, one over the other
  constexpr int kAround = 12;
  for (int ring = 0; ring < 3; ++ring)
    for (int i = 0; i < kAround; ++i)
      model += "v " + std::to_string((1.2 - 0.4 * ring) * std::cos(i * 0.5236)) + " " +
               std::to_string(0.5 * ring) + " " + std::to_string(-(1.2 - 0.4 * ring) * std::sin(i * 0.5236)) +
               "\n";
  for (int ring = 0; ring < 2; ++ring)
    for (int i = 0; i < kAround; ++i) {
      const int a = ring * kAround + i + 1, b = ring * kAround + (i + 1) % kAround + 1;
      model += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + kAround) + " " +
               std::to_string(a + kAround) + "\n";
    }
  writeText(folder / "cone.obj", model);
  const auto wrongLights = [&](const std::string& shadow, const std::string& shading) {
    writeText(folder / "cones.json", R"({ "luxo": 1, "camera": { "eye": [3, 3, 5], "look_at": [0, 0.7, 0] },
      "nodes": [ { "model": "cone.obj" }, { "model": "cone.obj", "translate": [0.7, 1.1, 0.3] },
                 { "translate": [3, 5, 1], "light": )" +
                                         shadow + " } ] }");
    const Outcome outcome = verify({"cones.json", "--size", "80x60", "--json", "--shading", shading});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const Json json = Json::parse(outcome.out, nullptr, false);
    EXPECT_EQ(json["color"]["unjudged"], 0) << shading;
    return json["wrong"]["light"].get<int>();
  };
  for (const char* shading : {"flat", "gouraud", "phong", "exact"}) {
    EXPECT_EQ(wrongLights(R"({ "shadow": "exact" })", shading), 0) << shading;
    EXPECT_GT(wrongLights(R"({ "shadow": "map", "map": { "size": 32, "bias": 0.01 } })", shading), 50)
        << shading;
  }
}

/// What a depth map has too much and too little is told; a scene of exact shadows has no such numbers.
TEST_F(VerifyPictureTest, SpotsAreRightInEveryShading) {
  writeText(folder / "spots.json", R"({ "luxo": 1, "render": { "ambient": 0.1 },
    "materials": { "m": { "diffuse": [0.6, 0.5, 0.4], "specular": 0.3 } },
    "surfaces": { "floor": { "type": "rectangle", "size": [12, 12] }, "ball": { "type": "sphere", "radius": 0.7 },
                  "ring": { "type": "torus", "major": 0.8, "minor": 0.3 } },
    "camera": { "eye": [1, 7, 6], "look_at": [0.4, 0, 0], "fov_y": "50deg" },
    "nodes": [ { "surface": "floor", "material": "m" }, { "surface": "ball", "material": "m", "translate": [1, 1, 0] },
               { "surface": "ring", "material": "m", "translate": [-1, 0.8, 0.5] },
               { "translate": [0, 4, 0], "rotate": { "axis": [1, 0, 0], "angle": "-90deg" },
                 "light": { "spot": { "inner": "15deg", "outer": "30deg" }, "shadow": "exact" } },
               { "translate": [-3, 1, 3], "rotate": { "axis": [0, 1, 0], "angle": "-40deg" },
                 "light": { "color": [0.2, 0.5, 1], "spot": { "outer": "25deg" } } } ] })");
  for (const char* shading : {"flat", "gouraud", "phong", "exact", "toon"}) {
    const Outcome outcome = verify({"spots.json", "--size", "120x90", "--json", "--shading", shading});
    ASSERT_EQ(outcome.code, 0) << shading << outcome.err;
    const Json json = Json::parse(outcome.out);
    // Meshes are off their surfaces, which is no matter of light.
    EXPECT_EQ(json["wrong"][std::string(shading) == "exact" ? "pixels" : "light"], 0)
        << shading << outcome.out;
    if (std::string(shading) == "exact") {
      EXPECT_GT(json["color"]["psnr_linear"], 110) << outcome.out;
    }
  }
}

TEST_F(VerifyPictureTest, ShadowsOfMapsAreTooManyOrTooFew) {
  const auto write = [&](const std::string& shadow) {
    writeText(folder / "ball.json", R"({ "luxo": 1, "camera": { "eye": [3, 4, 5], "look_at": [0, 0.5, 0] },
      "surfaces": { "ball": { "type": "sphere" }, "floor": { "type": "rectangle", "size": [9, 9] } },
      "nodes": [ { "surface": "ball", "translate": [0, 1.5, 0] }, { "surface": "floor" },
                 { "translate": [-3, 6, 1], "light": )" +
                                        shadow + " } ] }");
  };
  const auto wrong = [&](const std::string& shadow) {
    write(shadow);
    return numbersOf({"ball.json", "--size", "80x60"})["wrong"];
  };
  const Json biased = wrong(R"({ "shadow": "map", "map": { "size": 64, "bias": 1000 } })"),
             acne = wrong(R"({ "shadow": "map", "map": { "size": 64 } })"),
             exact = wrong(R"({ "shadow": "exact" })");
  EXPECT_EQ(biased["shadow_extra"], 0);
  EXPECT_GT(biased["shadow_missing"], 100);
  EXPECT_GT(acne["shadow_extra"], 50);
  EXPECT_EQ(acne["shadow_extra"].get<int>() + acne["shadow_missing"].get<int>(), acne["light"].get<int>());
  EXPECT_TRUE(exact["shadow_extra"].is_null() && exact["shadow_missing"].is_null()) << exact;
  write(R"({ "shadow": "map", "map": { "size": 64, "bias": 1000 } })");
  const Outcome text = verify({"ball.json", "--size", "80x60", "--shading", "phong"});
  EXPECT_TRUE(contains(text.out, "\n           0 pixels are dark that are lit in truth (extra), " +
                                     std::to_string(biased["shadow_missing"].get<int>()) +
                                     " lit that are dark (missing)\n"))
      << text.out;
}

TEST_F(VerifyPictureTest, WritesTheHeatMapAndTheReport) {
  const Outcome outcome =
      verify({"thin-torus", "--size", "120x80", "-o", "heat.png", "--report", "r.json", "-q"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(contains(outcome.out, "coverage")) << outcome.out;
  EXPECT_EQ(folder.entries(), 2U);
  EXPECT_TRUE(std::filesystem::exists(folder / "heat.png"));
  const Json json = Json::parse(textOf(folder / "r.json"));
  EXPECT_EQ(json["scene"], "thin-torus");
  EXPECT_EQ(json["size"], Json({120, 80}));
}

// Each is another place, and the picture is as right there.
TEST_F(VerifyPictureTest, EverySampleOfAPixelIsHeldAgainstTheTruth) {
  std::set<std::uint64_t> covered;
  for (const char* sample : {"0", "1", "2", "3"}) {
    const Outcome outcome =
        verify({"teapot", "--size", "96x72", "--samples", "4", "--sample", sample, "--json", "-q"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["wrong"]["hit_miss"], 0) << sample;
    EXPECT_EQ(json["wrong"]["layer"], 0) << sample;
    EXPECT_EQ(json["wrong"]["point"], 0) << sample;
    covered.insert(json["coverage"]["covered"].get<std::uint64_t>());
    for (const char* counted :
         {"resolved_by_rays_px", "shadow_rays_px", "audited_px", "audit_failed_px", "audit_undecided_px"})
      EXPECT_TRUE(json["picture"][counted].is_number_unsigned()) << counted;
    EXPECT_GE(json["picture"]["audited_px"], 64) << "the fewest";
  }
  EXPECT_GT(covered.size(), 1U);
}

TEST_F(VerifyPictureTest, AReportToDashIsPrinted) {
  const Outcome outcome = verify({"sphere", "--size", "30x20", "--report", "-", "-q"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(Json::parse(outcome.out)["size"], Json({30, 20}));
  EXPECT_EQ(folder.entries(), 0U);
}

TEST_F(VerifyPictureTest, TheStabilitySuiteRunsByName) {
  EXPECT_EQ(verify({"--stability", "ST-99"}).code, 2);
}

TEST_F(VerifyTest, WithoutNamesTheWholeStabilitySuiteRuns) {
  expectFailure(verify({"--stability", "--device", "nosuch"}), 4, "nosuch");  // its first case wants a device
}

TEST_F(VerifyTest, Refusals) {
  const auto refused = [&](const Arguments& arguments, int code, const std::string& said) {
    expectFailure(verify(arguments), code, said);
    EXPECT_EQ(folder.entries(), 0U);
  };
  refused({}, 2, "no scene is given");
  refused({"sphere", "--pixels", "0"}, 2, "--pixels '0'");
  refused({"sphere", "--pixels", "2.5"}, 2, "--pixels '2.5'");
  refused({"sphere", "--require-error", "0"}, 2, "--require-error '0'");
  refused({"sphere", "--samples", "4"}, 2, "of a scene's samples one is judged at a time");
  refused({"sphere", "--samples", "4", "--sample", "4"}, 2, "there is no sample 4 of 4");
  refused({"sphere", "--sample", "-1"}, 2, "--sample '-1'");
  refused({"--random", "1", "--samples", "3"}, 2, "--samples '3': random scenes have 1 or 4");
  refused({"--random", "1", "--sample", "0"}, 2, "--sample is about one scene");
  refused({"--stability", "--sample", "0"}, 2, "--sample is about one scene");
  refused({"--stability", "--samples", "4"}, 2, "--samples is about one scene");
  for (const char* option : {"--shading", "--tolerance", "--time", "--camera", "--composition", "--pixels",
                             "--require-error"})
    refused({"--random", "1", option, "1"}, 2, std::string(option) + " is about one scene");
  for (const char* option : {"--size", "--time", "--camera", "--param", "--skip", "--output"})
    refused({"--stability", "ST-01", option, "1"}, 2, std::string(option) + " is about one scene");
  refused({"sphere", "--engine", "reference"}, 2, "unknown option '--engine'");
  refused({"sphere", "-o", "heat.jpg"}, 2, "'.jpg'");
  refused({"nosuch"}, 3, "nosuch");
  refused({"sphere", "--shading", "wireframe"}, 3, "shading 'wireframe' has no ground truth");
  refused({"sphere", "--shading", "normal"}, 3, "shading 'normal' has no ground truth");
  refused({"sphere", "-o", "a.png", "--report", "a.png"}, 2, "--report 'a.png' would overwrite -o");
  refused({"sphere", "-o", "missing/a.png"}, 5, "cannot write 'missing/a.png'");
  refused({"sphere", "--stability"}, 2, "--stability brings its own scenes");
  refused({"--stability", "ST-01", "--report", "r.json"}, 2, "--report is about one scene");
  refused({"--random", "1", "--report", "r.json"}, 2, "--report is about one scene");
}

}  // namespace
}  // namespace luxo::test
