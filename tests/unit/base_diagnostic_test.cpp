// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostic.h"

#include <gtest/gtest.h>

#include <string>

#include "base/utf8.h"

namespace luxo {
namespace {

TEST(Diagnostic, ShowsTheLineAndPointsAtThePlace) {
  const std::string text = "one\ncos(u)*uv\nthree";
  EXPECT_EQ(describe("a.json", text, {{11, 13}, "unknown name 'uv'", "did you mean 'u*v'?"}),
            "a.json:2:8: unknown name 'uv'\n"
            "  2 | cos(u)*uv\n"
            "    |        ^^\n"
            "  help: did you mean 'u*v'?");
}

TEST(Diagnostic, NeedsNoHint) {
  EXPECT_EQ(describe("x", "ab", {{0, 1}, "no", {}}),
            "x:1:1: no\n"
            "  1 | ab\n"
            "    | ^");
}

TEST(Diagnostic, LinesUpUnderLongLineNumbers) {
  const std::string text = std::string(99, '\n') + "xy";
  EXPECT_EQ(describe("x", text, {{100, 101}, "no", {}}),
            "x:100:2: no\n"
            "  100 | xy\n"
            "      |  ^");
}

TEST(Diagnostic, PointsBehindTheEnd) {
  EXPECT_EQ(describe("x", "ab", {{2, 2}, "no", {}}), "x:1:3: no\n  1 | ab\n    |   ^");
  EXPECT_EQ(describe("x", "ab", {{700, 900}, "no", {}}), "x:1:3: no\n  1 | ab\n    |   ^");
  EXPECT_EQ(describe("x", "ab\n", {{3, 3}, "no", {}}), "x:2:1: no\n  2 | \n    | ^");
  EXPECT_EQ(describe("x", "", {{0, 0}, "no", {}}), "x:1:1: no\n  1 | \n    | ^");
  EXPECT_EQ(describe("x", "ab\ncd", {{2, 3}, "no", {}}), "x:1:3: no\n  1 | ab\n    |   ^");
}

TEST(Diagnostic, ARangeOverSeveralLinesIsMarkedOnItsFirst) {
  EXPECT_EQ(describe("x", "abc\r\ndef", {{1, 7}, "no", {}}), "x:1:2: no\n  1 | abc\n    |  ^^");
}

TEST(Diagnostic, TabsStayTabsSoThatTheMarkLinesUp) {
  EXPECT_EQ(describe("x", "\ta\tb", {{3, 4}, "no", {}}), "x:1:4: no\n  1 | \ta\tb\n    | \t \t^");
}

TEST(Diagnostic, ColumnsCountCharacters) {
  // two, three and four bytes before the place, which is three bytes itself
  EXPECT_EQ(describe("x", "\u00e9\u2212\U0001d70bu\u00d7v", {{10, 12}, "no", {}}),
            "x:1:5: no\n  1 | \u00e9\u2212\U0001d70bu\u00d7v\n    |     ^");
  EXPECT_EQ(positionAt("\u2212u", 2), (TextPosition{1, 1})) << "inside a character is at its start";
}

TEST(Diagnostic, WhatATerminalWouldActOnIsReplaced) {
  EXPECT_EQ(describe("x", "\x1b[31m\xffu", {{6, 7}, "no", {}}),
            "x:1:7: no\n  1 | \uFFFD[31m\uFFFDu\n    |       ^");
  EXPECT_EQ(describe("x", "u", {{0, 1}, "no '\x07'", "or \n\xff"}),
            "x:1:1: no '\uFFFD'\n  1 | u\n    | ^\n  help: or \uFFFD\uFFFD");
  EXPECT_EQ(describe("x", "a\u202eb\u200bc", {{1, 4}, "no", {}}),
            "x:1:2: no\n  1 | a\uFFFDb\uFFFDc\n    |  ^");
}

TEST(Diagnostic, LongLinesAreCutAroundThePlace) {
  const std::string text = std::string(5000, 'a') + "BAD" + std::string(5000, 'z');
  EXPECT_EQ(describe("x", text, {{5000, 5003}, "no", {}}),
            "x:1:5001: no\n  1 | ..." + std::string(60, 'a') + "BAD" + std::string(37, 'z') +
                "...\n    |    " + std::string(60, ' ') + "^^^");
  EXPECT_EQ(describe("x", std::string(5000, 'a'), {{0, 5000}, "no", {}}),
            "x:1:1: no\n  1 | " + std::string(100, 'a') + "...\n    | " + std::string(100, '^'));
}

TEST(Diagnostic, AnyBytesAndAnyRangeAreDescribed) {
  std::string text;
  for (int i = 0; i < 4096; ++i) text += static_cast<char>(i * 37 ^ i >> 5);
  for (std::size_t begin = 0; begin < text.size() + 2; ++begin)
    for (const std::size_t length : {0, 1, 7, 5000}) {
      const std::string shown = describe("x", text, {{begin, begin + length}, "no", {}});
      for (std::size_t i = 0; i < shown.size(); i += decodeUtf8(shown, i).bytes)
        ASSERT_TRUE(decodeUtf8(shown, i).valid) << begin << " " << length;
      EXPECT_EQ(std::count(shown.begin(), shown.end(), '\n'), 2);
      EXPECT_EQ(shown.back(), '^');
    }
}

TEST(Utf8, RefusesWhatIsNone) {
  EXPECT_EQ(decodeUtf8("\xf0\x9d\x9c\x8b", 0).point, U'\U0001d70b');
  EXPECT_EQ(decodeUtf8("\xf0\x9d\x9c\x8b", 0).bytes, 4u);
  for (const char* bad : {"\x80", "\xc0\x80", "\xc1\xbf", "\xe0\x80\x80", "\xf0\x80\x80\x80", "\xed\xa0\x80",
                          "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xe2\x88", "\xe2(\x92", "\xff"}) {
    EXPECT_FALSE(decodeUtf8(bad, 0).valid) << static_cast<int>(bad[0]);
    EXPECT_EQ(decodeUtf8(bad, 0).bytes, 1u);
  }
}

}  // namespace
}  // namespace luxo
