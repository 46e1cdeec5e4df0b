// SPDX-License-Identifier: Apache-2.0
// Errors in a narrow window: all words, and marks below what they mark.
#include "error_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace luxo::test {
namespace {

using testing::ElementsAre;

TEST(ErrorLines, MessagesGoOn) {
  EXPECT_THAT(errorLines("a.frag:1:2: all of it\n  help: none", 40),
              ElementsAre("a.frag:1:2: all of it", "  help: none"));
  EXPECT_THAT(errorLines("one two three", 8), ElementsAre("one two", "three"));
  EXPECT_THAT(errorLines("abcdefgh", 3), ElementsAre("abc", "def", "gh"));
  EXPECT_THAT(errorLines("\u00e4\u00f6\u00fc", 2), ElementsAre("\u00e4\u00f6", "\u00fc"));
  EXPECT_THAT(errorLines("", 8), ElementsAre(""));
}

TEST(ErrorLines, MarksAreBelowWhatTheyMark) {
  EXPECT_THAT(errorLines("  1 | 0123456789abcdefghij\n    |           ^^", 30),
              ElementsAre("  1 | 0123456789abcdefghij", "    |           ^^"));
  EXPECT_THAT(errorLines("  1 | 0123456789abcdefghij\n    |   ^", 18),
              ElementsAre("  1 | 012345678...", "    |   ^"));
  const std::vector<std::string> cut = errorLines("  1 | 0123456789abcdefghij\n    |                 ^", 18);
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_LE(cut[0].size(), 18u);
  ASSERT_NE(cut[1].find('^'), std::string::npos);
  EXPECT_EQ(cut[0][cut[1].find('^')], 'g') << "16 behind the first, as it was";
  EXPECT_EQ(cut[0].substr(0, 9), "  1 | ...");
}

}  // namespace
}  // namespace luxo::test
