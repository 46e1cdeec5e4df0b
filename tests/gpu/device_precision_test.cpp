// SPDX-License-Identifier: Apache-2.0
// The measurement of sin and cos on the device: what it finds, and that its file may be anything.
#include "draw/device_precision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "support/gpu_fixture.h"
#include "unit/image_test_support.h"

namespace luxo::test {
namespace {

namespace fs = std::filesystem;

using DevicePrecision = GpuTest;

constexpr std::size_t kAngles = 8192;

/// What a device would draw whose sin and cos are rounded to a multiple of `step`, written from the
/// definition.
std::vector<Vec4f> roundedTo(double step) {
  std::vector<Vec4f> values;
  for (std::size_t i = 0; i < kAngles; ++i) {
    const float angle = (static_cast<float>(i) - 4096) * static_cast<float>(kPi / 4096);
    const double s = std::round(std::sin(static_cast<double>(angle)) / step) * step,
                 c = std::round(std::cos(static_cast<double>(angle)) / step) * step;
    values.emplace_back(static_cast<float>(s), static_cast<float>(c),
                        static_cast<float>(std::sin(static_cast<double>(angle))),
                        static_cast<float>(std::cos(static_cast<double>(angle))));
  }
  return values;
}

TEST(SinCosError, IsThatOfTheWorstAngle) {
  // Half a step, found to a thousandth by so many angles; the rest is rounded to float: half of 2^-24 at
  // most.
  const SinCosError coarse = sinCosErrorOf(roundedTo(0x1p-11));
  EXPECT_NEAR(coarse.ofDriver, 0x1p-12, 0x1p-22);
  EXPECT_GT(coarse.ofDriver, kSinCosTolerance);
  EXPECT_LE(coarse.ofFormulas, 0x1p-25 * 1.0001);
  EXPECT_GT(coarse.ofFormulas, 0x1p-26);
  EXPECT_LT(sinCosErrorOf(roundedTo(0x1p-21)).ofDriver, kSinCosTolerance);

  std::vector<Vec4f> values = roundedTo(0x1p-30);
  values[5000].w += 0.25f;
  EXPECT_NEAR(sinCosErrorOf(values).ofFormulas, 0.25, 1e-6);
  values[7].y = std::nanf("");
  EXPECT_EQ(sinCosErrorOf(values).ofDriver, INFINITY);
  EXPECT_NEAR(sinCosErrorOf(values).ofFormulas, 0.25, 1e-6);
}

TEST_F(DevicePrecision, FormulasAreWithinTheirTolerance) {
  const SinCosError error = sinCosError(context(), {});
  EXPECT_LE(error.ofFormulas, kSinCosTolerance);
  EXPECT_LE(error.ofFormulas, 2 * 0x1p-24) << "two units below 1";
  EXPECT_GT(error.ofFormulas, 0x1p-26) << "rounding alone is as much";
  EXPECT_LE(error.ofDriver, 0x1p-11) << "Vulkan promises as much";
  EXPECT_GT(error.ofDriver, 0x1p-26);
}

TEST_F(DevicePrecision, IsMeasuredOnce) {
  const ScratchFolder folder;
  const SinCosError measured = sinCosError(context(), folder.path() / "new");
  const auto submits = context().counters().submits;
  EXPECT_GT(submits, 0u);
  EXPECT_EQ(sinCosError(context(), folder.path() / "new"), measured);
  EXPECT_EQ(context().counters().submits, submits) << "it is known from its file";
  EXPECT_EQ(sinCosError(context(), {}), measured);
  EXPECT_GT(context().counters().submits, submits);
}

TEST_F(DevicePrecision, ADamagedFileIsReplaced) {
  const ScratchFolder folder;
  const SinCosError measured = sinCosError(context(), folder.path());
  ASSERT_EQ(folder.entries(), 1u);
  const fs::path file = fs::directory_iterator(folder.path())->path();
  std::ifstream in(file, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  std::vector<std::string> damaged{"", "short", whole.substr(0, whole.size() - 1), whole + "x",
                                   std::string(whole.size(), '\0')};
  for (std::size_t byte = 0; byte < whole.size(); byte += 5) {
    damaged.push_back(whole);
    damaged.back()[byte] = static_cast<char>(damaged.back()[byte] ^ 0x40);
  }
  for (const std::string& bytes : damaged) {
    std::ofstream(file, std::ios::binary) << bytes;
    const auto submits = context().counters().submits;
    EXPECT_EQ(sinCosError(context(), folder.path()), measured);
    // All but the four reserved bytes of the header are looked at.
    const bool reserved = bytes.size() == whole.size() && bytes.substr(0, 36) == whole.substr(0, 36) &&
                          bytes.substr(40) == whole.substr(40);
    EXPECT_EQ(context().counters().submits > submits, !reserved);
  }
  fs::remove(file);
  fs::create_directory(file);  // cannot be read, nor replaced
  EXPECT_EQ(sinCosError(context(), folder.path()), measured);
}

}  // namespace
}  // namespace luxo::test
