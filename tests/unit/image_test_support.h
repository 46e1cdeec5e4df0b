// SPDX-License-Identifier: Apache-2.0
// Pictures and checks that the tests of engine/image share.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "base/error.h"
#include "image/image.h"

namespace luxo {

/// A folder of the test's own, removed with everything in it.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "luxo-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    path_ = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() { std::filesystem::remove_all(path_); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] std::size_t entries() const {
    return std::size_t(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

/// Floats of every kind: any bit pattern, so also NaN with payloads, infinities, subnormals and both zeros.
inline Image imageOfAnyBits(int width, int height, int channels, std::uint32_t seed) {
  std::mt19937 random(seed);
  Image image(width, height, channels);
  for (float& sample : image.samples()) sample = std::bit_cast<float>(std::uint32_t(random()));
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const float special[] = {infinity,
                           -infinity,
                           -0.0f,
                           std::bit_cast<float>(0x7fc12345u),
                           std::bit_cast<float>(0xff812345u),
                           std::numeric_limits<float>::denorm_min()};
  for (std::size_t i = 0; i < std::size(special) && i < image.samples().size(); ++i)
    image.samples()[i] = special[i];
  return image;
}

/// Values in 0..1.
inline Image imageOfColours(int width, int height, int channels, std::uint32_t seed) {
  std::mt19937 random(seed);
  Image image(width, height, channels);
  for (float& sample : image.samples()) sample = float(random() % 1001) / 1000.0f;
  return image;
}

inline std::vector<std::uint32_t> bitsOf(const Image& image) {
  std::vector<std::uint32_t> bits;
  for (const float sample : image.samples()) bits.push_back(std::bit_cast<std::uint32_t>(sample));
  return bits;
}

/// Runs a reader on damaged bytes: it may give an image or throw Error(Scene) that names the file; nothing
/// else.
template <class Decode>
bool readsOrRefuses(const Decode& decode, std::span<const std::byte> bytes) {
  try {
    static_cast<void>(decode(bytes, "damaged.file"));
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene) << error.what();
    EXPECT_NE(std::string(error.what()).find("damaged.file"), std::string::npos) << error.what();
    return false;
  }
}

/// Every proper prefix of the file must be refused, except that the last `optional` bytes may be missing.
template <class Decode>
void expectEveryTruncationRefused(const Decode& decode, const std::vector<std::byte>& file,
                                  std::size_t optional = 0) {
  for (std::size_t length = 0; length + optional < file.size(); ++length)
    EXPECT_FALSE(readsOrRefuses(decode, std::span(file).first(length))) << "cut to " << length << " bytes";
}

/// Random damage: one to four bytes of the file replaced, `rounds` times. Must never crash nor throw anything
/// else.
template <class Decode>
void expectDamageSurvived(const Decode& decode, const std::vector<std::byte>& file, int rounds) {
  std::mt19937 random(7);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::byte> damaged = file;
    for (std::uint32_t flips = 1 + random() % 4; flips > 0; --flips)
      damaged[random() % damaged.size()] = std::byte(random() % 256);
    readsOrRefuses(decode, damaged);
  }
}

inline ErrorKind kindThrownBy(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorKind::Internal;
}

}  // namespace luxo
