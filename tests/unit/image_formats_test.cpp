// SPDX-License-Identifier: Apache-2.0
// The four formats: bytes that others agree on, round trips, and damaged files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/srgb_curve.h"
#include "image/exr.h"
#include "image/format.h"
#include "image/pfm.h"
#include "image/png.h"
#include "image/srgb.h"
#include "image/tga.h"
#include "image_test_support.h"

namespace luxo {
namespace {

using ::testing::HasSubstr;

// As colours, which is what their readers take codes for.
const auto readPng = [](std::span<const std::byte> bytes, std::string_view name) {
  return decodePng(bytes, name);
};
const auto readTga = [](std::span<const std::byte> bytes, std::string_view name) {
  return decodeTga(bytes, name);
};

std::vector<std::byte> bytesOf(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(std::byte(value));
  return bytes;
}

std::string textOf(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Linear values that 8-bit codes stand for, so that they survive an 8-bit file bit for bit.
Image imageOfCodes(int width, int height, int channels) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.samples().size(); ++i) {
    const auto code = std::uint8_t(i * 37 + 11);
    const bool alpha = channels == 4 && i % 4 == 3;
    image.samples()[i] = alpha ? float(code) / 255.0f : decodeSrgb8(code);
  }
  return image;
}

// --- PNG

TEST(Png, CodesSurvive) {
  for (const int channels : {3, 4}) {
    const Image image = imageOfCodes(17, 5, channels);
    const Image again = decodePng(encodePng(image), "a.png");
    ASSERT_EQ(again.channels(), channels);
    EXPECT_EQ(bitsOf(again), bitsOf(image));
  }
}

TEST(Png, OneChannelBecomesGreyRgb) {
  const Image again = decodePng(encodePng(Image(1, 1, 1, {0.5f})), "a.png");
  ASSERT_EQ(again.channels(), 3);
  for (const float sample : again.samples()) EXPECT_EQ(encodeSrgb8(sample), 188);
}

TEST(Png, HoldsNoClockAndOnlyTheChunksPromised) {
  const auto file = encodePng(imageOfColours(64, 48, 3, 1));
  EXPECT_EQ(file, encodePng(imageOfColours(64, 48, 3, 1)));
  std::vector<std::string> chunks;
  for (std::size_t at = 8; at < file.size();) {
    const auto byte = [&](std::size_t i) { return std::to_integer<std::size_t>(file[at + i]); };
    const std::size_t length = (byte(0) << 24) + (byte(1) << 16) + (byte(2) << 8) + byte(3);
    const std::string kind =
        textOf({file.begin() + std::ptrdiff_t(at) + 4, file.begin() + std::ptrdiff_t(at) + 8});
    if (chunks.empty() || chunks.back() != kind) chunks.push_back(kind);
    at += 12 + length;
  }
  EXPECT_EQ(chunks, (std::vector<std::string>{"IHDR", "sRGB", "IDAT", "IEND"}));
}

// A PNG from its parts, so that kinds luxo never writes can be read: deflate's stored block needs no
// compressor.
std::vector<std::byte> bigEndian32(std::uint32_t value) {
  return bytesOf({int(value >> 24), int(value >> 16 & 255), int(value >> 8 & 255), int(value & 255)});
}

void extend(std::vector<std::byte>& out, const std::vector<std::byte>& more) {
  out.insert(out.end(), more.begin(), more.end());
}

std::uint32_t crcOf(std::span<const std::byte> bytes) {
  std::uint32_t crc = ~0u;
  for (const std::byte byte : bytes) {
    crc ^= std::to_integer<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

std::vector<std::byte> chunk(const char* kind, const std::vector<std::byte>& data) {
  std::vector<std::byte> body = bytesOf({kind[0], kind[1], kind[2], kind[3]});
  extend(body, data);
  std::vector<std::byte> out = bigEndian32(std::uint32_t(data.size()));
  extend(out, body);
  extend(out, bigEndian32(crcOf(body)));
  return out;
}

std::vector<std::byte> pngOf(int width, int bits, int colourType, const std::vector<std::byte>& beforeData,
                             const std::vector<std::byte>& row) {
  std::vector<std::byte> header = bigEndian32(std::uint32_t(width));
  extend(header, bytesOf({0, 0, 0, 1, bits, colourType, 0, 0, 0}));
  std::vector<std::byte> raw = bytesOf({0});  // filter: none
  extend(raw, row);
  std::uint32_t sum = 1, sumOfSums = 0;  // Adler-32
  for (const std::byte byte : raw) {
    sum = (sum + std::to_integer<std::uint32_t>(byte)) % 65521;
    sumOfSums = (sumOfSums + sum) % 65521;
  }
  const int size = int(raw.size());
  std::vector<std::byte> deflated = bytesOf({0x78, 0x01, 1, size, 0, 255 - size, 255});
  extend(deflated, raw);
  extend(deflated, bigEndian32(sumOfSums << 16 | sum));
  std::vector<std::byte> out = bytesOf({0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'});
  for (const auto& part : {chunk("IHDR", header), beforeData, chunk("IDAT", deflated), chunk("IEND", {})})
    extend(out, part);
  return out;
}

TEST(Png, ReadsGreyWithAlphaOf16Bits) {
  const auto file = pngOf(2, 16, 4, {}, bytesOf({0x80, 0x00, 0xff, 0xff, 0xff, 0xff, 0x40, 0x00}));
  const Image image = decodePng(file, "a.png");
  ASSERT_EQ(image.channels(), 4);
  // 0x8000 / 65535 on the curve's power piece; 1e-7 covers the rounding to float.
  const double grey = std::pow((32768 / 65535.0 + 0.055) / 1.055, 2.4);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(image.pixel(0, 0)[c], grey, 1e-7);
  EXPECT_EQ(image.pixel(0, 0)[3], 1.0f);
  EXPECT_EQ(image.pixel(1, 0)[0], 1.0f);
  EXPECT_NEAR(image.pixel(1, 0)[3], 16384 / 65535.0, 1e-7);
}

TEST(Png, ReadsAPaletteWithTransparency) {
  std::vector<std::byte> tables = chunk("PLTE", bytesOf({255, 0, 0, 0, 188, 255}));
  extend(tables, chunk("tRNS", bytesOf({51})));
  const Image image = decodePng(pngOf(2, 1, 3, tables, bytesOf({0x40})), "a.png");  // entries 0, 1
  ASSERT_EQ(image.channels(), 4);
  EXPECT_EQ(image.pixel(0, 0)[0], 1.0f);
  EXPECT_EQ(image.pixel(0, 0)[3], 0.2f);
  EXPECT_EQ(encodeSrgb8(image.pixel(1, 0)[1]), 188);
  EXPECT_EQ(image.pixel(1, 0)[3], 1.0f);
}

TEST(Png, ReadsGreyOfOneBitAsOneChannel) {
  const Image image = decodePng(pngOf(3, 1, 0, {}, bytesOf({0xa0})), "a.png");
  ASSERT_EQ(image.channels(), 1);
  EXPECT_EQ(image.pixel(0, 0)[0], 1.0f);
  EXPECT_EQ(image.pixel(1, 0)[0], 0.0f);
  EXPECT_EQ(image.pixel(2, 0)[0], 1.0f);
}

TEST(Png, DamageIsRefused) {
  const auto file = encodePng(imageOfColours(9, 6, 3, 2));
  EXPECT_TRUE(readsOrRefuses(readPng, file));
  expectEveryTruncationRefused(readPng, file);
  expectDamageSurvived(readPng, file, 4000);
}

TEST(Png, SizeThatCannotBeTrueIsRefusedBeforeAllocating) {
  const auto file = [] {
    auto bytes = pngOf(1, 8, 2, {}, bytesOf({1, 2, 3}));
    const auto side = bigEndian32(16000);
    std::copy(side.begin(), side.end(), bytes.begin() + 16);
    std::copy(side.begin(), side.end(), bytes.begin() + 20);
    const auto crc = bigEndian32(crcOf(std::span(bytes).subspan(12, 17)));
    std::copy(crc.begin(), crc.end(), bytes.begin() + 29);
    return bytes;
  }();
  EXPECT_FALSE(readsOrRefuses(readPng, file));
  try {
    static_cast<void>(decodePng(file, "huge.png"));
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("16000 x 16000 pixels cannot be in"), std::string::npos)
        << error.what();
  }
}

// --- TGA

TEST(Tga, BytesAreThoseOfTheSpecification) {
  // Red, then half-transparent linear 0.5 grey: header, then blue green red (alpha), top row first.
  EXPECT_EQ(encodeTga(Image(1, 2, 3, {1, 0, 0, 0.5f, 0.5f, 0.5f})),
            bytesOf({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 2, 0, 24, 0x20, 0, 0, 255, 188, 188, 188}));
  EXPECT_EQ(encodeTga(Image(1, 1, 4, {1, 0, 0, 0.5f})),
            bytesOf({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 32, 0x28, 0, 0, 255, 128}));
}

TEST(Tga, CodesSurvive) {
  for (const int channels : {3, 4}) {
    const Image image = imageOfCodes(300, 5, channels);
    EXPECT_EQ(bitsOf(decodeTga(encodeTga(image), "a.tga")), bitsOf(image));
  }
}

std::vector<int> codesOf(const Image& image) {
  std::vector<int> codes;
  for (const float sample : image.samples()) codes.push_back(encodeSrgb8(sample));
  return codes;
}

TEST(Tga, EveryOrderOfRowsAndColumns) {
  // Grey 2 x 2, stored 1 2 / 3 4, after an identification field of 3 bytes.
  const auto stored = [](int descriptor) {
    return bytesOf(
        {3, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 8, descriptor, 'a', 'b', 'c', 1, 2, 3, 4});
  };
  EXPECT_EQ(codesOf(decodeTga(stored(0x20), "a.tga")), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(codesOf(decodeTga(stored(0x00), "a.tga")), (std::vector<int>{3, 4, 1, 2}));
  EXPECT_EQ(codesOf(decodeTga(stored(0x30), "a.tga")), (std::vector<int>{2, 1, 4, 3}));
  EXPECT_EQ(codesOf(decodeTga(stored(0x10), "a.tga")), (std::vector<int>{4, 3, 2, 1}));
}

TEST(Tga, RunLengthPacketsMayCrossRows) {
  // 3 x 2, blue green red: a run of four (1,2,3), then two pixels as they are.
  const auto file = bytesOf(
      {0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 2, 0, 24, 0x20, 0x83, 1, 2, 3, 1, 4, 5, 6, 7, 8, 9});
  EXPECT_EQ(codesOf(decodeTga(file, "a.tga")),
            (std::vector<int>{3, 2, 1, 3, 2, 1, 3, 2, 1, 3, 2, 1, 6, 5, 4, 9, 8, 7}));
  expectEveryTruncationRefused(readTga, file);
  expectDamageSurvived(readTga, file, 4000);
  auto tooLong = file;
  tooLong[18] = std::byte{0x86};  // seven pixels for six
  EXPECT_FALSE(readsOrRefuses(readTga, tooLong));
}

/// Linear values of a level of 31, as sRGB has them.
float level(int of31) { return float(linearFromSrgb(of31 / 31.0)); }

/// A TGA of 2 x 2 in which the top row is stored first, or of another header.
std::vector<std::byte> tgaOf(int kind, int bits, int descriptor, std::vector<int> palette, int paletteBits,
                             const std::vector<int>& data, int firstColour = 0) {
  const int colours = paletteBits == 0 ? 0 : int(palette.size()) / ((paletteBits + 7) / 8);
  auto file = bytesOf({0, paletteBits != 0, kind, firstColour, 0, colours, 0, paletteBits, 0, 0, 0, 0, 2, 0,
                       2, 0, bits, descriptor});
  for (const auto* part : {&std::as_const(palette), &data})
    for (const int value : *part) file.push_back(std::byte(value));
  return file;
}

TEST(Tga, FiveBitsAreAThirtyFirstEach) {
  // A1R5G5B5, the low byte first: red, green, blue with 1 for alpha, and levels 16, 8, 4 of 31 with 0.
  const std::vector<int> raw = {0x00, 0xfc, 0xe0, 0x83, 0x1f, 0x80, 0x04, 0x41},
                         runs = {0x02, 0x00, 0xfc, 0xe0, 0x83, 0x1f, 0x80, 0x80, 0x04, 0x41};
  const std::vector<float> colours = {1, 0, 0, 0, 1, 0, 0, 0, 1, level(16), level(8), level(4)};
  const auto samples = [](const Image& image) {
    return std::vector<float>(image.samples().begin(), image.samples().end());
  };
  for (const int bits : {15, 16}) {
    EXPECT_EQ(samples(decodeTga(tgaOf(2, bits, 0x20, {}, 0, raw), "a.tga")), colours);
    EXPECT_EQ(samples(decodeTga(tgaOf(10, bits, 0x20, {}, 0, runs), "a.tga")), colours);
    // From the bottom row on, and from the right column on.
    const auto turned = samples(decodeTga(tgaOf(2, bits, 0x10, {}, 0, raw), "a.tga"));
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(turned[i], colours[3 * (3 - i / 3) + i % 3]) << i;
    expectEveryTruncationRefused(readTga, tgaOf(10, bits, 0x20, {}, 0, runs));
    expectEveryTruncationRefused(readTga, tgaOf(2, bits, 0x20, {}, 0, raw));
    expectDamageSurvived(readTga, tgaOf(10, bits, 0x21, {}, 0, runs), 2000);
  }
  const Image alpha = decodeTga(tgaOf(2, 16, 0x21, {}, 0, raw), "a.tga", Codes::Data);
  ASSERT_EQ(alpha.channels(), 4);
  EXPECT_EQ(samples(alpha), (std::vector<float>{1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, float(16 / 31.0),
                                                float(8 / 31.0), float(4 / 31.0), 0}));
}

TEST(Tga, PalettesAreTheColoursOfTheirNumbers) {
  // Blue, green, red of three colours; pixels 2 0 / 1 1.
  const std::vector<int> palette = {1, 2, 3, 4, 5, 6, 7, 8, 9}, raw = {2, 0, 1, 1},
                         runs = {0x01, 2, 0, 0x81, 1}, wide = {2, 0, 0, 0, 1, 0, 1, 0};
  const std::vector<int> codes = {9, 8, 7, 3, 2, 1, 6, 5, 4, 6, 5, 4};
  const auto read = [](const std::vector<std::byte>& file) { return codesOf(decodeTga(file, "a.tga")); };
  EXPECT_EQ(read(tgaOf(1, 8, 0x20, palette, 24, raw)), codes);
  EXPECT_EQ(read(tgaOf(9, 8, 0x20, palette, 24, runs)), codes);
  EXPECT_EQ(read(tgaOf(1, 16, 0x20, palette, 24, wide)), codes);
  EXPECT_EQ(read(tgaOf(1, 8, 0x00, palette, 24, raw)),
            (std::vector<int>{6, 5, 4, 6, 5, 4, 9, 8, 7, 3, 2, 1}));
  EXPECT_EQ(read(tgaOf(9, 8, 0x10, palette, 24, runs)),
            (std::vector<int>{6, 5, 4, 6, 5, 4, 3, 2, 1, 9, 8, 7}));
  EXPECT_EQ(read(tgaOf(1, 8, 0x20, palette, 24, {12, 10, 11, 11}, 10)), codes);  // they count from 10

  // Colours of 16 bits, and of 32 with an alpha: white that is half seen, then blue.
  EXPECT_EQ(decodeTga(tgaOf(1, 8, 0x20, {0x04, 0x41}, 16, {0, 0, 0, 0}), "a.tga").pixel(1, 1)[1], level(8));
  const Image alpha =
      decodeTga(tgaOf(1, 8, 0x28, {255, 255, 255, 51, 255, 0, 0, 255}, 32, {0, 1, 1, 0}), "a.tga");
  ASSERT_EQ(alpha.channels(), 4);
  EXPECT_EQ(alpha.pixel(1, 1)[3], 0.2f);
  EXPECT_EQ(alpha.pixel(1, 0)[2], 1);
  EXPECT_EQ(alpha.pixel(1, 0)[0], 0);

  // Of true colours it says nothing.
  const std::vector<int> pixels = {9, 8, 7, 6, 5, 4, 3, 2, 1, 0, 1, 2};
  EXPECT_EQ(read(tgaOf(2, 24, 0x20, palette, 24, pixels)), read(tgaOf(2, 24, 0x20, {}, 0, pixels)));
}

TEST(Tga, PalettesThatLieAreRefused) {
  const std::vector<int> palette = {1, 2, 3, 4, 5, 6, 7, 8, 9}, runs = {0x01, 2, 0, 0x81, 1};
  for (const auto& file :
       {tgaOf(1, 8, 0x20, palette, 24, {2, 0, 1, 1}), tgaOf(9, 8, 0x20, palette, 24, runs)}) {
    expectEveryTruncationRefused(readTga, file);
    expectDamageSurvived(readTga, file, 4000);
  }
  const auto refusal = [](const std::vector<std::byte>& file) {
    try {
      (void)decodeTga(file, "a.tga");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal(tgaOf(1, 8, 0x20, palette, 24, {2, 3, 1, 1})),
              HasSubstr("'a.tga' as TGA: a pixel has colour 3 of a palette of 3 from 0 on"));
  EXPECT_THAT(refusal(tgaOf(1, 8, 0x20, palette, 24, {2, 3, 1, 1}, 2)),
              HasSubstr("colour 1 of a palette of 3 from 2 on"));
  EXPECT_THAT(refusal(tgaOf(1, 8, 0x20, {}, 24, {0, 0, 0, 0})), HasSubstr("colour 0 of a palette of 0"));
  EXPECT_THAT(refusal(tgaOf(1, 8, 0x20, palette, 12, {0, 0, 0, 0})), HasSubstr("is not supported"));
  EXPECT_THAT(refusal(tgaOf(1, 24, 0x20, palette, 24, {0, 0, 0, 0})), HasSubstr("is not supported"));
  EXPECT_THAT(refusal(tgaOf(1, 8, 0x20, {}, 0, {0, 0, 0, 0})), HasSubstr("is not supported"));
  auto many = tgaOf(1, 8, 0x20, palette, 32, {0, 0, 0, 0});
  many[5] = many[6] = std::byte{0xff};
  EXPECT_THAT(refusal(many), HasSubstr("a palette of 65535 colours cannot be in 13 bytes"));
}

TEST(Tga, DamageIsRefused) {
  const auto file = encodeTga(imageOfColours(9, 6, 4, 3));
  expectEveryTruncationRefused(readTga, file);
  expectDamageSurvived(readTga, file, 4000);
  auto palette = file;
  palette[1] = std::byte{1};
  EXPECT_FALSE(readsOrRefuses(readTga, palette));
}

// --- PFM

TEST(Pfm, BytesAreThoseOfTheSpecification) {
  const auto file = encodePfm(Image(1, 2, 1, {1.0f, -2.0f}));
  EXPECT_EQ(textOf(file),
            std::string("Pf\n1 2\n-1.0\n") + std::string("\x00\x00\x00\xc0\x00\x00\x80\x3f", 8));
}

TEST(Pfm, EveryBitSurvives) {
  for (const int channels : {1, 3}) {
    const Image image = imageOfAnyBits(13, 7, channels, 4);
    const Image again = decodePfm(encodePfm(image), "a.pfm");
    EXPECT_EQ(again.width(), 13);
    EXPECT_EQ(again.height(), 7);
    EXPECT_EQ(bitsOf(again), bitsOf(image));
  }
}

TEST(Pfm, ReadsBigEndian) {
  const std::string text = std::string("Pf 1 2 1.0\n") + std::string("\xc0\x00\x00\x00\x3f\x80\x00\x00", 8);
  const Image image = decodePfm(std::as_bytes(std::span(text)), "a.pfm");
  EXPECT_EQ(image.pixel(0, 0)[0], 1.0f);
  EXPECT_EQ(image.pixel(0, 1)[0], -2.0f);
}

TEST(Pfm, AlphaIsRefused) {
  EXPECT_EQ(kindThrownBy([] { static_cast<void>(encodePfm(Image(1, 1, 4))); }), ErrorKind::Usage);
}

TEST(Pfm, DamageIsRefused) {
  const auto file = encodePfm(imageOfAnyBits(5, 4, 3, 5));
  expectEveryTruncationRefused(decodePfm, file);
  expectDamageSurvived(decodePfm, file, 4000);
  for (const char* header :
       {"PF\n-3 4\n-1.0\n", "PF\n99999999999999999999 4\n-1.0\n", "PF\n3 4\n0\n", "PF\n3 4\nnan\n",
        "P6\n3 4\n255\n", "PF\n60000 60000\n-1.0\n", "PF\n3x 4\n-1\n"}) {
    const std::string text = std::string(header) + std::string(200, 'x');
    EXPECT_FALSE(readsOrRefuses(decodePfm, std::as_bytes(std::span(text)))) << header;
  }
}

// --- EXR

TEST(Exr, EveryBitSurvives) {
  for (const int channels : {1, 3, 4}) {
    const Image image = imageOfAnyBits(33, 35, channels, 6);  // three blocks of 16 lines, the last of 3
    const Image again = decodeExr(encodeExr(image), "a.exr");
    ASSERT_EQ(again.channels(), channels);
    EXPECT_EQ(bitsOf(again), bitsOf(image));
  }
}

TEST(Exr, HoldsOnlyTheRequiredAttributes) {
  const auto file = encodeExr(imageOfColours(40, 40, 3, 7));
  EXPECT_EQ(file, encodeExr(imageOfColours(40, 40, 3, 7)));
  std::vector<std::string> names;
  const std::string text = textOf(file);
  for (std::size_t at = 8; text[at] != 0;) {
    names.emplace_back(text.c_str() + at);
    at += names.back().size() + 1;
    at += std::strlen(text.c_str() + at) + 1;
    std::uint32_t size = 0;
    std::memcpy(&size, text.data() + at, 4);
    at += 4 + size;
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"channels", "compression", "dataWindow", "displayWindow", "lineOrder",
                                      "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth"}));
}

TEST(Exr, CompressesWhatIsSmooth) {
  const Image image(256, 256, 3);
  EXPECT_LT(encodeExr(image).size(), image.samples().size_bytes() / 50);
}

TEST(Exr, DamageIsRefused) {
  const auto file = encodeExr(imageOfColours(5, 20, 1, 8));
  EXPECT_TRUE(readsOrRefuses(decodeExr, file));
  expectEveryTruncationRefused(decodeExr, file);
  expectDamageSurvived(decodeExr, file, 4000);
}

TEST(Exr, SizeThatCannotBeTrueIsRefusedBeforeAllocating) {
  auto file = encodeExr(imageOfColours(5, 20, 1, 8));
  const std::string text = textOf(file);
  const std::size_t window =
      text.find("dataWindow") + std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4;
  for (const std::int32_t side : {16000, 65534, 2147483646}) {
    std::memcpy(file.data() + window + 8, &side, 4);
    std::memcpy(file.data() + window + 12, &side, 4);
    EXPECT_FALSE(readsOrRefuses(decodeExr, file)) << side;
  }
}

// --- the choice by suffix

TEST(ImageFormat, SuffixDecidesInEitherCase) {
  EXPECT_EQ(imageFormatOf("a.png"), ImageFormat::Png);
  EXPECT_EQ(imageFormatOf("dir.exr/a.TGA"), ImageFormat::Tga);
  EXPECT_EQ(imageFormatOf("a.b.Exr"), ImageFormat::Exr);
  EXPECT_EQ(imageFormatOf("a.pFm"), ImageFormat::Pfm);
  EXPECT_EQ(imageFormatOf("a.jpg"), std::nullopt);
  EXPECT_EQ(imageFormatOf("png"), std::nullopt);
  EXPECT_EQ(imageFormatOf("dir.png/a"), std::nullopt);
}

TEST(ImageFormat, UnknownSuffixNamesTheKnown) {
  for (const char* path : {"a.jpg", "a", "a.", ".png"}) {
    try {
      saveImage(Image(1, 1, 3), path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Usage);
      for (const char* known : {".png", ".tga", ".exr", ".pfm"})
        EXPECT_NE(error.hint().find(known), std::string::npos) << error.hint();
    }
  }
}

TEST(ImageFormat, SavesAndLoadsEach) {
  const ScratchFolder folder;
  const Image codes = imageOfCodes(6, 4, 3);
  for (const char* name : {"a.png", "b.tga", "c.pfm", "d.exr"}) {
    codes.save(folder / name);
    EXPECT_EQ(bitsOf(loadImage(folder / name)), bitsOf(codes)) << name;
  }
}

TEST(ImageFormat, MissingFileIsAnErrorOfTheScene) {
  const ScratchFolder folder;
  EXPECT_EQ(kindThrownBy([&] { static_cast<void>(loadImage(folder / "none.png")); }), ErrorKind::Scene);
  std::filesystem::create_directory(folder / "folder.png");
  EXPECT_EQ(kindThrownBy([&] { static_cast<void>(loadImage(folder / "folder.png")); }), ErrorKind::Scene);
}

}  // namespace
}  // namespace luxo
