// SPDX-License-Identifier: Apache-2.0
#include "draw/indexed_arrays.h"

#include <gtest/gtest.h>

namespace luxo {
namespace {

std::string reading(std::string_view text, std::size_t dimensions = 1) {
  return withElementsRead(text, "a", dimensions).value_or("nothing");
}

TEST(IndexedArrays, EachElementIsACall) {
  EXPECT_EQ(reading("uniform float a[3], b;\nfloat f(int i) { return a[i] + a [ 2 ]; }"),
            "uniform float a[3], b;\nfloat f(int i) { return luxoAt_a(int(i)) + luxoAt_a(int( 2 )); }");
  EXPECT_EQ(reading("void f() { x = vec2(a[0], a[int(b[1])]).x + aa[1] + c.a[1]; }"),
            "void f() { x = vec2(luxoAt_a(int(0)), luxoAt_a(int(int(b[1])))).x + aa[1] + c.a[1]; }");
  EXPECT_EQ(reading("void f() { x = a[int(a[i])][1].x; } // a"),
            "void f() { x = luxoAt_a(int(int(luxoAt_a(int(i)))))[1].x; } // a");
  EXPECT_EQ(reading("void f() { x = a[i /* ] */][f(j)[1]]; }", 2),
            "void f() { x = luxoAt_a(int(i /* ] */), int(f(j)[1])); }");
  EXPECT_EQ(reading("#define FIRST a[0]\n#define AT(i) (a[i])\nvoid f() { x = FIRST; }"),
            "#define FIRST luxoAt_a(int(0))\n#define AT(i) (luxoAt_a(int(i)))\nvoid f() { x = FIRST; }");
}

TEST(IndexedArrays, WhatElseTheNameMayBeIsNotTouched) {
  for (const char* text :
       {"void f() { x = sum(a); }", "void f() { x = a.length(); }", "#define ALL a\n",
        "void f() { float a[2]; x = a[1]; }", "void f() { float b = 1.0, a[2]; }",
        "float f(float a[3]) { return a[1]; }", "void f() { float[2] a; x = a[0]; }",
        "struct S { float a[3]; };", "void f() { x = a[1", "void f() { for (int a = 0;;) x = a; }"})
    EXPECT_EQ(reading(text), "nothing") << text;
  EXPECT_EQ(reading("void f() { x = a[1]; }", 2), "nothing") << "a row of it";
}

}  // namespace
}  // namespace luxo
