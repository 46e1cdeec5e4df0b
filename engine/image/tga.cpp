// SPDX-License-Identifier: Apache-2.0
#include "image/tga.h"

#include <algorithm>
#include <array>

#include "base/assert.h"
#include "base/srgb_curve.h"
#include "image/bytes.h"
#include "image/srgb.h"

namespace luxo {
namespace {

constexpr std::size_t kHeaderBytes = 18;
constexpr int kIndexed = 1;
constexpr int kTrueColour = 2;
constexpr int kGrey = 3;
constexpr int kRunLength = 8;
constexpr int kTopRowFirst = 0x20;
constexpr int kRightColumnFirst = 0x10;
constexpr int kAlphaBits = 0x0f;

constexpr bool areColourBits(int bits) { return bits == 15 || bits == 16 || bits == 24 || bits == 32; }

constexpr std::size_t bytesOfBits(int bits) { return std::size_t(bits + 7) / 8; }

struct Header {
  int idBytes, paletteKind, kind;
  int firstColour, colours, colourBits;  // of the palette
  int width, height, bitsPerPixel, descriptor;

  explicit Header(std::span<const std::byte> bytes) {
    const auto byte = [&](std::size_t i) { return std::to_integer<int>(bytes[i]); };
    const auto word = [&](std::size_t i) { return byte(i) + 256 * byte(i + 1); };
    idBytes = byte(0);
    paletteKind = byte(1);
    kind = byte(2);
    firstColour = word(3);
    colours = word(5);
    colourBits = byte(7);
    width = word(12);
    height = word(14);
    bitsPerPixel = byte(16);
    descriptor = byte(17);
  }

  [[nodiscard]] bool runLength() const { return (kind & kRunLength) != 0; }
  [[nodiscard]] bool indexed() const { return (kind & ~kRunLength) == kIndexed; }
  [[nodiscard]] std::size_t bytesPerPixel() const { return bytesOfBits(bitsPerPixel); }
  [[nodiscard]] std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
  /// True colours may come with one, too, which says nothing of them.
  [[nodiscard]] std::size_t paletteBytes() const {
    return paletteKind == 1 ? std::size_t(colours) * bytesOfBits(colourBits) : 0;
  }
  /// Of a pixel, or of the colour that it is the number of.
  [[nodiscard]] int bitsOfColour() const { return indexed() ? colourBits : bitsPerPixel; }
  [[nodiscard]] int channels() const {
    const int bits = bitsOfColour(), alphaBits = descriptor & kAlphaBits;
    if (bits == 8) return 1;
    return (bits == 32 && alphaBits == 8) || (bits == 16 && alphaBits == 1) ? 4 : 3;
  }
};

void requireSupported(const Header& header, std::string_view name) {
  const int kind = header.kind & ~kRunLength, bits = header.bitsPerPixel;
  const bool grey = kind == kGrey && bits == 8;
  const bool colour = kind == kTrueColour && areColourBits(bits);
  const bool indexed = kind == kIndexed && (bits == 8 || bits == 16) && header.paletteKind == 1;
  const bool palette = header.paletteKind == 1 && areColourBits(header.colourBits);
  if ((header.paletteKind != 0 && !palette) || (!grey && !colour && !indexed))
    throwBadImage(
        name, "TGA",
        fmt::format("type {} with {} bits per pixel is not supported, a palette of {} bits included (8 "
                    "bit grey and 15, 16, 24, 32 bit colour are, and palettes of these)",
                    header.kind, bits, header.paletteKind == 0 ? 0 : header.colourBits));
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

// There are few codes, and the curve is a power.
float decodeSrgb5(std::size_t code) {
  static const auto kLinear = [] {
    std::array<float, 32> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = float(linearFromSrgb(double(i) / 31.0));
    return linear;
  }();
  return kLinear[code];
}

// Blue, green, red, alpha in the file, of which 15 and 16 bits have five of each colour; red, green, blue,
// alpha in an image.
void readColour(std::span<const std::byte> stored, std::span<float> pixel, Codes codes) {
  const auto byte = [&](std::size_t i) { return std::to_integer<std::uint8_t>(stored[i]); };
  const auto linear = [&](std::uint8_t code) {
    return codes == Codes::Data ? float(code) / 255.0f : decodeSrgb8(code);
  };
  if (pixel.size() == 1) {
    pixel[0] = linear(byte(0));
    return;
  }
  if (stored.size() == 2) {
    const int bits = byte(0) + 256 * byte(1);
    for (int c = 0; c < 3; ++c) {
      const int code = bits >> (10 - 5 * c) & 31;
      pixel[std::size_t(c)] = codes == Codes::Data ? float(code / 31.0) : decodeSrgb5(std::size_t(code));
    }
    if (pixel.size() == 4) pixel[3] = float(bits >> 15);
    return;
  }
  for (std::size_t c = 0; c < 3; ++c) pixel[c] = linear(byte(2 - c));
  if (pixel.size() == 4) pixel[3] = float(byte(3)) / 255.0f;
}

/// What each pixel's bytes stand for.
class Colours {
 public:
  Colours(const Header& header, std::span<const std::byte> palette, std::string_view name, Codes codes)
      : header_(header), name_(name), codes_(codes), channels_(std::size_t(header.channels())) {
    if (!header.indexed()) return;
    const std::size_t bytes = bytesOfBits(header.colourBits), colours = std::size_t(header.colours);
    palette_.resize(colours * channels_);
    for (std::size_t i = 0; i < colours; ++i)
      readColour(palette.subspan(i * bytes, bytes), std::span(palette_).subspan(i * channels_, channels_),
                 codes);
  }

  void read(std::span<const std::byte> stored, std::span<float> pixel) const {
    if (!header_.indexed()) return readColour(stored, pixel, codes_);
    const auto byte = [&](std::size_t i) { return std::to_integer<int>(stored[i]); };
    const int number = stored.size() == 1 ? byte(0) : byte(0) + 256 * byte(1);
    const int colour = number - header_.firstColour;
    if (colour < 0 || colour >= header_.colours)
      throwBadImage(name_, "TGA",
                    fmt::format("a pixel has colour {} of a palette of {} from {} on", number,
                                header_.colours, header_.firstColour));
    std::copy_n(palette_.begin() + std::ptrdiff_t(std::size_t(colour) * channels_), channels_, pixel.begin());
  }

 private:
  const Header& header_;
  std::string_view name_;
  Codes codes_;
  std::size_t channels_;
  std::vector<float> palette_;
};

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
  const auto rest = bytes.subspan(std::min(bytes.size(), kHeaderBytes + std::size_t(header.idBytes)));
  if (rest.size() < header.paletteBytes())
    throwBadImage(name, "TGA",
                  fmt::format("a palette of {} colours cannot be in {} bytes; is the file cut short?",
                              header.colours, rest.size()));
  const auto body = rest.subspan(header.paletteBytes());
  requirePlausibleSize(name, "TGA", header.width, header.height,
                       double(header.bytesPerPixel()) / runLengthGain, body.size());

  std::vector<std::byte> expanded;
  if (header.runLength()) expanded = expandRuns(body, header, name);
  const std::span<const std::byte> stored = header.runLength() ? std::span<const std::byte>(expanded) : body;

  const Colours colours(header, rest.first(header.paletteBytes()), name, codes);
  Image image(header.width, header.height, header.channels());
  for (int row = 0; row < header.height; ++row) {
    for (int column = 0; column < header.width; ++column) {
      const int y = (header.descriptor & kTopRowFirst) != 0 ? row : header.height - 1 - row;
      const int x = (header.descriptor & kRightColumnFirst) != 0 ? header.width - 1 - column : column;
      const std::size_t at =
          (std::size_t(row) * std::size_t(header.width) + std::size_t(column)) * header.bytesPerPixel();
      colours.read(stored.subspan(at, header.bytesPerPixel()), image.pixel(x, y));
    }
  }
  return image;
}

}  // namespace luxo
