// SPDX-License-Identifier: Apache-2.0
#include "image/tga.h"

#include <algorithm>
#include <array>

#include "base/assert.h"
#include "image/bytes.h"
#include "image/srgb.h"

namespace luxo {
namespace {

constexpr std::size_t kHeaderBytes = 18;
constexpr int kTrueColour = 2;
constexpr int kGrey = 3;
constexpr int kRunLength = 8;
constexpr int kTopRowFirst = 0x20;
constexpr int kRightColumnFirst = 0x10;
constexpr int kAlphaBits = 0x0f;

struct Header {
  int idBytes, paletteKind, kind;
  int width, height, bitsPerPixel, descriptor;

  explicit Header(std::span<const std::byte> bytes) {
    const auto byte = [&](std::size_t i) { return std::to_integer<int>(bytes[i]); };
    idBytes = byte(0);
    paletteKind = byte(1);
    kind = byte(2);
    width = byte(12) + 256 * byte(13);
    height = byte(14) + 256 * byte(15);
    bitsPerPixel = byte(16);
    descriptor = byte(17);
  }

  [[nodiscard]] bool runLength() const { return (kind & kRunLength) != 0; }
  [[nodiscard]] std::size_t bytesPerPixel() const { return std::size_t(bitsPerPixel) / 8; }
  [[nodiscard]] std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
  [[nodiscard]] int channels() const {
    if (bitsPerPixel == 8) return 1;
    return bitsPerPixel == 32 && (descriptor & kAlphaBits) == 8 ? 4 : 3;
  }
};

void requireSupported(const Header& header, std::string_view name) {
  const int kind = header.kind & ~kRunLength;
  const bool grey = kind == kGrey && header.bitsPerPixel == 8;
  const bool colour = kind == kTrueColour && (header.bitsPerPixel == 24 || header.bitsPerPixel == 32);
  if (header.paletteKind != 0 || (!grey && !colour))
    throwBadImage(
        name, "TGA",
        fmt::format("type {} with {} bits per pixel is not supported (8 bit grey, 24 and 32 bit colour are)",
                    header.kind, header.bitsPerPixel));
}

// Packets of up to 128 pixels: a count and one pixel to repeat, or a count and as many pixels.
std::vector<std::byte> expandRuns(std::span<const std::byte> in, const Header& header,
                                  std::string_view name) {
  const std::size_t pixelBytes = header.bytesPerPixel();
  const std::size_t wanted = header.pixels() * pixelBytes;
  std::vector<std::byte> out;
  out.reserve(wanted);
  while (out.size() < wanted) {
    if (in.empty()) throwBadImage(name, "TGA", "the run-length data end too early");
    const int packet = std::to_integer<int>(in[0]);
    const std::size_t count = std::size_t(packet & 0x7f) + 1;
    const bool repeated = (packet & 0x80) != 0;
    const std::size_t stored = repeated ? pixelBytes : count * pixelBytes;
    if (in.size() - 1 < stored) throwBadImage(name, "TGA", "the run-length data end too early");
    if (out.size() + count * pixelBytes > wanted)
      throwBadImage(name, "TGA", "the run-length data do not fit the size");
    const auto pixels = in.subspan(1, stored);
    for (std::size_t i = 0; i < (repeated ? count : 1); ++i) append(out, pixels);
    in = in.subspan(1 + stored);
  }
  return out;
}

// Blue, green, red, alpha in the file; red, green, blue, alpha in an image.
void readPixel(std::span<const std::byte> stored, std::span<float> pixel, Codes codes) {
  const auto linear = [&](std::size_t i) {
    const auto code = std::to_integer<std::uint8_t>(stored[i]);
    return codes == Codes::Data ? float(code) / 255.0f : decodeSrgb8(code);
  };
  if (pixel.size() == 1) {
    pixel[0] = linear(0);
    return;
  }
  for (std::size_t c = 0; c < 3; ++c) pixel[c] = linear(2 - c);
  if (pixel.size() == 4) pixel[3] = float(std::to_integer<int>(stored[3])) / 255.0f;
}

}  // namespace

std::vector<std::byte> encodeTga(const Image& image) {
  LUXO_REQUIRE(!image.empty());
  const bool alpha = image.channels() == 4;
  const std::size_t pixelBytes = alpha ? 4 : 3;
  std::array<std::uint8_t, kHeaderBytes> header{};
  header[2] = kTrueColour;
  header[12] = std::uint8_t(image.width() % 256);
  header[13] = std::uint8_t(image.width() / 256);
  header[14] = std::uint8_t(image.height() % 256);
  header[15] = std::uint8_t(image.height() / 256);
  header[16] = std::uint8_t(8 * pixelBytes);
  header[17] = std::uint8_t(kTopRowFirst | (alpha ? 8 : 0));

  std::vector<std::byte> out;
  std::vector<std::uint8_t> row(std::size_t(image.width()) * pixelBytes);
  out.reserve(kHeaderBytes + row.size() * std::size_t(image.height()));
  append(out, std::as_bytes(std::span(header)));
  for (int y = 0; y < image.height(); ++y) {
    encodePixels8(image.row(y), image.channels(), row);
    for (std::size_t i = 0; i < row.size(); i += pixelBytes) std::swap(row[i], row[i + 2]);
    append(out, std::as_bytes(std::span(row)));
  }
  return out;
}

bool mayBeTga(std::span<const std::byte> bytes) {
  constexpr std::array<int, 6> kKinds = {1, 2, 3, 9, 10, 11};
  constexpr std::array<int, 5> kBits = {8, 15, 16, 24, 32};
  if (bytes.size() < kHeaderBytes) return false;
  const Header header(bytes);
  return header.paletteKind <= 1 && std::ranges::find(kKinds, header.kind) != kKinds.end() &&
         std::ranges::find(kBits, header.bitsPerPixel) != kBits.end();
}

Image decodeTga(std::span<const std::byte> bytes, std::string_view name, Codes codes) {
  if (bytes.size() < kHeaderBytes) throwBadImage(name, "TGA", "it is shorter than a header");
  const Header header(bytes);
  requireSupported(header, name);
  const double runLengthGain =
      header.runLength() ? 128.0 * double(header.bytesPerPixel()) / (1.0 + double(header.bytesPerPixel()))
                         : 1.0;
  const auto body = bytes.subspan(std::min(bytes.size(), kHeaderBytes + std::size_t(header.idBytes)));
  requirePlausibleSize(name, "TGA", header.width, header.height,
                       double(header.bytesPerPixel()) / runLengthGain, body.size());

  std::vector<std::byte> expanded;
  if (header.runLength()) expanded = expandRuns(body, header, name);
  const std::span<const std::byte> stored = header.runLength() ? std::span<const std::byte>(expanded) : body;

  Image image(header.width, header.height, header.channels());
  for (int row = 0; row < header.height; ++row) {
    for (int column = 0; column < header.width; ++column) {
      const int y = (header.descriptor & kTopRowFirst) != 0 ? row : header.height - 1 - row;
      const int x = (header.descriptor & kRightColumnFirst) != 0 ? header.width - 1 - column : column;
      const std::size_t at =
          (std::size_t(row) * std::size_t(header.width) + std::size_t(column)) * header.bytesPerPixel();
      readPixel(stored.subspan(at, header.bytesPerPixel()), image.pixel(x, y), codes);
    }
  }
  return image;
}

}  // namespace luxo
