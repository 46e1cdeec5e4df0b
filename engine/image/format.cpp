// SPDX-License-Identifier: Apache-2.0
#include "image/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/error.h"
#include "base/file_suffix.h"
#include "image/exr.h"
#include "image/file.h"
#include "image/pfm.h"
#include "image/png.h"
#include "image/tga.h"

namespace luxo {
namespace {

constexpr std::array<std::pair<const char*, ImageFormat>, 4> kSuffixes = {{{".png", ImageFormat::Png},
                                                                           {".tga", ImageFormat::Tga},
                                                                           {".exr", ImageFormat::Exr},
                                                                           {".pfm", ImageFormat::Pfm}}};

}  // namespace

std::optional<ImageFormat> imageFormatOf(const std::filesystem::path& path) {
  const std::string suffix = fileSuffix(path);
  const auto* found = std::find_if(kSuffixes.begin(), kSuffixes.end(),
                                   [&](const auto& known) { return suffix == known.first; });
  return found == kSuffixes.end() ? std::nullopt : std::optional(found->second);
}

ImageFormat requireImageFormat(const std::filesystem::path& path) {
  if (const auto format = imageFormatOf(path)) return *format;
  const std::string suffix = path.extension().string();
  throw Error(ErrorKind::Usage,
              suffix.empty() ? fmt::format("'{}' has no suffix that names an image format", path.string())
                             : fmt::format("'{}': unknown image format '{}'", path.string(), suffix),
              "use .png or .tga (8 bit, sRGB), .exr or .pfm (float, linear)");
}

bool storesSrgb8(ImageFormat format) { return format == ImageFormat::Png || format == ImageFormat::Tga; }

std::vector<std::byte> encodeImage(const Image& image, ImageFormat format) {
  switch (format) {
    case ImageFormat::Png:
      return encodePng(image);
    case ImageFormat::Tga:
      return encodeTga(image);
    case ImageFormat::Pfm:
      return encodePfm(image);
    case ImageFormat::Exr:
      return encodeExr(image);
  }
  throw Error(ErrorKind::Internal, fmt::format("image format {} is not one of the known", int(format)));
}

void saveImage(const Image& image, const std::filesystem::path& path) {
  writeFileAtomically(path, encodeImage(image, requireImageFormat(path)));
}

Image loadImage(const std::filesystem::path& path) {
  const ImageFormat format = requireImageFormat(path);
  const std::vector<std::byte> bytes = readFile(path);
  const std::string name = path.string();
  switch (format) {
    case ImageFormat::Png:
      return decodePng(bytes, name);
    case ImageFormat::Tga:
      return decodeTga(bytes, name);
    case ImageFormat::Pfm:
      return decodePfm(bytes, name);
    case ImageFormat::Exr:
      return decodeExr(bytes, name);
  }
  throw Error(ErrorKind::Internal, fmt::format("image format {} is not one of the known", int(format)));
}

}  // namespace luxo
