// SPDX-License-Identifier: Apache-2.0
// luxo plot: from one formula to a picture, and to the scene file that draws the same.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/program.h"
#include "image/format.h"
#include "math/vec.h"
#include "plot_scene.h"

namespace luxo::test {
namespace {

const Arguments kRanges = {"--u", "-1:1", "--v", "0:tau/2"};

class Plot : public RenderTest {
 protected:
  [[nodiscard]] Outcome plot(const std::string& formula, const Arguments& extra) const {
    Arguments arguments = {"plot", formula};
    arguments.insert(arguments.end(), kRanges.begin(), kRanges.end());
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return run(folder, arguments);
  }
};
class PlotPictures : public Plot {
 protected:
  void SetUp() override {
    Plot::SetUp();
    requireDevice();
  }
};

TEST_F(Plot, MistakesPointIntoTheArgument) {
  const Outcome outcome = plot("[u, uv, v]", {"-o", "a.png"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  for (const char* said : {"plot:1:5: unknown name 'uv'", "1 | [u, uv, v]", "    ^^", "did you mean 'u*v'?"})
    EXPECT_TRUE(contains(outcome.err, said)) << outcome.err << "\nlacks: " << said;

  const auto refused = [&](const std::string& formula, const Arguments& extra, int code,
                           const std::string& said) {
    const Outcome bad = plot(formula, extra);
    EXPECT_EQ(bad.code, code) << bad.err;
    EXPECT_TRUE(contains(bad.err, said)) << bad.err << "\nlacks: " << said;
  };
  refused("[u, v]", {"-o", "a.png"}, 2, "2 components instead of 3");
  refused("u, v, 0", {"-o", "a.png"}, 2, "brackets");
  refused("[u, v, k]", {"-o", "a.png"}, 3, "'k'");
  refused("[u, v, k]", {"-L", "k", "-o", "a.png"}, 2, "there is no '='");
  refused("[u, v, k]", {"-L", "k=1", "-P", "q=1", "-o", "a.png"}, 2, "no parameter 'q'");
  refused("[u, v, a]", {"-L", "a=b", "-L", "b=a", "-o", "a.png"}, 3, "plot:4:");
  refused("[u, v, 0]", {}, 2, "no output is given");
  for (const auto& [range, found] : {std::pair("3", "found 1"), std::pair("0:1:2", "found 3")}) {
    const Outcome bad = run(folder, {"plot", "[u, v, 0]", "--u", range, "--v", "0:1", "-o", "a.png"});
    EXPECT_EQ(bad.code, 2) << bad.err;
    EXPECT_TRUE(contains(bad.err, std::string("expected the two ends of a range, ") + found)) << bad.err;
  }
  EXPECT_EQ(folder.entries(), 0u);
  EXPECT_EQ(run(folder, {"plot", "[u, v, 0]", "--u", "0:1", "-o", "a.png"}).code, 2);
  EXPECT_EQ(run(folder, {"plot", "[u, v, 0]", "--u", "0:1", "--v", "1:1", "-o", "a.png"}).code, 3);
}

TEST_F(Plot, DefinitionsThatNeedThePlaceBelongToTheSurface) {
  const SceneFile file = plotScene({.position = "[r, v, mix(r, k, 0.5)]",
                                    .u = "0:1",
                                    .v = "0:2u0",
                                    .definitions = {"r=2s", "s=1+u0*v", "u0=3", "k=u0+1"}},
                                   {});
  ASSERT_EQ(file.parameters.size(), 2u);
  EXPECT_EQ(file.parameters[0].name, "u0");
  EXPECT_EQ(file.parameters[1].name, "k");
  const auto& shape = std::get<FormulaShape>(file.surfaces.at(0).shape);
  ASSERT_EQ(shape.let.size(), 2u);
  EXPECT_EQ(shape.let[0].name, "r");
  EXPECT_EQ(shape.let[1].value, Quantity("1+u0*v"));
  EXPECT_EQ(shape.position[2], Quantity("mix(r, k, 0.5)"));
}

TEST_F(PlotPictures, TheSceneFileDrawsTheSameBytes) {
  const std::string formula = "[u, r*sin(v), cos(v) + u^2]";
  const Arguments options = {"-L",     "k=3", "-L",      "r=1+k*u", "-P",         "k=0.5", "--size", "61x43",
                             "--time", "2",   "--color", "H",       "--isolines", "r@0.2", "--grid", "5x4"};
  Arguments emitting = options, drawing = options;
  emitting.push_back("--emit");
  drawing.insert(drawing.end(), {"-q", "-o", "a.pfm"});
  const Outcome emitted = plot(formula, emitting);
  ASSERT_EQ(emitted.code, 0) << emitted.err;
  writeText(folder / "plot.luxo.json", emitted.out);
  ASSERT_EQ(plot(formula, drawing).code, 0);
  const Outcome rendered = run(folder, {"render", "plot.luxo.json", "-q", "-o", "b.pfm"});
  ASSERT_EQ(rendered.code, 0) << rendered.err;
  EXPECT_TRUE(textOf(folder / "a.pfm") == textOf(folder / "b.pfm"));
}

TEST_F(Plot, ColorsRunOverWhatTheFormulaIs) {
  const auto partOf = [](const std::string& position, const std::string& color, const std::string& map = "") {
    const SceneFile file = plotScene({.position = position,
                                      .u = "-1:1",
                                      .v = "-1:1",
                                      .definitions = {"w=3v", "k=2"},
                                      .color = color,
                                      .colormap = map},
                                     {});
    return file.materials.at(0).let.back().value.formula();
  };
  // Of 65 points between the edges the outermost are 64/65 of the way.
  EXPECT_EQ(partOf("[u, 0, v]", "k*(u+2)"), "clamp((color_value - (2.03077))/3.93846, 0, 1)");
  // Above and below 0: as far on either side.
  EXPECT_EQ(partOf("[u, 0, v]", "w+1"), "clamp((color_value - (-3.95385))/7.90769, 0, 1)");
  EXPECT_EQ(partOf("[u, 0, v]", "w+1", "viridis"), "clamp((color_value - (-1.95385))/5.90769, 0, 1)");
  // A plane has no curvature, a helicoid no mean one: what rounding leaves of it is no range.
  EXPECT_EQ(partOf("[u, 0, v]", "K"), "clamp((color_value - (-0.5))/1, 0, 1)");
  EXPECT_EQ(partOf("[u*cos(v), v, u*sin(v)]", "H"), "clamp((color_value - (-0.5))/1, 0, 1)");
}

TEST_F(Plot, LinesAreThoseOfItsMaterial) {
  const SceneFile file = plotScene({.position = "[u, 0, v]",
                                    .u = "-1:1",
                                    .v = "-1:1",
                                    .definitions = {"w=2q", "q=v", "unused=u"},
                                    .isolines = {"w@0.5", "K"},
                                    .grid = "24x12"},
                                   {});
  const MaterialDesc& material = file.materials.at(0);
  ASSERT_EQ(material.isolines.size(), 3u);
  EXPECT_EQ(material.isolines[0].u, Quantity(24));
  EXPECT_EQ(material.isolines[0].v, Quantity(12));
  EXPECT_EQ(material.isolines[1].of, Quantity("w"));
  EXPECT_EQ(material.isolines[1].step, Quantity(0.5));
  EXPECT_EQ(material.isolines[2].of, Quantity("K"));
  EXPECT_FALSE(material.isolines[2].step);
  ASSERT_EQ(material.let.size(), 2u) << "what they are made of, and nothing else";
  EXPECT_EQ(material.let[1].name.text, "q");
}

TEST_F(Plot, MistakesInColorsAndLinesPointIntoTheArgument) {
  const auto refused = [&](const Arguments& extra, int code, const std::string& said) {
    Arguments all = extra;
    all.insert(all.end(), {"-o", "a.png"});
    const Outcome bad = plot("[u, 0, v]", all);
    EXPECT_EQ(bad.code, code) << bad.err;
    EXPECT_TRUE(contains(bad.err, said)) << bad.err << "\nlacks: " << said;
  };
  refused({"--color", "u+q"}, 3, "plot:4:11: unknown name 'q'");
  refused({"--color", "K", "--colormap", "jet"}, 2, "no colormap 'jet'");
  refused({"--colormap", "vik"}, 2, "no formula to colour by");
  refused({"--isolines", "u@"}, 3, "plot:4:14: the formula is empty");
  refused({"--isolines", "u@0"}, 3, "plot:4:14: this is 0");
  refused({"--grid", "3x"}, 2, "plot:4:8: this is not a number of lines");
  refused({"--grid", "0"}, 3, "from 1 to 100000");
  EXPECT_EQ(folder.entries(), 0u);
}

TEST_F(PlotPictures, TheSurfaceFillsThePicture) {
  for (const char* formula : {"[u, 0.3*u*v, -v]", "[cos(u)*(3 + cos(v)), sin(v), -sin(u)*(3 + cos(v))]",
                              "[u, v, u*v]", "[u, 3*exp(-4*u^2 - 4*v^2), -v]"}) {
    SCOPED_TRACE(formula);
    const Outcome outcome = run(folder, {"plot", formula, "--u=-4:4", "--v=-4:4", "--size", "320x180",
                                         "--aov", "id", "-q", "-o", "a.pfm"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Image ids = loadImage(folder / "a.pfm");
    int left = ids.width(), right = -1, top = ids.height(), bottom = -1;
    for (int y = 0; y < ids.height(); ++y)
      for (int x = 0; x < ids.width(); ++x)
        if (ids.pixel(x, y)[0] > 0) {
          left = std::min(left, x), right = std::max(right, x);
          top = std::min(top, y), bottom = std::max(bottom, y);
        }
    const double across = (right - left + 1.0) / ids.width(), down = (bottom - top + 1.0) / ids.height();
    EXPECT_GT(std::max(across, down), 0.82);
    EXPECT_LT(std::max(across, down), 0.87) << "a pixel is half a percent of the height";
    EXPECT_NEAR(left, ids.width() - 1 - right, 3);
    EXPECT_NEAR(top, ids.height() - 1 - bottom, 3);
  }
}

TEST_F(Plot, ASweepIsSeenFromOnePlaceWhichShowsAllOfIt) {
  const auto distanceOf = [](const std::string& k, std::vector<double> swept) {
    RenderRequest request;
    if (!swept.empty()) request.sweep = Sweep{"k", std::move(swept)};
    const SceneFile file = plotScene(
        {.position = "[u, k*u*v, -v]", .u = "-1:1", .v = "-1:1", .definitions = {"k=" + k}}, request);
    const Quantity3& eye = file.camera->eye;
    return std::hypot(eye[0].number(), eye[1].number(), eye[2].number());
  };
  EXPECT_LT(distanceOf("1", {}), 8);
  EXPECT_GT(distanceOf("9", {}), 15);
  EXPECT_GT(distanceOf("1", {1, 5, 9}), 15);
}

TEST_F(PlotPictures, AWaveIsSeenFromWhereItDoesNotHideItself) {
  const auto cameraOf = [&](const std::string& formula) {
    const Outcome emitted = run(folder, {"plot", formula, "--u=-1:1", "--v=-1:1", "--emit"});
    EXPECT_EQ(emitted.code, 0) << emitted.err;
    const auto camera = nlohmann::json::parse(emitted.out)["camera"];
    const auto at = [&](int i) {
      return camera["eye"][i].get<double>() - camera["look_at"][i].get<double>();
    };
    return Vec3(at(0), at(1), at(2));
  };
  // Two walls: along them, not across.
  const Vec3 eye = cameraOf("[u, 2*exp(-50*(u-0.4)^2) + 2*exp(-50*(u+0.4)^2), -v]");
  EXPECT_LT(std::abs(eye.x), 0.7 * std::abs(eye.z));
  const Vec3 other = cameraOf("[u, 2*exp(-50*(v-0.4)^2) + 2*exp(-50*(v+0.4)^2), -v]");
  EXPECT_LT(std::abs(other.z), 0.7 * std::abs(other.x));
}

TEST_F(PlotPictures, OfAPoleAMeshHasNoBoundAndAnExactPictureNeedsNone) {
  const auto errorOf = [&](const char* shading) {
    const Outcome outcome = plot(
        "[u, 1/u, v]", {"--size", "32x24", "--shading", shading, "--report", "r.json", "-q", "-o", "a.png"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(textOf(folder / "r.json"))["frames"][0]["error"];
  };
  EXPECT_TRUE(errorOf("phong")["bound_px"].is_null());
  EXPECT_EQ(errorOf("phong")["tolerance_px"], 0.5);
  const auto exact = errorOf("exact");
  EXPECT_EQ(exact["bound_px"], 0);
  EXPECT_EQ(exact["audit_failed_px"], 0);
  EXPECT_GT(exact["resolved_by_rays_px"], 100);
}

}  // namespace
}  // namespace luxo::test
