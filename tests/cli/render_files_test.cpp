// SPDX-License-Identifier: Apache-2.0
// What `luxo render` writes: the formats, byte for byte as documented, and the quantities of --aov. Floats
// are read from the PFM file and codes from the PNG file by means other than the engine's own.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <sstream>

#include "cli/program.h"
#include "image/format.h"
#include "luxo_grandpa/lamp.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

static_assert(std::endian::native == std::endian::little, "PFM with a negative scale is little-endian");

/// A PFM file, turned top row first.
Image pictureOfPfm(const std::string& file) {
  std::istringstream header(file);
  std::string kind, scale;
  int width = 0, height = 0;
  header >> kind >> width >> height >> scale;
  EXPECT_TRUE(kind == "PF" || kind == "Pf") << kind;
  EXPECT_EQ(scale, "-1.0");
  const int channels = kind == "PF" ? 3 : 1;
  const std::size_t start = std::size_t(header.tellg()) + 1, row = std::size_t(width * channels) * 4;
  EXPECT_EQ(file.size(), start + row * std::size_t(height));
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y)
    std::memcpy(image.row(height - 1 - y).data(), file.data() + start + row * std::size_t(y), row);
  return image;
}

/// The codes of a PNG file, as libpng's simplified interface gives them.
std::vector<std::uint8_t> codesOfPng(const std::string& file, int width, int height) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&png, file.data(), file.size())) << png.message;
  EXPECT_EQ(png.width, unsigned(width));
  EXPECT_EQ(png.height, unsigned(height));
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> codes(PNG_IMAGE_SIZE(png));
  EXPECT_TRUE(png_image_finish_read(&png, nullptr, codes.data(), 0, nullptr)) << png.message;
  return codes;
}

/// The names of a PNG file's chunks, in order, and whether each is as long as it says.
std::string chunksOfPng(const std::string& file) {
  std::string names;
  std::size_t at = 8;
  while (at + 12 <= file.size()) {
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::uint8_t(file[at + i]);
    names += file.substr(at + 4, 4) + " ";
    at += 12 + length;
  }
  EXPECT_EQ(at, file.size());
  return names;
}

/// floor(255 * sRGB(clamp(c, 0, 1)) + 0.5), IEC 61966-2-1.
int documentedCode(float linear) {
  const double c = std::clamp(double(linear), 0.0, 1.0);
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return int(std::floor(255 * encoded + 0.5));
}

class RenderFiles : public DeviceRenderTest {
 protected:
  [[nodiscard]] Image aov(const std::string& name, const std::string& time = "21") const {
    return pictureOfPfm(fileOf({"--aov", name, "--time", time}, name + ".pfm"));
  }
};

TEST_F(RenderFiles, PfmHoldsALitPicture) {
  const Image linear = pictureOfPfm(fileOf({}, "a.pfm"));
  ASSERT_EQ(linear.width(), kWidth);
  ASSERT_EQ(linear.height(), kHeight);
  ASSERT_EQ(linear.channels(), 3);
  EXPECT_TRUE(allFinite(linear));
  const auto [darkest, brightest] = std::minmax_element(linear.samples().begin(), linear.samples().end());
  EXPECT_GT(*brightest, 1.0f) << "nothing to clamp: the test of the codes would miss the clamp";
  EXPECT_LT(*darkest, 0.1f);
}

TEST_F(RenderFiles, PngHoldsTheDocumentedCodeOfEverySample) {
  const Image linear = pictureOfPfm(fileOf({}, "a.pfm"));
  const std::vector<std::uint8_t> codes = codesOfPng(fileOf({}, "a.png"), kWidth, kHeight);
  ASSERT_EQ(codes.size(), linear.samples().size());
  for (std::size_t i = 0; i < codes.size(); ++i)
    ASSERT_EQ(int(codes[i]), documentedCode(linear.samples()[i])) << "sample " << i;
}

TEST_F(RenderFiles, TgaHoldsTheSameCodes) {
  const std::vector<std::uint8_t> codes = codesOfPng(fileOf({}, "a.png"), kWidth, kHeight);
  const std::string tga = fileOf({}, "a.tga");
  ASSERT_EQ(tga.size(), 18 + codes.size());
  // No palette, true colour, no offset, the size, 24 bits, top row first.
  const std::string header{0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, char(kWidth), 0, char(kHeight), 0, 24, 0x20};
  EXPECT_EQ(tga.substr(0, 18), header);
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::size_t blueFirst = 18 + i / 3 * 3 + (2 - i % 3);
    ASSERT_EQ(std::uint8_t(tga[blueFirst]), codes[i]) << "sample " << i;
  }
}

TEST_F(RenderFiles, ExrHoldsTheBitsOfThePfm) {
  const Image linear = pictureOfPfm(fileOf({}, "a.pfm"));
  ASSERT_NE(fileOf({}, "a.exr"), "");
  EXPECT_TRUE(sameBytes(loadImage(folder / "a.exr"), linear));
}

TEST_F(RenderFiles, CarryNoClock) {
  for (const char* suffix : {"png", "exr"})
    EXPECT_EQ(fileOf({}, fmt::format("a.{}", suffix)), fileOf({}, fmt::format("b.{}", suffix))) << suffix;
  const std::string png = textOf(folder / "a.png");
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(chunksOfPng(png), "IHDR sRGB IDAT IEND ");
}

TEST_F(RenderFiles, OddSizes) {
  for (const char* size : {"1x1", "3x200", "513x7"}) {
    const Outcome outcome = render({"--size", size, "-o", "a.pfm"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Image image = pictureOfPfm(textOf(folder / "a.pfm"));
    EXPECT_EQ(fmt::format("{}x{}", image.width(), image.height()), size);
    EXPECT_TRUE(allFinite(image));
  }
}

TEST_F(RenderFiles, TheSuffixMayBeInEitherCase) { EXPECT_EQ(fileOf({}, "A.PNG"), fileOf({}, "b.png")); }

TEST_F(RenderFiles, AnExistingFileIsReplacedAndALinkKept) {
  writeText(folder / "a.png", "what was here before");
  std::filesystem::create_symlink("a.png", folder / "link.png");
  const std::string written = fileOf({}, "link.png");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.png"));
  EXPECT_EQ(textOf(folder / "a.png"), written);
  EXPECT_EQ(written, fileOf({}, "b.png"));
  EXPECT_EQ(folder.entries(), 3u);
}

TEST_F(RenderFiles, QuantitiesAgreeWithEachOther) {
  const Image id = aov("id"), depth = aov("depth"), position = aov("position"), normal = aov("normal"),
              uv = aov("uv");
  ASSERT_EQ(id.channels(), 1);
  ASSERT_EQ(depth.channels(), 1);
  const Scene lamp = luxoGrandpa();
  const CameraModel camera(lamp.cameras()[0], {kWidth, kHeight}, 21);
  std::size_t hits = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      SCOPED_TRACE(fmt::format("pixel {},{}", x, y));
      const float number = id.pixel(x, y)[0];
      if (number == 0) {
        EXPECT_EQ(depth.pixel(x, y)[0], std::numeric_limits<float>::infinity());
        for (const Image* image : {&position, &normal, &uv}) EXPECT_EQ(colorAt(*image, x, y), Vec3(0));
        continue;
      }
      ++hits;
      EXPECT_EQ(number, std::floor(number));
      EXPECT_LE(number, float(lamp.nodes().size()));
      const Vec3 point = colorAt(position, x, y), n = colorAt(normal, x, y);
      // Some 16 roundings of numbers below 128 m, each by at most 2^-18 m.
      const double precision = 16 * 0x1p-18;
      EXPECT_NEAR(depth.pixel(x, y)[0], camera.depthOf(point), precision);
      EXPECT_TRUE(near(camera.through(centerOf(x, y)).at(camera.depthOf(point)), point,
                       precision + kSnapPx * camera.depthOf(point) / camera.pixelsPerUnit()));
      EXPECT_NEAR(glm::length(n), 1, 1e-6);  // three squares, a sum and a division, each within 2^-23
    }
  }
  EXPECT_GT(hits, std::size_t(kWidth * kHeight / 4));
  EXPECT_LT(hits, std::size_t(kWidth * kHeight)) << "no background: half of this test did not run";
}

TEST_F(RenderFiles, ColourIsTheDefaultQuantity) {
  EXPECT_EQ(fileOf({"--aov", "color"}, "a.pfm"), fileOf({}, "b.pfm"));
}

TEST_F(RenderFiles, SkipsLeaveEveryBitAsItIs) {
  const std::string all = fileOf({}, "all.pfm");
  for (const char* skips :
       {"all", "none", "frustum", "small", "backface", "lights", "unchanged", "passes", "frustum,lights"})
    EXPECT_EQ(fileOf({"--skip", skips}, "a.pfm"), all) << skips;
}

TEST_F(RenderFiles, EveryOptionOfThePictureHasItsEffect) {
  const std::string plain = fileOf({}, "a.pfm");
  EXPECT_EQ(fileOf({"--time", "21"}, "b.pfm"), plain) << "the lamp's own moment is 21 s";
  EXPECT_EQ(fileOf({"--samples", "1", "--shading", "exact", "--tolerance", "0.5", "--camera", "orbit",
                    "--device", "auto", "--engine", "vulkan"},
                   "b.pfm"),
            plain);
  for (const Arguments& other : {Arguments{"--time", "3"},
                                 {"--samples", "4"},
                                 {"--shading", "flat"},
                                 {"--shading", "phong"},
                                 {"--shading", "normal"}})
    EXPECT_NE(fileOf(other, "b.pfm"), plain) << other[1];
  EXPECT_EQ(fileOf({"--tolerance", "8"}, "b.pfm"), plain) << "no mesh is drawn";
  EXPECT_NE(fileOf({"--shading", "phong", "--tolerance", "8"}, "b.pfm"),
            fileOf({"--shading", "phong"}, "c.pfm"));
}

TEST_F(RenderFiles, TheOrderOfOptionsNeverMatters) {
  const auto bytesOf = [&](const Arguments& arguments) {
    std::filesystem::remove(folder / "a.png");
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return textOf(folder / "a.png");
  };
  EXPECT_EQ(bytesOf({"render", "luxo-grandpa", "-o", "a.png", "--size", "33x21", "--time", "3", "--samples",
                     "4", "--shading", "flat", "-q"}),
            bytesOf({"render", "-q", "--shading=flat", "--samples=4", "--time=3", "--size=33x21",
                     "--output=a.png", "luxo-grandpa"}));
}

TEST_F(RenderFiles, WhatIsSaid) {
  EXPECT_EQ(render({"-q", "-o", "a.png"}).err, "");
  for (const Arguments& arguments : {Arguments{"-o", "a.png"}, {"-o", "a.png", "-v"}}) {
    const Outcome outcome = render(arguments);
    EXPECT_EQ(outcome.out, "");
    for (const char* said : {"a.png", "67x45", " ms", " triangles", "residual ", " px"})
      EXPECT_TRUE(contains(outcome.err, said)) << said << " is not in " << outcome.err;
    EXPECT_FALSE(contains(outcome.err, "bound")) << "no mesh is drawn";
  }
  EXPECT_TRUE(contains(render({"-o", "a.png", "--shading", "phong"}).err, "bound 0."));
  EXPECT_TRUE(contains(render({"-o", "a.png", "--aov", "position"}).err, "clamp")) << "numbers in 8 bits";
  EXPECT_FALSE(contains(render({"-o", "a.exr", "--aov", "position"}).err, "clamp"));
}

TEST_F(RenderFiles, ValidationFindsNothing) {
  const Outcome outcome = render({"-o", "a.png", "--validate"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(textOf(folder / "a.png"), fileOf({}, "b.png"));
}

TEST_F(RenderFiles, ThePrimitivesToo) {
  const Outcome list = run(folder, {"render", "--list"});
  EXPECT_EQ(list.code, 0);
  EXPECT_EQ(list.err, "");
  for (const char* scene : {"luxo-grandpa", "primitives"}) {
    EXPECT_TRUE(contains("\n" + list.out, fmt::format("\n{} ", scene))) << list.out;
    const Outcome outcome = run(folder, {"render", scene, "-o", "a.png", "--size", "33x21"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
}

/// Two discs straight below a light, 2 and 4 m away: white and an eighth of it in codes, metres in floats.
TEST_F(RenderFiles, DepthsOfALightAreGreyOrMetres) {
  writeText(folder / "discs.luxo.json",
            R"({ "luxo": 1, "surfaces": { "disc": { "type": "disk", "radius": 1 } },
    "nodes": [ { "surface": "disc", "translate": [0, 2, 0] },
               { "surface": "disc", "translate": [0, 4, 0], "scale": [0.2, 0.2, 0.2] },
               { "translate": [0, 6, 0], "light": { "shadow": "exact" } } ] })");
  const auto render = [&](const char* file) {
    const Outcome outcome =
        run(folder, {"render", "discs.luxo.json", "--aov", "light-depth", "--size", "65x65", "-o", file});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_TRUE(contains(render("a.png"), "a.png: depths from 2 m (white) to 4 m (dark grey); black: nothing"));
  EXPECT_FALSE(contains(render("a.pfm"), "white"));
  const std::vector<std::uint8_t> codes = codesOfPng(textOf(folder / "a.png"), 65, 65);
  const Image metres = pictureOfPfm(textOf(folder / "a.pfm"));
  const auto codeAt = [&](std::size_t x, std::size_t y) { return int{codes[3 * (65 * y + x)]}; };
  EXPECT_EQ(codeAt(32, 32), 255);
  EXPECT_EQ(codeAt(42, 32), 32);  // 255 / 8, rounded
  EXPECT_EQ(codeAt(0, 0), 0);
  EXPECT_NEAR(metres.row(32)[32], 2, 1e-5);
  EXPECT_NEAR(metres.row(32)[42], 4, 1e-5);
  EXPECT_TRUE(std::isinf(metres.row(0)[0]));
  // The light sees nothing: black, and said.
  writeText(folder / "discs.luxo.json",
            R"({ "luxo": 1, "surfaces": { "disc": { "type": "disk", "radius": 1 } },
    "materials": { "air": { "opacity": 0 } },
    "nodes": [ { "surface": "disc", "material": "air" }, { "translate": [0, 6, 0], "light": { "shadow": "exact" } } ] })");
  EXPECT_TRUE(contains(render("b.png"), "black, as the light sees nothing"));
}

/// What is seen through casts an exact shadow beside the map: it is in none.
TEST_F(RenderFiles, DepthsOfAMapAreThoseOfWhatItHas) {
  const auto depths = [&](const std::string& others) {
    writeText(folder / "veiled.luxo.json",
              R"({ "luxo": 1, "surfaces": { "disc": { "type": "disk", "radius": 1 } },
    "materials": { "veil": { "opacity": 0.5 } },
    "nodes": [ { "surface": "disc", "material": "veil", "translate": [0, 4, 0] }, )" +
                  others + R"({ "translate": [0, 6, 0], "light": { "shadow": "map" } } ] })");
    return run(folder,
               {"render", "veiled.luxo.json", "--aov", "light-depth", "--size", "33x33", "-o", "a.pfm"});
  };
  EXPECT_EQ(depths(R"({ "surface": "disc", "translate": [0, 2, 0] }, )").code, 0);
  EXPECT_NEAR(pictureOfPfm(textOf(folder / "a.pfm")).row(16)[16], 4, 1e-5);
  // An empty one is black, and one of what has no size has no place to look at.
  EXPECT_EQ(depths("").code, 0);
  EXPECT_TRUE(std::isinf(pictureOfPfm(textOf(folder / "a.pfm")).row(16)[16]));
  writeText(folder / "nothing.luxo.json",
            R"({ "luxo": 1, "surfaces": { "disc": { "type": "disk" } },
    "nodes": [ { "surface": "disc", "scale": [0, 0, 0] }, { "translate": [0, 6, 0], "light": { "shadow": "exact" } } ] })");
  const Outcome nothing = run(folder, {"render", "nothing.luxo.json", "--aov", "light-depth", "-o", "b.pfm"});
  EXPECT_EQ(nothing.code, 3);
  EXPECT_TRUE(contains(nothing.err, "what casts the light's shadow has no points")) << nothing.err;
}

/// By the name of its node, or by its place where it has none; without one that of the first in the file.
TEST_F(RenderFiles, DepthsOfEveryLightCanBeAskedFor) {
  writeText(folder / "three.luxo.json",
            R"({ "luxo": 1, "surfaces": { "disc": { "type": "disk", "radius": 1 } },
    "nodes": [ { "surface": "disc" }, { "name": "dark", "translate": [0, 1, 0], "light": {} },
               { "name": "sun", "translate": [0, 6, 0], "light": { "intensity": 5, "shadow": "exact" } },
               { "name": "a:b", "translate": [0, 3, 0], "light": { "shadow": "map" } },
               { "translate": [0, 9, 0], "visible": "t < 1", "light": { "intensity": 3, "shadow": "exact" } } ] })");
  const auto render = [&](const std::string& aov, const char* time = "0") {
    return run(folder,
               {"render", "three.luxo.json", "--aov", aov, "--size", "33x33", "--time", time, "-o", "a.png"});
  };
  const std::pair<const char*, const char*> distances[] = {{"light-depth", "6 m"},
                                                           {"light-depth:sun", "6 m"},
                                                           {"light-depth:a:b", "3 m"},
                                                           {"light-depth:nodes[4]", "9 m"}};
  for (const auto& [aov, distance] : distances)
    EXPECT_TRUE(contains(render(aov).err, fmt::format("depths from {} (white)", distance))) << aov;
  for (const char* unknown : {"nobody", "dark", ""})
    expectFailure(render(fmt::format("light-depth:{}", unknown)), 2,
                  fmt::format("the scene has no light '{}' with a shadow", unknown),
                  "its lights with a shadow: sun, a:b, nodes[4]");
  expectFailure(render("light-depth:sum"), 2, "no light 'sum'", "did you mean 'sun'?");
  expectFailure(render("light-depth:nodes[4]", "2"), 3, "the light has no shadow then", "visible");
  expectFailure(render("light-depths:sun"), 2, "--aov 'light-depths:sun'", "light-depth");
}

/// From 2 km away as from 2 m, however fine the picture.
TEST_F(RenderFiles, DepthsOfADistantLightAreMetres) {
  writeText(folder / "far.luxo.json",
            R"({ "luxo": 1, "surfaces": { "disc": { "type": "disk", "radius": 1 } },
    "nodes": [ { "surface": "disc", "translate": [0, 2, 0] },
               { "translate": [0, 2000, 0], "light": { "shadow": "exact" } } ] })");
  for (const char* size : {"33x33", "1025x1025"}) {
    const Outcome outcome =
        run(folder, {"render", "far.luxo.json", "--aov", "light-depth", "--size", size, "-o", "far.png"});
    EXPECT_TRUE(contains(outcome.err, "depths from 1998 m (white)")) << size << ": " << outcome.err;
  }
}

/// The large disc stays 4 m away, and keeps its grey, though small ones sink on both sides of it.
TEST_F(RenderFiles, GreysOfASequenceAreOfTheSameDepths) {
  writeText(folder / "sinking.luxo.json",
            R"({ "luxo": 1, "surfaces": { "disc": { "type": "disk", "radius": 1 } },
    "nodes": [ { "surface": "disc", "translate": [0, 2, 0] },
               { "surface": "disc", "translate": [0, 4, 0], "scale": [0.2, 0.2, 0.2] },
               { "surface": "disc", "translate": [1.5, "2-8*t", 0], "scale": [0.2, 0.2, 0.2] },
               { "surface": "disc", "translate": [-1.5, "2-8*t", 0], "scale": [0.2, 0.2, 0.2] },
               { "translate": [0, 6, 0], "light": { "shadow": "exact" } } ] })");
  const Outcome outcome = run(folder, {"render", "sinking.luxo.json", "--aov", "light-depth", "--size",
                                       "65x65", "--fps", "8", "--frames", "1-2", "-o", "s%d.png"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "s1.png: depths from")) << outcome.err;
  EXPECT_FALSE(contains(outcome.err, "s2.png: depths")) << outcome.err;
  // 9.6 pixels in radius, less 3.8 that are hidden: 241 of them.
  for (const char* file : {"s1.png", "s2.png"}) {
    const std::vector<std::uint8_t> codes = codesOfPng(textOf(folder / file), 65, 65);
    EXPECT_GT(std::ranges::count_if(codes, [](int code) { return code >= 32 && code <= 34; }), 3 * 200)
        << file;
  }
}

TEST_F(RenderFiles, AnotherCompositionThanAskedForIsTold) {
  const auto said = [&](const char* scene, const char* composition, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"render", scene,           "-o",       "a.png", "--size",
                                       "33x21",  "--composition", composition};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return contains(outcome.err, "all the same");
  };
  EXPECT_TRUE(said("glass", "fused"));
  EXPECT_FALSE(said("glass", "deferred"));
  EXPECT_FALSE(said("glass", "auto"));
  EXPECT_FALSE(said("luxo-grandpa", "fused"));
  EXPECT_FALSE(said("luxo-grandpa", "deferred"));
  EXPECT_TRUE(said("luxo-grandpa", "deferred", {"--shading", "normal"}));
}

}  // namespace
}  // namespace luxo::test
