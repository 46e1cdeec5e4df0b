// SPDX-License-Identifier: Apache-2.0
// Texts that come to more than a compiler can hold, or to what is nested deeper than a stack is: refused at
// their place, and fast; what real shaders do is not.
#include "scene/shader_macros.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/glsl_tokens.h"

namespace luxo {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

std::string refusalOf(const MaterialShader& shader) {
  try {
    requireBounded(shader);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    return error.what();
  }
  return "none";
}

std::string refusalOf(const std::string& text) { return refusalOf(MaterialShader{{{"m.frag", text}}}); }

std::vector<std::string> wordsOf(std::string_view text) {
  std::vector<std::string> words;
  for (const GlslToken& token : glslTokens(text)) words.emplace_back(token.text);
  return words;
}

TEST(GlslTokens, AreWordsNumbersAndOperators) {
  EXPECT_THAT(wordsOf("a.b+=1.5e-3f<<0x1e-2 // c\n/* d */e[.5]"),
              ElementsAre("a", ".", "b", "+=", "1.5e-3f", "<<", "0x1e", "-", "2", "e", "[", ".5", "]"));
  EXPECT_THAT(wordsOf("a // goes on \\\n b\nc /* open"), ElementsAre("a", "c"));
  EXPECT_THAT(wordsOf("\"a b\"\n#include \"a b\""), ElementsAre("\"a b\"", "#", "include", "\"a b\""));
  EXPECT_THAT(wordsOf("\" /* \"b \" c\n */"), ElementsAre("\" /* \"", "b", "\"", "c", "*", "/"));
}

/// No longer than to a compiler: what follows may be a macro's name.
TEST(GlslTokens, NumbersEndWhereTheLanguageHasIt) {
  EXPECT_THAT(wordsOf("1.A18 1.5.x 0x1fuG 07u 1e5f 1e+x 2.lf .5hf"),
              ElementsAre("1.", "A18", "1.5", ".", "x", "0x1fu", "G", "07u", "1e5f", "1", "e", "+", "x",
                          "2.lf", ".5hf"));
}

TEST(GlslTokens, DirectivesAreLines) {
  const std::string text = "x # y\n #define N \\\n 3 /*\n*/ + 1\n#\nz\n#undef N";
  const std::vector<GlslToken> tokens = glslTokens(text);
  const std::vector<GlslDirective> all = directivesIn(tokens);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].name, "define");
  EXPECT_EQ(all[0].rest.size(), 4u);
  EXPECT_EQ(all[1].name, "");
  EXPECT_EQ(all[2].name, "undef");
  EXPECT_EQ(text.substr(all[2].rest.front().begin), "N");
  const std::vector<GlslToken> quoted =
      glslTokens("#if 0\n\" /* \"\n#endif\n#define X\n#if 0\n\" */ \"\n#endif\n");
  EXPECT_EQ(directivesIn(quoted).size(), 5u) << "quotes are no comments";
}

TEST(GlslTokens, CommentsMayHaveNoEnd) {
  EXPECT_EQ(unendedComment("a /* b */ // /* c\nd"), std::string_view::npos);
  EXPECT_EQ(unendedComment("a /* b */ \n /*/ d"), 12u);
  EXPECT_EQ(unendedComment("\" /* \""), std::string_view::npos);
}

TEST(GlslTokens, OfLongLines) {
  constexpr int kMany = 1 << 20;  // letters
  EXPECT_EQ(glslTokens(std::string(kMany, 'a')).size(), 1u);
  EXPECT_EQ(glslTokens(std::string(kMany, ' ')).size(), 0u);
  EXPECT_EQ(glslTokens(std::string(kMany, '(')).size(), std::size_t{kMany});
  EXPECT_EQ(glslTokens("#" + std::string(kMany, '"')).size(), 1u + kMany / 2);
}

TEST(ShaderMacros, WhatHidesPlacesIsRefused) {
  EXPECT_THAT(refusalOf("float a;\n  #line 7\n"),
              StartsWith("m.frag:2:3: '#line' would move the places of errors\n"));
  EXPECT_THAT(refusalOf("float a; /* and\n so on"), StartsWith("m.frag:1:10: this comment has no end\n"));
}

TEST(ShaderMacros, ThatDoubleAreRefusedWhereTheyAreNamed) {
  std::string bomb = "#define A0 x x\n";
  for (int i = 1; i < 40; ++i) bomb += fmt::format("#define A{} A{} A{}\n", i, i - 1, i - 1);
  EXPECT_EQ(refusalOf(bomb), "none") << "nobody names it";
  EXPECT_THAT(
      refusalOf(bomb + "int f() { A39 }\n"),
      StartsWith("m.frag:41:11: macros come to more than 262144 words here\n  41 | int f() { A39 }\n"));
  EXPECT_EQ(refusalOf(bomb + "int f() { A9 }\n"), "none") << "1024 words";
  EXPECT_THAT(refusalOf(bomb + "#if A39\n#endif\n"), StartsWith("m.frag:41:5: macros come"));
  EXPECT_THAT(refusalOf(bomb + "#if 0\n#undef A39\n#define A39 1\n#endif\nA39\n"),
              StartsWith("m.frag:45:1: macros"));
}

TEST(ShaderMacros, ThatDoubleTheirArguments) {
  const std::string twice = "#define TWO(x) x x\n#define JOIN(a, b) a##b\n#define TWOOF TWO\n";
  EXPECT_EQ(refusalOf(twice + repeated("TWO(", 10) + "y" + repeated(")", 10)), "none");
  EXPECT_THAT(refusalOf(twice + repeated("TWO(", 40) + "y" + repeated(")", 40)),
              AllOf(StartsWith("m.frag:4:"), HasSubstr(": macros come to")));
  EXPECT_THAT(refusalOf(twice + repeated("TWOOF (", 40) + "y" + repeated(")", 40)),
              AllOf(StartsWith("m.frag:4:"), HasSubstr(": macros come to")));
  EXPECT_THAT(refusalOf(twice + repeated("JOIN(TW, O)(", 40) + "y" + repeated(")", 40)),
              AllOf(StartsWith("m.frag:4:"), HasSubstr(": macros come to")));
  EXPECT_THAT(refusalOf(twice + "TWO(y\n"),
              StartsWith("m.frag:4:1: the arguments of the macro 'TWO' have no ')'"));
  EXPECT_THAT(refusalOf("#define ONE(x) (x)\n" + repeated("ONE(", 300) + "y" + repeated(")", 300)),
              HasSubstr("more than 200 deep"));
}

/// A compiler expands all arguments, whatever the macro does with them.
TEST(ShaderMacros, ArgumentsThatNobodyNames) {
  std::string bomb = "#define A0 x x\n";
  for (int i = 1; i < 40; ++i) bomb += fmt::format("#define A{} A{} A{}\n", i, i - 1, i - 1);
  for (const char* macro : {"F(x)", "F(a) a##z", "F(a) b", "F()"}) {
    EXPECT_THAT(refusalOf(bomb + "#define " + macro + "\nF(A39)\n"),
                StartsWith("m.frag:42:3: macros come to more than 262144 words"))
        << macro;
    EXPECT_EQ(refusalOf(bomb + "#define " + macro + "\nF(A9)\n"), "none") << macro;
  }
}

TEST(ShaderMacros, BehindNumbers) {
  for (const char* number : {"1.", "1.f", "0x1u", "1.s", "1l"}) {
    const std::string suffix =
        number[std::string_view(number).size() - 1] == '.' ? "" : std::string(1, std::string(number).back());
    for (const std::string& name : {std::string("A"), suffix + "A"}) {
      std::string bomb = fmt::format("#define {}0 x x\n", name);
      for (int i = 1; i < 40; ++i) bomb += fmt::format("#define {0}{1} 1.{0}{2} 1.{0}{2}\n", name, i, i - 1);
      const std::string before = name == "A" ? number : std::string(number).substr(0, 2);
      EXPECT_THAT(refusalOf(bomb + before + name + "39\n"), HasSubstr("macros come to")) << before + name;
    }
  }
  EXPECT_EQ(refusalOf("#define f(x) x\n#define F 1.0f\nfloat a = f(1.0f) + 2.0F;\n"), "none");
}

/// What is around all of a file is no condition, once nothing undefines or defines it elsewhere.
TEST(ShaderMacros, DefinitionsInAGuardedFile) {
  std::string many;
  for (int i = 0; i < 70; ++i)
    many += fmt::format("#undef N\n#define N {}\nfloat f{}() {{ return N; }}\n", i, i);
  const auto guarded = [&](const std::string& guard) {
    return fmt::format("#ifndef {0}\n#define {0}\n{1}#endif\n", guard, many);
  };
  EXPECT_EQ(refusalOf(guarded("G")), "none");
  const std::string said = "the macro 'N' has more than 64 definitions";
  EXPECT_THAT(refusalOf(guarded("G") + "float x;\n"), HasSubstr(said)) << "no guard";
  EXPECT_THAT(
      refusalOf(MaterialShader{{{"m.frag", "#define G\n#include \"g.glsl\"\n"}, {"g.glsl", guarded("G")}}}),
      HasSubstr(said));
  EXPECT_THAT(refusalOf(guarded("GL_ES")), HasSubstr(said));
}

/// Each is a name within itself, as the preprocessor has it.
TEST(ShaderMacros, ThatNameThemselvesEnd) {
  EXPECT_EQ(refusalOf("#define A B\n#define B A\n#define f(x) f(x) A f\nfloat y = A + f(f(1));\n"), "none");
  EXPECT_EQ(refusalOf("#define min(a, b) min(a, b)\n#define PI 3.0\nfloat y = min(PI, min(1.0, 2.0));\n"),
            "none");
  std::string each = " ";
  for (int i = 0; i < 12; ++i) each += fmt::format("A{} ", i);
  std::string cyclic;
  for (int i = 0; i < 12; ++i) cyclic += fmt::format("#define A{}{}\n", i, each);
  EXPECT_THAT(refusalOf(cyclic + "A0\n"), StartsWith("m.frag:13:1: macros")) << "11! words";
}

TEST(ShaderMacros, FilesThatIncludeTwoEach) {
  MaterialShader shader;
  const auto nameOf = [](int i) { return fmt::format("f{}.glsl", i); };
  const auto include = [&](int i) { return fmt::format("#include \"{}\"\n", nameOf(i)); };
  shader.files.push_back({"m.frag", include(0)});
  for (int i = 0; i < 30; ++i) shader.files.push_back({nameOf(i), include(i + 1) + include(i + 1)});
  shader.files.push_back({nameOf(30), "float x;\n"});
  EXPECT_THAT(refusalOf(shader), HasSubstr(".glsl:1:10: files are included more than 1000 times\n"));
  for (std::size_t i = 1; i < shader.files.size(); ++i)
    shader.files[i].text = fmt::format("#ifndef H{0}\n#define H{0}\n{1}#endif\n", i, shader.files[i].text);
  EXPECT_EQ(refusalOf(shader), "none") << "each is there once";
  shader.files.back().text += "#undef H3\n";
  EXPECT_EQ(refusalOf(shader), "none");
  for (std::size_t i = 1; i < shader.files.size(); ++i)
    shader.files.back().text += fmt::format("#undef H{}\n", i);
  EXPECT_THAT(refusalOf(shader), HasSubstr("files are included more than 1000 times\n"));
}

TEST(ShaderMacros, FilesThatAreLong) {
  MaterialShader shader{
      {{"m.frag", repeated("#include \"a.glsl\"\n", 20)}, {"a.glsl", std::string(1 << 18, ' ')}}};
  EXPECT_THAT(refusalOf(shader), StartsWith("m.frag:17:10: included files come to more than 4 MiB\n"));
}

/// 2000 of anything a compiler follows by recursion, and one more.
TEST(ShaderNesting, OfEveryShape) {
  const auto inMain = [](const std::string& value) { return "void main() { float y = " + value + "; }\n"; };
  const auto expectBound = [&](const std::string& open, const std::string& middle, const std::string& close) {
    EXPECT_EQ(refusalOf(inMain(repeated(open, 900) + middle + repeated(close, 900))), "none") << open;
    EXPECT_THAT(refusalOf(inMain(repeated(open, 2001) + middle + repeated(close, 2001))),
                HasSubstr("m.frag:1:"))
        << open;
    EXPECT_THAT(refusalOf(inMain(repeated(open, 2001) + middle + repeated(close, 2001))),
                HasSubstr("brackets and operators are nested more than 2000 deep here\n"))
        << open;
  };
  expectBound("(", "x", ")");
  expectBound("1.0+", "x", "");
  expectBound("- ", "x", "");
  expectBound("!", "x", "");
  expectBound("", "x", ".x");
  expectBound("", "x", "[0]");
  expectBound("x=", "x", "");
  expectBound("f(", "x", ")");
  expectBound("(x*", "x", ")");
  expectBound("", "(x", ",x");
  EXPECT_EQ(refusalOf("float a[9000] = float[9000](" + repeated("-x*2.0,", 9000) + "1.0);\n"), "none");
  EXPECT_EQ(refusalOf("float a[9000] = {" + repeated("-x*2.0,", 9000) + "1.0};\n"), "none");
  EXPECT_EQ(refusalOf("void main() { " + repeated("y = x + 1.0; if (x > 0.0) { y = 2.0; }\n", 5000) + "}\n"),
            "none");
  const std::string deep = "#define P(x) " + repeated("(", 22) + "x" + repeated(")", 22) + "\n";
  EXPECT_THAT(refusalOf(deep + repeated("P(", 100) + "x" + repeated(")", 100)),
              StartsWith("m.frag:2:1: brackets"))
      << "that macros make";
  EXPECT_THAT(refusalOf("#if " + std::string(3000, '(') + "\n#endif\n"),
              StartsWith("m.frag:1:2005: brackets"));
}

TEST(ShaderNesting, OfStatements) {
  const auto refusal = [](const std::string& open, const std::string& close, int times) {
    return refusalOf("void main() {\n" + repeated(open, times) + "y = 1.0;" + repeated(close, times) +
                     "\n}\n");
  };
  for (const auto& [open, close] : {std::pair{"if (x > 0.0) {", "}"},
                                    {"if (x > 0.0) ", ""},
                                    {"if (x > 0.0) y = 2.0; else ", ""},
                                    {"if (x > 0.0) { y = 2.0; } else ", ""},
                                    {"for (;;) ", ""},
                                    {"do ", "while (x > 0.0);"},
                                    {"x > 0.0 ? 1.0 : ", ""},
                                    {"a && (", ")"},
                                    {"{", "}"}}) {
    EXPECT_EQ(refusal(open, close, 120), "none") << open;
    EXPECT_THAT(refusal(open, close, 257), StartsWith("m.frag:2:")) << open;
    EXPECT_THAT(refusal(open, close, 257), HasSubstr("branches are nested more than 256 deep here\n"))
        << open;
  }
}

/// What may not be there closes nothing.
TEST(ShaderNesting, OfWhatStandsUnderConditions) {
  const auto refusal = [](const std::string& each, int times) {
    return refusalOf("void main() {\n" + repeated(each, times) + "y = 1.0;\n}\n");
  };
  for (const char* each :
       {"if (x < 0.5) { x += 0.1;\n#if 0\n}\n#endif\n", "if (x < 0.5)\n#if 0\n;\n#endif\n",
        "if (x < 0.5)\n#if 0\n{ }\n#else\n#endif\n", "if (x < 0.5) y = 2.0;\n#if 1\nelse\n#endif\n",
        "if (x < 0.5) y = 2.0;\n#if 0\ny = 3.0;\n#endif\nelse ",
        "#if 1\nif (x < 0.5) {\n#elif 0\n}\n#endif\n"}) {
    EXPECT_EQ(refusal(each, 80), "none") << each;
    EXPECT_THAT(refusal(each, 300), HasSubstr("branches are nested more than 256 deep here\n")) << each;
  }
  EXPECT_THAT(refusal("y = (x\n#if 0\n)\n#endif\n", 1100), HasSubstr("nested more than 2000 deep"));
  // And what real shaders do.
  for (const char* each :
       {"#ifdef A\nif (x < 0.5) y = 2.0;\n#endif\n",
        "#ifdef A\ny = 2.0;\n#else\nif (x < 0.5) { y = 3.0; }\n#endif\n",
        "#if A\n#if B\nif (x < 0.5) { y = -x * 2.0; }\n#endif\n#elif C\nfor (;;) { }\n#endif\n",
        "y = x\n#ifdef A\n* 2.0;\n#else\n* 3.0;\n#endif\n",
        "if (x < 0.5) { y = 2.0; }\n#ifdef A\nelse y = 3.0;\n#endif\n"})
    EXPECT_EQ(refusal(each, 300), "none") << each;
}

TEST(ShaderDeclarations, StructuresThatDouble) {
  std::string text = "struct S0 { float a; };\n";
  for (int i = 1; i < 40; ++i) text += fmt::format("struct S{} {{ S{} a, b; }};\n", i, i - 1);
  EXPECT_THAT(refusalOf(text), StartsWith("m.frag:8:20: this structure has more than 256 members"));
  EXPECT_EQ(
      refusalOf("struct S { vec3 a, b[900]; float c; };\nstruct { S a, b; } x;\nS f(S a) { return a; }\n"),
      "none");
}

TEST(ShaderDeclarations, StructuresUnderConditions) {
  std::string text = "struct S0 { float a; };\n";
  for (int i = 1; i < 11; ++i)
    text += fmt::format("struct S{} {{\n#if 0\n}};\n#endif\nS{} a, b; }};\n", i, i - 1);
  EXPECT_THAT(refusalOf(text), StartsWith("m.frag:36:8: this structure has more than 256 members"));
  EXPECT_THAT(refusalOf("#if 1\nstruct S\n#else\nstruct T\n#endif\n{ float a; };\n"),
              HasSubstr(": a structure begins or ends under a condition"));
  EXPECT_EQ(refusalOf("#ifdef A\nstruct T { float a; };\n#endif\nstruct S {\n#ifdef A\nT a;\n#else\n"
                      "vec3 a, b;\n#endif\n};\n"),
            "none");
}

TEST(ShaderDeclarations, CallsUnderConditions) {
  std::string functions, calls;
  for (int i = 0; i < 2100; ++i) {
    functions += fmt::format("float f{}(float x) {{ return x; }}\n", i);
    calls += fmt::format("f{}(1.0);", i);
  }
  EXPECT_THAT(refusalOf(functions + "void g() {\n#if 0\n}\n#endif\n" + calls + "\n}\n"),
              HasSubstr("functions call others more than 2048 times"));
  EXPECT_THAT(refusalOf("#if 0\nvoid z() {\n#endif\n" + functions + "void g() {\n" + calls + "\n}\n"),
              HasSubstr("functions call others more than 2048 times"));
}

TEST(ShaderDeclarations, CallsThatTakeACompilerLong) {
  std::string text = "float f0(float x) { return x; }\n";
  for (int i = 1; i < 3000; ++i) text += fmt::format("float f{}(float x) {{ return f{}(x); }}\n", i, i - 1);
  EXPECT_THAT(refusalOf(text), StartsWith("m.frag:2050:"));
  EXPECT_EQ(refusalOf("float f(float x) { return x; }\nvoid main() { " + repeated("f(1.0);", 5000) + "}\n"),
            "none");
}

TEST(ShaderMacros, WordsDoNotHideBehindTheEndsOfLines) {
  EXPECT_THAT(refusalOf("#def\\\nine A B B\n"), StartsWith("m.frag:1:5: a word goes on in the next line\n"));
  EXPECT_THAT(refusalOf("/\\\n/ x\n"), StartsWith("m.frag:1:2: a word goes on"));
  EXPECT_EQ(refusalOf("#define A(x) \\\n  (x); \\\n(x)\n"), "none");
  EXPECT_EQ(refusalOf("#define A(x) {\\\r\n\\\r\nx;\\\n}\n"), "none");
  for (const char* text :
       {"#def\\\n\\\nine A B B\n", "#def\\\r\n\\\nine A B B\n", "x &\\\n& y\n", "1.\\\nA\n"})
    EXPECT_THAT(refusalOf(text), HasSubstr(": a word goes on in the next line\n")) << text;
  for (const char* text : {"#include \"inc. \\\nglsl\"\n", "#include \"inc(\\\nglsl\"\n", "\" \\\" /* \"\n"})
    EXPECT_THAT(refusalOf(text), HasSubstr(": a text in quotes has a backslash, or no end on its line\n"))
        << text;
}

}  // namespace
}  // namespace luxo
