// SPDX-License-Identifier: Apache-2.0
#include "image/jpeg.h"

#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <string>

// After <cstdio>, whose FILE it needs.
#include <jpeglib.h>

#include "image/bytes.h"
#include "image/srgb.h"

namespace luxo {
namespace {

// Eight by eight pixels take a bit at least: their one Huffman code.
constexpr double kLeastBytesPerPixel = 1.0 / 512;
// A progressive file may hold any number of scans of nothing, each a pass over the picture: what honest
// programs write has ten or so.
constexpr int kMaxScans = 100;

struct JpegFailure {
  jpeg_error_mgr manager;
  std::jmp_buf jump;
  char why[JMSG_LENGTH_MAX];
};

void fail(j_common_ptr info) {
  auto* failure = reinterpret_cast<JpegFailure*>(info->err);
  info->err->format_message(info, failure->why);
  std::longjmp(failure->jump, 1);
}

// Warnings are damage, too: what is missing would be grey.
void warn(j_common_ptr info, int level) {
  if (level < 0) fail(info);
}

void countScans(j_common_ptr info) {
  if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > kMaxScans) {
    auto* failure = reinterpret_cast<JpegFailure*>(info->err);
    std::snprintf(failure->why, sizeof failure->why, "more than %d scans", kMaxScans);
    std::longjmp(failure->jump, 1);
  }
}

struct Decoder {
  jpeg_decompress_struct info{};
  JpegFailure failure{};
  jpeg_progress_mgr progress{};

  Decoder() {
    info.err = jpeg_std_error(&failure.manager);
    failure.manager.error_exit = fail;
    failure.manager.emit_message = warn;
    progress.progress_monitor = countScans;
  }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { jpeg_destroy_decompress(&info); }
};

// Runs libjpeg calls; false after an error. The body must own nothing that needs a destructor: the jump skips
// it.
template <class Body>
bool attempt(Decoder& decoder, const Body& body) {
  if (setjmp(decoder.failure.jump) != 0) return false;
  body();
  return true;
}

}  // namespace

Image decodeJpeg(std::span<const std::byte> bytes, std::string_view name, Codes codes) {
  Decoder decoder;
  jpeg_decompress_struct& info = decoder.info;
  const auto orThrow = [&](bool done) {
    if (!done) throwBadImage(name, "JPEG", decoder.failure.why);
  };
  orThrow(attempt(decoder, [&] {
    jpeg_create_decompress(&info);
    info.progress = &decoder.progress;
    jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&info, TRUE);
  }));
  requirePlausibleSize(name, "JPEG", info.image_width, info.image_height, kLeastBytesPerPixel, bytes.size());
  if (info.num_components != 1 && info.num_components != 3)
    throwBadImage(name, "JPEG",
                  fmt::format("{} inks are not supported; grey and colour are", info.num_components));
  info.out_color_space = info.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  Image image(int(info.image_width), int(info.image_height), info.num_components);
  std::vector<std::uint8_t> row(std::size_t(info.image_width) * std::size_t(info.num_components));
  orThrow(attempt(decoder, [&] { jpeg_start_decompress(&info); }));
  for (int y = 0; y < image.height(); ++y) {
    orThrow(attempt(decoder, [&] {
      JSAMPROW rows[1] = {row.data()};
      jpeg_read_scanlines(&info, rows, 1);
    }));
    const auto out = image.row(y);
    for (std::size_t i = 0; i < row.size(); ++i)
      out[i] = codes == Codes::Data ? float(row[i]) / 255.0f : decodeSrgb8(row[i]);
  }
  orThrow(attempt(decoder, [&] { jpeg_finish_decompress(&info); }));
  return image;
}

}  // namespace luxo
