// SPDX-License-Identifier: Apache-2.0
#include "draw/bounded_loops.h"

#include <gtest/gtest.h>

namespace luxo {
namespace {

const std::string kAsks = " LUXO_ASKS ";

TEST(BoundedLoops, EachKindAsks) {
  EXPECT_EQ(withBoundedLoops("for (int i = f(0); i < 3; ++i) x += 1;"),
            "for (int i = f(0); i < 3; ++i)" + kAsks + " x += 1;");
  EXPECT_EQ(withBoundedLoops("while(true);"), "while(true)" + kAsks + ";");
  EXPECT_EQ(withBoundedLoops("do { x(); } while (y); z();"), "do" + kAsks + " { x(); } while (y); z();");
  EXPECT_EQ(withBoundedLoops("do x(); while (y);"), "do" + kAsks + " x(); while (y);");
}

TEST(BoundedLoops, OneInAnother) {
  EXPECT_EQ(withBoundedLoops("do { while (a) { } } while (b);"),
            "do" + kAsks + " { while (a)" + kAsks + " { } } while (b);");
  EXPECT_EQ(withBoundedLoops("for(;;) while /* ( */ (a) b();"),
            "for(;;)" + kAsks + " while /* ( */ (a)" + kAsks + " b();");
}

TEST(BoundedLoops, WhatIsNoLoopStays) {
  for (const char* text : {"// for (;;)\nint forward;", "/* while (true) */", "int do_ = 1;", "#define N 3\n",
                           "for", "while (", ""})
    EXPECT_EQ(withBoundedLoops(text), text);
}

/// Brackets that have no end cost no more than others.
TEST(BoundedLoops, OfManyThatAreOpen) {
  std::string open;
  for (int i = 0; i < 50'000; ++i) open += "for(";
  EXPECT_EQ(withBoundedLoops(open), open);
  EXPECT_EQ(withBoundedLoops("for (while (a); ;)"), "for (while (a); ;)" + kAsks);
}

TEST(BoundedLoops, LinesStayWhereTheyAreAndAVersionIsBlank) {
  EXPECT_EQ(withBoundedLoops("#version 460\nfloat x;"), "            \nfloat x;");
}

}  // namespace
}  // namespace luxo
