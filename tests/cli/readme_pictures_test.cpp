// SPDX-License-Identifier: Apache-2.0
// README.md shows what luxo draws today by the commands that stand beside its pictures. The catalogue's sheet
// and the gallery's, which take longer, are not drawn here.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "cli/program.h"
#include "image/format.h"
#include "image/srgb.h"

namespace luxo::test {
namespace {

/// The same picture of one device is the same bytes, on any number of threads. Another device, or another
/// order of sums, rounds otherwise: that is one code of 8 bits, and more in a pixel some of whose samples are
/// within that of a border of a surface or a shadow. Of the scene `shadows` 3 pixels of 518,400 have become
/// such in a week's commits, none of the showcase's. A shadow that is missing is thousands.
constexpr int kRoundingCodes = 1, kPixelsAtBorders = 20;

/// The words after `luxo`, up to ` -o FILE`, of the README's command that writes the file.
Arguments readmeCommandOf(const std::string& file) {
  const std::string readme = textOf(std::filesystem::path(LUXO_SOURCE_DIR) / "README.md");
  const std::size_t end = readme.find(" -o " + file), start = readme.rfind("luxo ", end);
  if (end == std::string::npos || start == std::string::npos) return {};
  std::istringstream words(readme.substr(start, end - start));
  return {std::next(std::istream_iterator<std::string>(words)), {}};
}

/// Pixels with a code that is beyond all those which the picture, of as many pixels or a multiple of them in
/// each direction, has in the same place.
int pixelsThatAreNotIn(const Image& picture, const Image& pixels) {
  const int times = picture.width() / pixels.width();
  int count = 0;
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 0; x < pixels.width(); ++x) {
      bool found = true;
      for (std::size_t c = 0; c < 3; ++c) {
        int least = 255, most = 0;
        for (int k = 0; k < times * times; ++k) {
          const int code = encodeSrgb8(picture.pixel(x * times + k % times, y * times + k / times)[c]);
          least = std::min(least, code);
          most = std::max(most, code);
        }
        const int code = encodeSrgb8(pixels.pixel(x, y)[c]);
        found = found && code >= least - kRoundingCodes && code <= most + kRoundingCodes;
      }
      count += found ? 0 : 1;
    }
  return count;
}

class ReadmePictures : public DeviceRenderTest {
 protected:
  /// Draws it by its command, `times` as small.
  void expectToday(const std::filesystem::path& path, int times) const {
    SCOPED_TRACE(path.string());
    const Image picture = loadImage(std::filesystem::path(LUXO_SOURCE_DIR) / path);
    Arguments arguments = readmeCommandOf(path.filename().string());
    ASSERT_FALSE(arguments.empty()) << "README.md has no command that writes it";
    const std::string anew = fmt::format("luxo {} -o {}", fmt::join(arguments, " "), path.string());
    if (times > 1) {
      const auto size = std::find(arguments.begin(), arguments.end(), "--size");
      ASSERT_LT(size, arguments.end() - 1) << anew;
      ASSERT_EQ(size[1], fmt::format("{}x{}", picture.width(), picture.height()));
      size[1] = fmt::format("{}x{}", picture.width() / times, picture.height() / times);
    }
    arguments.insert(arguments.end(), {"-o", "today.png", "-q", "--report", "-"});
    const Outcome outcome = run(folder, arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    if (nlohmann::json::parse(outcome.out)["device"]["type"] != "CPU")
      GTEST_SKIP() << "how another device rounds is not measured";
    const Image today = loadImage(folder / "today.png");
    ASSERT_EQ(today.width() * times, picture.width());
    ASSERT_EQ(today.height() * times, picture.height());
    ASSERT_EQ(today.channels(), 3);
    ASSERT_EQ(picture.channels(), 3);
    EXPECT_LE(pixelsThatAreNotIn(picture, today), kPixelsAtBorders)
        << "if luxo is right, draw it anew: " << anew;
  }
};

// About 4 s of one core. All but the lamp, which takes 0.5 s as large as it is shown, a sixth as large: 0.7
// to 1.5 s each instead of 2 to 13. With its 4 samples such a pixel is between those that it covers: all of
// 16,000 are, and 1,900 were not when the picture of the glass had no shadow.
TEST_F(ReadmePictures, AreDrawnByTheCommandsBesideThem) {
  expectToday("apps/luxo_grandpa/luxo_grandpa.png", 1);
  expectToday("apps/scenes/showcase.png", 6);
  expectToday("apps/scenes/shadows.png", 6);
  expectToday("apps/scenes/glass.png", 6);
}

}  // namespace
}  // namespace luxo::test
