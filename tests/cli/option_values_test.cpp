// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"

#include <gtest/gtest.h>

#include "unit/image_test_support.h"

namespace luxo {
namespace {

/// The parser refuses every text with this kind, and its message quotes the text.
void expectRefused(ErrorKind kind, const auto& parse, std::initializer_list<const char*> texts) {
  for (const char* text : texts) {
    try {
      static_cast<void>(parse(text));
      ADD_FAILURE() << "'" << text << "' was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << text;
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  }
}

std::string hintOf(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.hint();
  }
  return "nothing was thrown";
}

TEST(OptionValues, Number) {
  const auto number = [](const std::string& text) { return parseNumber("--x", text); };
  EXPECT_EQ(number("0.25"), 0.25);
  EXPECT_EQ(number("-3"), -3);
  EXPECT_EQ(number("1e-3"), 1e-3);
  EXPECT_EQ(number("1/255"), 1.0 / 255);
  expectRefused(
      ErrorKind::Usage, number,
      {"", "x", "1x", "1 ", " 1", "nan", "inf", "1e999", "1/0", "1/", "/2", "1/2/3", "0x10", "1,5"});
}

TEST(OptionValues, Size) {
  EXPECT_EQ(parseSize("1280x720"), (PixelSize{1280, 720}));
  EXPECT_EQ(parseSize("1x16384"), (PixelSize{1, 16384}));
  expectRefused(ErrorKind::Usage, parseSize,
                {"", "1280", "x", "1280x", "x720", "1280x720x3", "1280X720", "1280,720", "0x5", "5x0", "-1x5",
                 "16385x1", "1x99999999999999999999", "4294967297x1", "12.5x3", " 1x1", "1x1 ", "+1x1"});
  try {
    static_cast<void>(parseSize("100000x2"));
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a width of 100000 is more than"), std::string::npos)
        << error.what();
    EXPECT_NE(error.hint().find("16384"), std::string::npos);
  }
}

TEST(OptionValues, EndsOfRanges) {
  const auto px = [](const std::string& text) { return parsePixels("--tolerance", text); };
  EXPECT_EQ(px("1e-6"), 1e-6);
  EXPECT_EQ(px("1e6px"), 1e6);
  expectRefused(ErrorKind::Usage, px, {"0", "-1", "5e-324", "9e-7", "1000001", "1e308"});
  EXPECT_EQ(parsePixels("--require-error", "1e-12", kErrorRange), 1e-12);
  EXPECT_THROW(static_cast<void>(parsePixels("--require-error", "9e-13", kErrorRange)), Error);
  EXPECT_EQ(parseFps("1e-6"), 1e-6);
  EXPECT_EQ(parseFps("1e6"), 1e6);
  expectRefused(ErrorKind::Usage, parseFps, {"0", "-1", "5e-324", "9e-7", "1000001", "1e308"});
  EXPECT_EQ(parseSamples("1"), 1);
  EXPECT_EQ(parseSamples("256"), 256);
  expectRefused(ErrorKind::Usage, parseSamples, {"0", "257"});
}

TEST(OptionValues, Frames) {
  EXPECT_EQ(parseFrames("7"), (std::vector<int>{7}));
  EXPECT_EQ(parseFrames("1-4"), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(parseFrames("1-10:4"), (std::vector<int>{1, 5, 9}));
  EXPECT_EQ(parseFrames("5,1-3,2-4,0"), (std::vector<int>{5, 1, 2, 3, 4, 0}));
  EXPECT_EQ(parseFrames("3-3"), (std::vector<int>{3}));
  EXPECT_EQ(parseFrames("2147483640-2147483647:5"), (std::vector<int>{2147483640, 2147483645}));
  const auto designExample = parseFrames("1-250:2,300");
  ASSERT_EQ(designExample.size(), 126u);
  EXPECT_EQ(designExample[1], 3);
  EXPECT_EQ(designExample[124], 249);
  EXPECT_EQ(designExample.back(), 300);
  expectRefused(ErrorKind::Usage, parseFrames,
                {"", ",", "1,", "a", "1-", "-1", "-1-3", "1--3", "3-1", "1-5:0", "1-5:-1", "1-5:", "1:2",
                 "1-2-3", "1.5", "1 -3", "0-1000000", "99999999999"});
}

TEST(OptionValues, Fps) {
  EXPECT_EQ(parseFps("24"), 24);
  EXPECT_EQ(parseFps("30000/1001"), 30000.0 / 1001);
  expectRefused(ErrorKind::Usage, parseFps, {"0", "-24", "x"});
}

TEST(OptionValues, Samples) {
  EXPECT_EQ(parseSamples("1"), 1);
  EXPECT_EQ(parseSamples("256"), 256);
  expectRefused(ErrorKind::Usage, parseSamples, {"", "0", "-4", "four", "4.0", "257", "1000000000"});
}

TEST(OptionValues, Pixels) {
  const auto pixels = [](const std::string& text) { return parsePixels("--tolerance", text); };
  EXPECT_EQ(pixels("0.25"), 0.25);
  EXPECT_EQ(pixels("0.25px"), 0.25);
  EXPECT_EQ(pixels("1/4px"), 0.25);
  expectRefused(ErrorKind::Usage, pixels, {"0", "-1", "px", "0.25 px", "1pxpx", "0.25mm", "nan"});
}

TEST(OptionValues, Lengths) {
  const auto length = [](const std::string& text) { return parseLength("--tolerance", text); };
  EXPECT_DOUBLE_EQ(length("0.01mm"), 1e-5);
  EXPECT_DOUBLE_EQ(length("5um"), 5e-6);
  EXPECT_DOUBLE_EQ(length("1/2cm"), 5e-3);
  EXPECT_DOUBLE_EQ(length("1in"), 0.0254);
  EXPECT_EQ(length("2m"), 2);
  EXPECT_EQ(length("0.25"), 0.25);
  expectRefused(ErrorKind::Usage, length,
                {"", "mm", "0mm", "-1mm", "1 mm", "1px", "1mmm", "nan", "inf", "2e9"});
  const auto unit = [](const std::string& text) { return parseLengthUnit("--unit", text); };
  EXPECT_EQ(unit("mm"), 1e-3);
  EXPECT_EQ(unit("m"), 1);
  expectRefused(ErrorKind::Usage, unit, {"", "km", "MM", "1"});
}

TEST(OptionValues, Names) {
  EXPECT_EQ(parseShading("gouraud"), Shading::Gouraud);
  EXPECT_EQ(parseShading("id"), Shading::Id);
  expectRefused(ErrorKind::Usage, parseShading, {"", "phon", "Phong ", "5"});
  EXPECT_EQ(parseShading("exact"), Shading::Exact);
  EXPECT_EQ(parseShading("residual"), Shading::Residual);
  expectRefused(ErrorKind::Scene, parseShading, {"overdraw", "lod"});
  EXPECT_EQ(hintOf([] { static_cast<void>(parseShading("gourad")); }), "did you mean 'gouraud'?");

  EXPECT_EQ(parseAov("color"), Output::Color);
  EXPECT_EQ(parseAov("depth"), Output::Depth);
  EXPECT_EQ(parseAov("position"), Output::Position);
  EXPECT_EQ(parseAov("normal"), Output::Normal);
  EXPECT_EQ(parseAov("uv"), Output::Uv);
  EXPECT_EQ(parseAov("id"), Output::Id);
  EXPECT_EQ(parseAov("residual"), Output::Residual);
  expectRefused(ErrorKind::Usage, parseAov, {"", "colour2", "z"});
  EXPECT_EQ(hintOf([] { static_cast<void>(parseAov("colour")); }), "did you mean 'color'?");

  EXPECT_EQ(parseEngine("vulkan"), Engine::Vulkan);
  EXPECT_EQ(parseEngine("reference"), Engine::Reference);
  expectRefused(ErrorKind::Usage, parseEngine, {"", "opengl"});
}

TEST(OptionValues, SkipsNamedAreOnAndTheOthersOff) {
  EXPECT_EQ(parseSkips("all"), Skips{});
  Skips none = parseSkips("none");
  for (const bool on :
       {none.frustum, none.small, none.backface, none.lights, none.unchanged, none.passes, none.hidden})
    EXPECT_FALSE(on);
  Skips expected = none;
  expected.small = expected.passes = true;
  EXPECT_EQ(parseSkips("passes,small"), expected);
  EXPECT_EQ(parseSkips("frustum,small,backface,lights,unchanged,passes,hidden"), Skips{});
  expectRefused(ErrorKind::Usage, parseSkips, {"", "frustrum", "all,none", "small,all"});
  EXPECT_EQ(hintOf([] { static_cast<void>(parseSkips("frustrum")); }), "did you mean 'frustum'?");
}

TEST(OptionValues, Parameter) {
  EXPECT_EQ(parseParameter("n=5"), (ParameterValue{"n", "5"}));
  EXPECT_EQ(parseParameter("_a1=2u+sin(t)=3"), (ParameterValue{"_a1", "2u+sin(t)=3"}));
  expectRefused(ErrorKind::Usage, parseParameter, {"", "n", "=5", "n=", "5n=1", "a b=1", "a-b=2"});
}

TEST(OptionValues, SweepReachesItsEnd) {
  EXPECT_EQ(parseSweep("n=1:4:1"), (Sweep{"n", {1, 2, 3, 4}}));
  EXPECT_EQ(parseSweep("n=3:1:-1"), (Sweep{"n", {3, 2, 1}}));
  EXPECT_EQ(parseSweep("n=0:1:0.4"), (Sweep{"n", {0, 0.4, 0.8}}));
  EXPECT_EQ(parseSweep("n=2:2:1"), (Sweep{"n", {2}}));
  EXPECT_EQ(parseSweep("n=0:1:0.1").values.size(), 11u);
  EXPECT_EQ(parseSweep("n=0:0.3:0.1"), (Sweep{"n", {0, 0.1, 0.2, 0.3}}));  // 0.3 / 0.1 < 3, and 3 * 0.1 > 0.3
  EXPECT_EQ(parseSweep("n=0:1:1/3").values.size(), 4u);
  expectRefused(ErrorKind::Usage, parseSweep,
                {"", "n", "n=", "n=1:2", "n=1:2:0", "n=1:2:-1", "n=2:1:1", "n=1:2:1:1", "1:2:1", "n=a:2:1",
                 "n=0:1:1e-9"});
}

}  // namespace
}  // namespace luxo
