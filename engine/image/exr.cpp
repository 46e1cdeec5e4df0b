// SPDX-License-Identifier: Apache-2.0
#include "image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string>

#include "base/assert.h"
#include "image/bytes.h"

namespace luxo {
namespace {

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::span<const std::byte> bytes) : IStream("memory"), bytes_(bytes) {}

  bool read(char out[], int size) override {
    if (size < 0 || std::size_t(size) > bytes_.size() - at_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(out, bytes_.data() + at_, std::size_t(size));
    at_ += std::size_t(size);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override {
    if (position > bytes_.size()) throw std::runtime_error("it points behind its end");
    at_ = std::size_t(position);
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : OStream("memory") {}

  void write(const char in[], int size) override {
    const auto bytes = std::as_bytes(std::span(in, std::size_t(size)));
    if (bytes_.size() < at_ + bytes.size()) bytes_.resize(at_ + bytes.size());
    std::copy(bytes.begin(), bytes.end(), bytes_.begin() + std::ptrdiff_t(at_));
    at_ += bytes.size();
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = std::size_t(position); }

  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
};

std::vector<std::string> channelNames(int channels) {
  if (channels == 1) return {"Y"};
  if (channels == 3) return {"R", "G", "B"};
  return {"R", "G", "B", "A"};
}

// Which channels of the file make the image: R G B (A) or the only one; empty when neither.
std::vector<std::string> imageChannels(const Imf::ChannelList& list) {
  const auto has = [&](const char* name) { return list.findChannel(name) != nullptr; };
  if (has("R") && has("G") && has("B")) return channelNames(has("A") ? 4 : 3);
  const auto first = list.begin();
  if (first == list.end()) return {};
  auto second = first;
  if (++second != list.end()) return {};
  return {first.name()};
}

std::string namesOf(const Imf::ChannelList& list) {
  std::string names;
  for (auto channel = list.begin(); channel != list.end(); ++channel)
    names += std::string(" ") + channel.name();
  return names.empty() ? " none" : names;
}

// The slices address the samples as if the pixel (0, 0) of the file's coordinates were in the image: `origin`
// may lie outside.
Imf::FrameBuffer slices(Image& image, const std::vector<std::string>& names, const Imath::Box2i& window) {
  Imf::FrameBuffer buffer;
  const std::size_t pixelBytes = sizeof(float) * names.size();
  for (std::size_t c = 0; c < names.size(); ++c) {
    buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.samples().data() + c, window, pixelBytes,
                                             pixelBytes * std::size_t(image.width())));
  }
  return buffer;
}

Imath::Box2i windowOf(const Image& image) { return {{0, 0}, {image.width() - 1, image.height() - 1}}; }

Image readPixels(Imf::InputFile& file, std::string_view name, std::size_t bytes) {
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  const std::vector<std::string> names = imageChannels(header.channels());
  if (names.empty())
    throwBadImage(name, "EXR",
                  fmt::format("its channels are{}; R G B, R G B A or a single one are read",
                              namesOf(header.channels())));
  // The smallest sample is a half.
  requirePlausibleSize(name, "EXR", std::int64_t(window.max.x) - window.min.x + 1,
                       std::int64_t(window.max.y) - window.min.y + 1,
                       2.0 * double(names.size()) / kBestDeflateRatio, bytes);
  Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, int(names.size()));
  file.setFrameBuffer(slices(image, names, window));
  file.readPixels(window.min.y, window.max.y);
  return image;
}

// The library allocates tables for the size in the header before anyone can ask for that size.
void limitLibrarySizes() {
  static const bool once = [] {
    Imf::Header::setMaxImageSize(kMaxImageSide, kMaxImageSide);
    Imf::Header::setMaxTileSize(kMaxImageSide, kMaxImageSide);
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace

std::vector<std::byte> encodeExr(const Image& image) {
  LUXO_REQUIRE(!image.empty());
  const std::vector<std::string> names = channelNames(image.channels());
  Imf::Header header(windowOf(image), windowOf(image));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& name : names) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  MemoryOutput stream;
  try {
    Imf::OutputFile file(stream, header, 0);
    // A frame buffer serves reading and writing alike, so its pointers are not const; writing does not change
    // them.
    file.setFrameBuffer(slices(const_cast<Image&>(image), names, windowOf(image)));
    file.writePixels(image.height());
  } catch (const std::exception& error) {
    throw Error(ErrorKind::Internal, fmt::format("cannot encode EXR: {}", error.what()));
  }
  return stream.take();
}

Image decodeExr(std::span<const std::byte> bytes, std::string_view name) {
  limitLibrarySizes();
  try {
    MemoryInput stream(bytes);
    Imf::InputFile file(stream, 0);
    return readPixels(file, name, bytes.size());
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throwBadImage(name, "EXR", error.what());
  }
}

}  // namespace luxo
