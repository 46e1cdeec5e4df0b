// SPDX-License-Identifier: Apache-2.0
#include "image/png.h"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <string>

#include "base/assert.h"
#include "image/bytes.h"
#include "image/srgb.h"

namespace luxo {
namespace {

struct PngFailure {
  std::string why;
};

// libpng reports an error by a callback that must not return; it jumps back into `attempt`.
void fail(png_structp png, png_const_charp why) {
  static_cast<PngFailure*>(png_get_error_ptr(png))->why = why;
  std::longjmp(png_jmpbuf(png), 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

// Runs libpng calls; false after an error. The body must own nothing that needs a destructor: the jump skips
// it.
template <class Body>
bool attempt(png_structp png, const Body& body) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  body();
  return true;
}

struct Writer {
  PngFailure failure;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, fail, ignoreWarning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

struct Reader {
  PngFailure failure;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, fail, ignoreWarning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  std::span<const std::byte> left;

  explicit Reader(std::span<const std::byte> bytes) : left(bytes) {}
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void requireMemory(const void* png, const void* info) {
  if (png == nullptr || info == nullptr)
    throw Error(ErrorKind::Retry, "libpng cannot start: out of memory or not the version luxo was built for");
}

void appendOutput(png_structp png, png_bytep data, std::size_t size) {
  append(*static_cast<std::vector<std::byte>*>(png_get_io_ptr(png)), std::as_bytes(std::span(data, size)));
}

void takeInput(png_structp png, png_bytep data, std::size_t size) {
  auto& left = *static_cast<std::span<const std::byte>*>(png_get_io_ptr(png));
  if (size > left.size()) png_error(png, "the file ends too early");
  std::memcpy(data, left.data(), size);
  left = left.subspan(size);
}

void writeHeader(png_structp png, png_infop info, const Image& image, Codes codes) {
  png_set_IHDR(png, info, png_uint_32(image.width()), png_uint_32(image.height()), 8,
               image.channels() == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (codes == Codes::Srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_compression_level(png, 1);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_write_info(png, info);
}

void encodeRow(std::span<const float> row, int channels, Codes codes, std::span<std::uint8_t> out) {
  if (codes == Codes::Srgb) return encodePixels8(row, channels, out);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = encodeAlpha8(row[channels == 1 ? i / 3 : i]);
}

struct Layout {
  png_uint_32 width, height;
  int channels, bits;
};

// After this every row holds 1 to 4 interleaved channels of 8 or 16 bits (big endian).
Layout readLayout(png_structp png, png_infop info) {
  png_set_expand(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  return {png_get_image_width(png, info), png_get_image_height(png, info), png_get_channels(png, info),
          png_get_bit_depth(png, info)};
}

struct Samples {
  const Layout& layout;
  const std::vector<std::uint8_t>& bytes;

  Codes codes;

  // Sample i as a linear value; alpha is not on the sRGB curve.
  float operator()(std::size_t i, bool isAlpha) const {
    const bool alpha = isAlpha || codes == Codes::Data;
    if (layout.bits == 8) return alpha ? float(bytes[i]) / 255.0f : decodeSrgb8(bytes[i]);
    const double value = (bytes[2 * i] * 256 + bytes[2 * i + 1]) / 65535.0;
    return float(alpha ? value : linearFromSrgb(value));
  }
};

Image toLinear(const Layout& layout, const std::vector<std::uint8_t>& bytes, Codes codes) {
  const Samples sample{layout, bytes, codes};
  const bool greyAlpha = layout.channels == 2;
  Image image(int(layout.width), int(layout.height), greyAlpha ? 4 : layout.channels);
  const auto out = image.samples();
  if (greyAlpha) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = sample(i / 4 * 2 + (i % 4 == 3), i % 4 == 3);
  } else {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = sample(i, layout.channels == 4 && i % 4 == 3);
  }
  return image;
}

}  // namespace

std::vector<std::byte> encodePng(const Image& image, Codes codes) {
  LUXO_REQUIRE(!image.empty());
  std::vector<std::byte> out;
  std::vector<std::uint8_t> row(std::size_t(image.width()) * (image.channels() == 4 ? 4 : 3));
  out.reserve(row.size() * std::size_t(image.height()) / 4);
  Writer writer;
  requireMemory(writer.png, writer.info);
  const bool done = attempt(writer.png, [&] {
    png_set_write_fn(writer.png, &out, appendOutput, [](png_structp) {});
    writeHeader(writer.png, writer.info, image, codes);
    for (int y = 0; y < image.height(); ++y) {
      encodeRow(image.row(y), image.channels(), codes, row);
      png_write_row(writer.png, row.data());
    }
    png_write_end(writer.png, nullptr);
  });
  if (!done) throw Error(ErrorKind::Internal, fmt::format("cannot encode PNG: {}", writer.failure.why));
  return out;
}

Image decodePng(std::span<const std::byte> bytes, std::string_view name, Codes codes) {
  Reader reader(bytes);
  requireMemory(reader.png, reader.info);
  const auto orThrow = [&](bool done) {
    if (!done) throwBadImage(name, "PNG", reader.failure.why);
  };
  Layout layout{};
  orThrow(attempt(reader.png, [&] {
    png_set_read_fn(reader.png, &reader.left, takeInput);
    png_set_user_limits(reader.png, kMaxImageSide, kMaxImageSide);
    png_read_info(reader.png, reader.info);
  }));
  const double storedBits =
      png_get_bit_depth(reader.png, reader.info) * png_get_channels(reader.png, reader.info);
  requirePlausibleSize(name, "PNG", png_get_image_width(reader.png, reader.info),
                       png_get_image_height(reader.png, reader.info), storedBits / 8 / kBestDeflateRatio,
                       bytes.size());
  orThrow(attempt(reader.png, [&] { layout = readLayout(reader.png, reader.info); }));
  const std::size_t rowBytes = png_get_rowbytes(reader.png, reader.info);
  std::vector<std::uint8_t> samples(rowBytes * layout.height);
  std::vector<png_bytep> rows(layout.height);
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = samples.data() + y * rowBytes;
  orThrow(attempt(reader.png, [&] {
    png_read_image(reader.png, rows.data());
    png_read_end(reader.png, nullptr);
  }));
  return toLinear(layout, samples, codes);
}

}  // namespace luxo
