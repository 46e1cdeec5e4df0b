// SPDX-License-Identifier: Apache-2.0
// screen_to_png SCREEN X Y WIDTH HEIGHT OUT.png: a part of what is on a virtual screen, exactly.
// SCREEN is the file in which `Xvfb -fbdir` keeps the screen, in the format of xwd (XWDFile.h), version 7.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <vector>

#include "image/file.h"
#include "image/format.h"
#include "image/srgb.h"

namespace {

// The header's 32-bit big-endian fields, by index.
enum Field {
  kHeaderSize,
  kVersion,
  kWidth = 4,
  kHeight,
  kByteOrder = 7,
  kBitsPerPixel = 11,
  kBytesPerLine,
  kColors = 19
};

class Screen {
 public:
  explicit Screen(const char* path) : bytes_(luxo::readFile(path)) {
    const bool known =
        bytes_.size() > 100 && field(kVersion) == 7 && field(kBitsPerPixel) == 32 && field(kByteOrder) == 0;
    if (!known) throw std::runtime_error("not a little-endian screen of 32 bits per pixel");
    constexpr std::size_t kColorSize = 12;
    pixels_ = field(kHeaderSize) + kColorSize * field(kColors);
  }

  [[nodiscard]] luxo::Image part(int left, int top, int width, int height) const {
    if (left < 0 || top < 0 || left + width > int(field(kWidth)) || top + height > int(field(kHeight)))
      throw std::runtime_error("that part is not on the screen");
    luxo::Image image(width, height, 3);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::size_t at =
            pixels_ + std::size_t(top + y) * field(kBytesPerLine) + std::size_t(left + x) * 4;
        for (std::size_t channel = 0; channel < 3; ++channel)  // stored blue, green, red
          image.pixel(x, y)[channel] =
              luxo::decodeSrgb8(std::to_integer<std::uint8_t>(bytes_.at(at + 2 - channel)));
      }
    }
    return image;
  }

 private:
  [[nodiscard]] std::uint32_t field(std::size_t index) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
      value = value << 8 | std::to_integer<std::uint32_t>(bytes_[4 * index + i]);
    return value;
  }

  std::vector<std::byte> bytes_;
  std::size_t pixels_ = 0;
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 7) throw std::runtime_error("SCREEN X Y WIDTH HEIGHT OUT.png");
  const Screen screen(argv[1]);
  screen.part(std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]), std::atoi(argv[5])).save(argv[6]);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "screen_to_png: %s\n", error.what());
  return 1;
}
