// SPDX-License-Identifier: Apache-2.0
#include "image/texture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <string>

#include <jpeglib.h>

#include "image/half.h"
#include "image/jpeg.h"
#include "image/png.h"
#include "image/srgb.h"
#include "image/tga.h"
#include "unit/image_test_support.h"

namespace luxo {
namespace {

using ::testing::HasSubstr;

std::vector<std::byte> jpegOf(int width, int height, int channels, const std::vector<std::uint8_t>& codes,
                              bool progressive) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* out = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &out, &size);
  info.image_width = JDIMENSION(width);
  info.image_height = JDIMENSION(height);
  info.input_components = channels;
  info.in_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 100, TRUE);
  if (progressive) jpeg_simple_progression(&info);
  jpeg_start_compress(&info, TRUE);
  for (int y = 0; y < height; ++y) {
    JSAMPROW row = const_cast<std::uint8_t*>(&codes[std::size_t(y * width * channels)]);
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  const auto* begin = reinterpret_cast<const std::byte*>(out);
  std::vector<std::byte> bytes(begin, begin + size);
  free(out);
  return bytes;
}

template <class Action>
std::string refusalOf(Action action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    return error.what();
  }
  return {};
}

TEST(Half, RoundsToTheNearestAndBack) {
  for (std::uint32_t half = 0; half < 0x7c00; ++half) {
    const float value = floatFromHalf(std::uint16_t(half)), next = floatFromHalf(std::uint16_t(half + 1));
    ASSERT_EQ(halfFromFloat(value), half);
    ASSERT_EQ(halfFromFloat(-value), half | 0x8000);
    if (half + 1 == 0x7c00) break;
    const float middle = 0.5f * value + 0.5f * next;  // exact
    ASSERT_EQ(halfFromFloat(middle), half % 2 == 0 ? half : half + 1);
    ASSERT_EQ(halfFromFloat(std::nextafter(middle, 0.0f)), half);
    ASSERT_EQ(halfFromFloat(std::nextafter(middle, 1e6f)), half + 1);
  }
  EXPECT_EQ(floatFromHalf(0x3c00), 1.0f);
  EXPECT_EQ(floatFromHalf(0x0001), 0x1p-24f);
  EXPECT_EQ(halfFromFloat(1e9f), 0x7c00);
}

TEST(Texture, OfACheckerIsItsMeanInLinearLight) {
  Image checker(8, 8, 3);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (float& sample : checker.pixel(x, y)) sample = (x + y) % 2 == 0 ? decodeSrgb8(255) : decodeSrgb8(0);
  const Texture texture = decodeTexture(encodePng(checker), "checker", Codes::Srgb);
  ASSERT_EQ(texture.levels.size(), 4u);
  EXPECT_FALSE(texture.transparent);
  for (std::size_t level = 1; level < 4; ++level)
    for (int i = 0; i < texture.levels[level].width; ++i)
      EXPECT_EQ(texture.levels[level].texel(i, i),
                (std::array{0.5f, 0.5f, 0.5f, 1.0f}));  // not 0.5 of sRGB, 0.21
}

TEST(Texture, OddSidesKeepTheMean) {
  for (const auto& [width, height] : {std::pair{5, 3}, {7, 1}, {1, 6}, {13, 11}}) {
    Image image(width, height, 1);
    std::mt19937 random(1);
    double mean = 0;
    for (float& sample : image.samples()) mean += double(sample = float(random() % 1000) / 999.0f);
    mean /= double(image.samples().size());
    const Texture texture = makeTexture(image, "odd", Codes::Data);
    EXPECT_EQ(texture.levels.back().width, 1);
    EXPECT_EQ(texture.levels.back().height, 1);
    // Each level's texels cover the one before in equal parts, so only halves round: by 2^-12 below 1.
    EXPECT_NEAR(double(texture.levels.back().texel(0, 0)[0]), mean, 0x1p-12 + 1e-6)
        << width << " x " << height;
  }
  // 3 to 1: a third each. 5 to 2: 2.5 texels each.
  Image five(5, 1, 1, {1, 0, 1, 0, 0});
  const Texture texture = makeTexture(five, "five", Codes::Data);
  EXPECT_EQ(texture.levels[1].texel(0, 0)[0], floatFromHalf(halfFromFloat(1.5f / 2.5f)));
  EXPECT_EQ(texture.levels[1].texel(1, 0)[0], floatFromHalf(halfFromFloat(0.5f / 2.5f)));
}

TEST(Texture, WhatIsNotSeenGivesNoColour) {
  const Image image(2, 1, 4, {1, 0.5f, 0.25f, 1, 0, 1, 0, 0});
  EXPECT_EQ(makeTexture(image, "x").levels[1].texel(0, 0), (std::array{1.0f, 0.5f, 0.25f, 0.5f}));
  EXPECT_TRUE(makeTexture(image, "x").transparent);
  EXPECT_EQ(makeTexture(image, "x", Codes::Data).levels[1].texel(0, 0),
            (std::array{0.5f, 0.75f, 0.125f, 0.5f}));
  EXPECT_EQ(makeTexture(image, "x").levels[0].texel(1, 0), (std::array{0.0f, 1.0f, 0.0f, 0.0f}));
}

TEST(Texture, CodesAreColoursOrNumbers) {
  std::vector<std::uint8_t> codes(256);
  Image ramp(256, 1, 3);
  for (int i = 0; i < 256; ++i)
    for (float& sample : ramp.pixel(i, 0)) sample = decodeSrgb8(std::uint8_t(i));
  for (const auto& bytes : {encodePng(ramp), encodeTga(ramp)}) {
    const Texture colour = decodeTexture(bytes, "ramp", Codes::Srgb),
                  data = decodeTexture(bytes, "ramp", Codes::Data);
    for (int i = 0; i < 256; ++i) {
      EXPECT_NEAR(255 * srgbFromLinear(double(colour.levels[0].texel(i, 0)[1])), i, 0.07);
      EXPECT_NEAR(255.0 * double(data.levels[0].texel(i, 0)[1]), i, 0.07);
    }
  }
}

TEST(Texture, TgasOfEveryOriginAreEqual) {
  const Image image = [] {
    Image made(3, 2, 3);
    for (std::size_t i = 0; i < made.samples().size(); ++i)
      made.samples()[i] = decodeSrgb8(std::uint8_t(13 * i));
    return made;
  }();
  const auto bytes = encodeTga(image);
  const Texture expected = decodeTexture(bytes, "a.tga", Codes::Srgb);
  for (const int descriptor : {0x00, 0x10, 0x20, 0x30}) {
    auto turned = bytes;
    turned[17] = std::byte(descriptor);
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x) {
        const int row = (descriptor & 0x20) != 0 ? y : 1 - y, column = (descriptor & 0x10) != 0 ? 2 - x : x;
        std::copy_n(bytes.begin() + 18 + 3 * (3 * y + x), 3, turned.begin() + 18 + 3 * (3 * row + column));
      }
    EXPECT_EQ(decodeTexture(turned, "b.tga", Codes::Srgb).levels[0].halves, expected.levels[0].halves);
  }
}

TEST(Texture, WhatIsNoImageIsCalledNone) {
  const auto refusal = [](const std::string& text) {
    return refusalOf([&] { (void)decodeTexture(std::as_bytes(std::span(text)), "a.png", Codes::Srgb); });
  };
  for (const std::string& text : {std::string(), std::string("a text that is long enough for a header"),
                                  "RIFF\x20\x01\0\0WEBPVP8 0123456789" + std::string(99, 'x'),
                                  "BM" + std::string(99, '\0'), std::string(99, '\0')})
    EXPECT_EQ(refusal(text), "cannot read 'a.png': it is neither PNG, JPEG nor TGA");
  std::string palette(99, '\0');
  palette[1] = palette[2] = 1;
  palette[16] = 8;
  EXPECT_THAT(refusal(palette), HasSubstr("as TGA: type 1 with 8 bits per pixel is not supported"));
}

TEST(Jpeg, GreyAndColourWithinWhatItLoses) {
  std::vector<std::uint8_t> codes;
  for (int i = 0; i < 24 * 16; ++i) codes.push_back(std::uint8_t(40 + 5 * (i % 24) + 2 * (i / 24)));
  for (const bool progressive : {false, true}) {
    const Image grey = decodeJpeg(jpegOf(24, 16, 1, codes, progressive), "a.jpg", Codes::Data);
    ASSERT_EQ(grey.channels(), 1);
    ASSERT_EQ(grey.width(), 24);
    // At quality 100 coefficients are rounded to whole numbers: about a code.
    for (std::size_t i = 0; i < codes.size(); ++i) EXPECT_NEAR(255 * double(grey.samples()[i]), codes[i], 2);
    EXPECT_EQ(decodeJpeg(jpegOf(24, 16, 1, codes, progressive), "a.jpg").samples()[0],
              decodeSrgb8(std::uint8_t(std::lround(255 * grey.samples()[0]))));
    std::vector<std::uint8_t> red(std::size_t(3 * 16 * 16));
    for (std::size_t i = 0; i < red.size(); i += 3) red[i] = 200;
    const Image colour = decodeJpeg(jpegOf(16, 16, 3, red, progressive), "a.jpg", Codes::Data);
    ASSERT_EQ(colour.channels(), 3);
    for (std::size_t i = 0; i < red.size(); ++i) EXPECT_NEAR(255 * double(colour.samples()[i]), red[i], 2);
  }
}

TEST(Jpeg, DamageIsRefused) {
  std::mt19937 random(5);
  std::vector<std::uint8_t> noise(64 * 64);
  for (auto& code : noise) code = std::uint8_t(random());
  const auto whole = jpegOf(64, 64, 1, noise, false);
  ASSERT_EQ(refusalOf([&] { (void)decodeJpeg(whole, "a.jpg"); }), "");
  for (std::size_t length = 0; length + 2 < whole.size(); length += 97)
    EXPECT_THAT(refusalOf([&] { (void)decodeJpeg(std::span(whole).first(length), "a.jpg"); }),
                HasSubstr("cannot read 'a.jpg' as JPEG: "))
        << length;
  // Its frame header: FF C0, length, precision, height, width.
  auto lie = whole;
  const std::array marker = {std::byte(0xff), std::byte(0xc0)};
  const auto frame = std::search(lie.begin(), lie.end(), marker.begin(), marker.end());
  ASSERT_NE(frame, lie.end());
  std::fill_n(frame + 5, 4, std::byte(0xff));
  EXPECT_THAT(refusalOf([&] { (void)decodeJpeg(lie, "a.jpg"); }), HasSubstr("65500"));
  std::copy_n(std::array{std::byte(0x3f), std::byte(0xff)}.begin(), 2, frame + 5);
  std::copy_n(std::array{std::byte(0x3f), std::byte(0xff)}.begin(), 2, frame + 7);
  EXPECT_THAT(refusalOf([&] { (void)decodeJpeg(lie, "a.jpg"); }),
              HasSubstr("16383 x 16383 pixels cannot be in"));
}

TEST(Texture, BadFilesAreRefused) {
  const Image wide(20000, 1, 1);
  EXPECT_THAT(refusalOf([&] { (void)makeTexture(wide, "wide.png"); }),
              HasSubstr("'wide.png' has 20000 x 1 pixels, and a side of a texture is at most 16384"));
}

}  // namespace
}  // namespace luxo
