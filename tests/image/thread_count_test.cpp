// SPDX-License-Identifier: Apache-2.0
// The CPU device's number of threads leaves no trace in a picture. It is read once, when Vulkan is loaded, so
// that every number needs a process of its own: this program again, asked to write its picture to a file.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "luxo_grandpa/lamp.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr const char* kTarget = "LUXO_TEST_WRITE_PICTURES";

using ThreadCount = PictureTest;

std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(ThreadCount, LeavesNoTrace) {
  if (const char* target = std::getenv(kTarget)) {
    draw(luxoGrandpa(), {640, 360}, {}, 21).image.save(std::string(target) + ".pfm");
    draw(luxoGrandpa(), {641, 359}, {.shading = Shading::Gouraud, .samples = 4}, 9.5)
        .image.save(std::string(target) + "4.pfm");
    return;
  }
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("luxo_threads_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::string first, firstOf4;
  for (const char* threads : {"0", "1", "2"}) {
    const std::string target = (folder / threads).string();
    const std::string command = std::string("LP_NUM_THREADS=") + threads + " " + kTarget + "='" + target +
                                "' '" + program + "' --gtest_filter=ThreadCount.LeavesNoTrace > '" + target +
                                ".log' 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << bytesOf(target + ".log");
    const std::string one = bytesOf(target + ".pfm"), four = bytesOf(target + "4.pfm");
    ASSERT_GT(one.size(), 640u * 360 * 12);
    ASSERT_GT(four.size(), 641u * 359 * 12);
    if (first.empty()) {
      first = one;
      firstOf4 = four;
    }
    EXPECT_TRUE(one == first) << threads << " threads, 1 sample";
    EXPECT_TRUE(four == firstOf4) << threads << " threads, 4 samples";
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace luxo::test
