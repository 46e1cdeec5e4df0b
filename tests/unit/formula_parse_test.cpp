// SPDX-License-Identifier: Apache-2.0
#include "formula/parse.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "math/numbers.h"

namespace luxo {
namespace {

constexpr double kE = std::numbers::e;
constexpr double kU = 0.7, kV = -1.3, kT = 2.5;

// u, v, t with values: a formula of them folds to a constant.
Scope numbers() {
  Scope scope;
  scope.bind("u", kU);
  scope.bind("v", kV);
  scope.bind("t", kT);
  return scope;
}

std::string messages(std::string_view text, const std::vector<Diagnostic>& diagnostics) {
  std::string all;
  for (const Diagnostic& d : diagnostics) all += describe("formula", text, d) + "\n";
  return all;
}

double valueOf(std::string_view text, Scope scope = numbers()) {
  const Formula formula = parse(text, scope);
  EXPECT_TRUE(formula.ok) << messages(text, formula.diagnostics);
  EXPECT_TRUE(formula.value.isConstant()) << text;
  return formula.value.constant();
}

struct ParsedCase {
  std::string_view text;
  double value;
};

// The same operations in the same order as C++ does them: equal to a rounding of each, so to 1e-15 of the
// value.
void expectValues(const std::vector<ParsedCase>& cases) {
  for (const ParsedCase& c : cases)
    EXPECT_NEAR(valueOf(c.text), c.value, 1e-15 * std::max(1.0, std::abs(c.value))) << c.text;
}

TEST(FormulaNumbers, AreDecimalAndTheirExponentNeedsDigits) {
  expectValues({{"1", 1},
                {".5", 0.5},
                {"1.", 1},
                {"1e-3", 1e-3},
                {"1E+3", 1e3},
                {"2.5e3", 2500},
                {"1.e2", 100},
                {"1e5u", 1e5 * kU},
                {"2e", 2 * kE},
                {"2e-u", 2 * kE - kU},
                {"2exp(u)", 2 * std::exp(kU)},
                {"1e308", 1e308},
                {"5e-324", 5e-324},
                {"00012", 12},
                {" \t1\n+\r\n2 ", 3}});
  EXPECT_EQ(valueOf("0.1"), 0.1) << "correctly rounded";
  EXPECT_EQ(valueOf("123456789012345678901234567890"), 123456789012345678901234567890.0);
}

TEST(FormulaConstants, AreThoseOfMathematics) {
  expectValues(
      {{"pi", kPi}, {"tau", 2 * kPi}, {"e", kE}, {"deg", kPi / 180}, {"18deg", kPi / 10}, {"180deg", kPi}});
}

TEST(FormulaPrecedence, IsThatOfTheGrammar) {
  expectValues({{"1+2*3", 7},         {"(1+2)*3", 9},  {"7-2-1", 4}, {"8/4/2", 1},      {"8/4*2", 4},
                {"2^3^2", 512},       {"(2^3)^2", 64}, {"-2^2", -4}, {"(-2)^2", 4},     {"2^-1", 0.5},
                {"2^-2^2", 1.0 / 16}, {"2*-3", -6},    {"2--3", 5},  {"2-+-3", 5},      {"--2", 2},
                {"-u^2", -kU * kU},   {"1<2", 1},      {"2<1", 0},   {"2<=2", 1},       {"2>=3", 0},
                {"3>2", 1},           {"2==2", 1},     {"2!=2", 0},  {"1+1 == 2*1", 1}, {"(1<2)+(2<1)", 1},
                {"(0<u)*(u<1)", 1}});
}

TEST(FormulaProducts, NeedNoSignBehindANumber) {
  expectValues({{"2u", 2 * kU},
                {"2 u", 2 * kU},
                {"1/2u", kU / 2},
                {"2u^2", 2 * kU * kU},
                {"3(u+1)", 3 * (kU + 1)},
                {"2sin(u)", 2 * std::sin(kU)},
                {"-2u", -2 * kU},
                {"2^2u", 4 * kU},
                {"u^2v", kU * kU * kV},
                {"6/2(1+2)", 9},
                {"2u*3v", 6 * kU * kV},
                {"2u+3v", 2 * kU + 3 * kV},
                {"(3)*2u", 6 * kU}});
}

TEST(FormulaFunctions, MeanWhatTheyMeanInCpp) {
  expectValues({{"sin(u)", std::sin(kU)},
                {"cos(u)", std::cos(kU)},
                {"tan(u)", std::tan(kU)},
                {"asin(u)", std::asin(kU)},
                {"acos(u)", std::acos(kU)},
                {"atan(v)", std::atan(kV)},
                {"atan2(v, u)", std::atan2(kV, kU)},
                {"atan2(1, -1)", 3 * kPi / 4},
                {"sinh(v)", std::sinh(kV)},
                {"cosh(v)", std::cosh(kV)},
                {"tanh(v)", std::tanh(kV)},
                {"exp(v)", std::exp(kV)},
                {"log(u)", std::log(kU)},
                {"sqrt(u)", std::sqrt(kU)},
                {"abs(v)", -kV},
                {"pow(u, 2.5)", std::pow(kU, 2.5)},
                {"u^t", std::pow(kU, kT)},
                {"min(u, v)", kV},
                {"max(u, v)", kU},
                {"min(3, 1, 2)", 1},
                {"max(1, 2, 3, u)", 3},
                {"floor(v)", -2},
                {"floor(u)", 0},
                {"sign(v)", -1},
                {"sign(0)", 0},
                {"sign(u)", 1},
                {"if(u < 1, 10, 20)", 10},
                {"if(0, 10, 20)", 20},
                {"if(-3, 10, 20)", 10},
                {"if(1, 5, 1/0)", 5},
                {"clamp(5, 0, 1)", 1},
                {"clamp(v, 0, 1)", 0},
                {"mix(2, 4, 0.25)", 2.5},
                {"smoothstep(0, 1, 0.25)", 0.15625},
                {"smoothstep(0, 2, -1)", 0},
                {"sin(cos(u) + max(u, 2v))", std::sin(std::cos(kU) + kU)}});
}

TEST(FormulaFunctions, ModIsFloored) {
  expectValues({{"mod(7, 3)", 1}, {"mod(-1, 3)", 2}, {"mod(1, -3)", -2}, {"mod(5.5, 2)", 1.5}});
}

TEST(FormulaGraph, IsTheOneThatOperatorsBuild) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1), t = graph.variable(2);
  Scope scope;
  scope.bind("u", u);
  scope.bind("v", v);
  scope.bind("t", t);
  const auto same = [&](std::string_view text, Expr expression) {
    const Formula formula = parse(text, scope);
    EXPECT_TRUE(formula.ok) << messages(text, formula.diagnostics);
    EXPECT_EQ(graph.nodeOf(formula.value), graph.nodeOf(expression)) << text;
  };
  same("(2 + cos(v))*sin(u)", (2 + cos(v)) * sin(u));
  same("0.2sin(8u + t)", 0.2 * sin(8 * u + t));
  same("u^2/3", pow(u, 2) / 3);
  same("u >= v", lessEqual(v, u));
  same("if(u < v, max(u, v, t), atan2(v, u))", select(less(u, v), max(max(u, v), t), atan2(v, u)));
}

TEST(FormulaScope, DefinitionsComeInAnyOrder) {
  Scope scope = numbers();
  scope.define("c", "a + b");
  scope.define("a", "2b");
  scope.define("b", "u + 1");
  EXPECT_NEAR(valueOf("c", std::move(scope)), 3 * (kU + 1), 1e-15 * 8);
}

TEST(FormulaScope, NamesAreLettersDigitsAndUnderscores) {
  Scope scope;
  scope.bind("a_1", 3);
  scope.bind("_b", 4);
  scope.bind("speedOfT", 5);
  EXPECT_EQ(valueOf("a_1 + _b*speedOfT", std::move(scope)), 23);
}

TEST(FormulaScope, AChainOfDefinitionsMayBeOfAnyLength) {
  Scope scope;
  const int length = 100'000;
  for (int i = 0; i < length; ++i) scope.define(fmt::format("a{}", i), fmt::format("a{} + 1", i + 1));
  scope.define(fmt::format("a{}", length), "0");
  EXPECT_EQ(valueOf("a0", std::move(scope)), length);
}

TEST(FormulaScope, CirclesAreReportedOnceWithTheirNames) {
  Scope scope = numbers();
  scope.define("a", "b + 1");
  scope.define("b", "2c");
  scope.define("c", "u + a");
  const Formula formula = parse("a", scope);
  EXPECT_FALSE(formula.ok);
  EXPECT_TRUE(std::isnan(formula.value.constant()));
  EXPECT_TRUE(formula.diagnostics.empty()) << "the definition reports it";
  std::vector<Diagnostic> all;
  for (const char* name : {"a", "b", "c"}) {
    EXPECT_FALSE(scope.definition(name).ok) << name;
    for (const Diagnostic& d : scope.definition(name).diagnostics) all.push_back(d);
  }
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].message, "'a' depends on itself: a -> b -> c -> a");
  EXPECT_EQ(all[0].where, (SourceRange{4, 5}));
}

TEST(FormulaScope, ACircleOfOneAndACircleOfManyAreNamed) {
  Scope one;
  one.define("a", "1 + a");
  EXPECT_EQ(one.definition("a").diagnostics.at(0).message, "'a' depends on itself: a -> a");
  Scope many;
  for (int i = 0; i < 1000; ++i) many.define(fmt::format("a{}", i), fmt::format("a{}", (i + 1) % 1000));
  EXPECT_FALSE(many.definition("a0").ok);
  EXPECT_EQ(many.definition("a999").diagnostics.at(0).message,
            "'a0' depends on itself: a0 -> a1 -> a2 -> a3 -> a4 -> a5 -> ... -> a999 -> a0");
}

TEST(FormulaScope, ABrokenDefinitionBreaksWhatUsesItWithoutNoise) {
  Scope scope = numbers();
  scope.define("a", "sin(");
  scope.define("b", "a + 1");
  const Formula formula = parse("b*u", scope);
  EXPECT_FALSE(formula.ok);
  EXPECT_TRUE(formula.diagnostics.empty());
  EXPECT_TRUE(scope.definition("b").diagnostics.empty());
  EXPECT_EQ(scope.definition("a").diagnostics.size(), 1u);
}

TEST(FormulaScope, UnusedDefinitionsAreReadWhenAsked) {
  Scope scope = numbers();
  scope.define("a", "q");
  EXPECT_EQ(valueOf("u", numbers()), kU);
  EXPECT_TRUE(parse("u", scope).ok);
  EXPECT_EQ(scope.definition("a").diagnostics.at(0).message, "unknown name 'q'");
}

TEST(FormulaScope, RefusesNamesWithTheReason) {
  Scope scope = numbers();
  scope.explainAbsence("w", "only hypersurfaces have w");
  EXPECT_FALSE(scope.nameProblem("speed"));
  EXPECT_FALSE(scope.nameProblem("w"));
  const auto problem = [&](std::string_view name) {
    const auto found = scope.nameProblem(name);
    EXPECT_TRUE(found && found->where == (SourceRange{0, name.size()}));
    return found ? found->message : "";
  };
  EXPECT_EQ(problem("sin"), "'sin' is the name of a function");
  EXPECT_EQ(problem("if"), "'if' is the name of a function");
  EXPECT_EQ(problem("tau"), "'tau' is the name of a constant");
  EXPECT_EQ(problem("u"), "the name 'u' is taken");
  EXPECT_EQ(problem("2a"), "'2a' cannot be a name");
  EXPECT_EQ(problem(""), "'' cannot be a name");
  EXPECT_EQ(problem("a b"), "'a b' cannot be a name");
  EXPECT_EQ(problem(" a"), "' a' cannot be a name");
  EXPECT_EQ(problem("\u03c0"), "'\u03c0' cannot be a name");
}

TEST(FormulaScope, SaysWhyANameIsMissing) {
  Scope scope;
  scope.explainAbsence("u", "only a surface has u and v");
  const Formula formula = parse("2u", scope);
  ASSERT_EQ(formula.diagnostics.size(), 1u);
  EXPECT_EQ(formula.diagnostics[0],
            (Diagnostic{{1, 2}, "'u' is not known here", "only a surface has u and v"}));
}

struct Mistake {
  std::string_view text;
  std::size_t begin, end;
  std::string_view message;
  std::string_view hint;  // a part of it; empty: there is none
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.text; }

// One mistake, one error, at its place.
class FormulaMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(FormulaMistakes, AreReportedOnceAtTheirPlace) {
  const Mistake& mistake = GetParam();
  Scope scope = numbers();
  scope.bind("k", 3);
  scope.bind("speed", 3);
  const Formula formula = parse(mistake.text, scope);
  EXPECT_FALSE(formula.ok);
  EXPECT_TRUE(std::isnan(formula.value.constant()));
  ASSERT_EQ(formula.diagnostics.size(), 1u) << messages(mistake.text, formula.diagnostics);
  const Diagnostic& d = formula.diagnostics[0];
  const std::string shown = messages(mistake.text, formula.diagnostics);
  EXPECT_EQ(d.message, mistake.message) << shown;
  EXPECT_EQ(d.where, (SourceRange{mistake.begin, mistake.end})) << shown;
  if (mistake.hint.empty())
    EXPECT_EQ(d.hint, "") << shown;
  else
    EXPECT_NE(d.hint.find(mistake.hint), std::string::npos) << shown;
}

INSTANTIATE_TEST_SUITE_P(
    Names, FormulaMistakes,
    testing::Values(Mistake{"cos(u)*uv", 7, 9, "unknown name 'uv'", "did you mean 'u*v'?"},
                    Mistake{"uvt", 0, 3, "unknown name 'uvt'", "did you mean 'u*v*t'?"},
                    Mistake{"2uv", 1, 3, "unknown name 'uv'", "did you mean 'u*v'?"},
                    Mistake{"1+upi", 2, 5, "unknown name 'upi'", "did you mean 'u*pi'?"},
                    Mistake{"speedt", 0, 6, "unknown name 'speedt'", "did you mean 'speed*t'?"},
                    Mistake{"sinu", 0, 4, "unknown name 'sinu'", "did you mean 'sin(u)'?"},
                    Mistake{"vsinu", 0, 5, "unknown name 'vsinu'", "did you mean 'v*sin(u)'?"},
                    Mistake{"cos2u", 0, 5, "unknown name 'cos2u'", "did you mean 'cos(2*u)'?"},
                    Mistake{"vsin(u)", 0, 4, "unknown function 'vsin'", "did you mean 'v*sin('?"},
                    Mistake{"uv(1)", 0, 2, "unknown function 'uv'", "did you mean 'u*v*('?"},
                    Mistake{"u2", 0, 2, "unknown name 'u2'", "did you mean 'u^2' or '2*u'?"},
                    Mistake{"sped", 0, 4, "unknown name 'sped'", "did you mean 'speed'?"},
                    Mistake{"PI", 0, 2, "unknown name 'PI'", "did you mean 'pi'?"},
                    Mistake{"w", 0, 1, "unknown name 'w'", "known here: k, speed, t, u, v, pi"},
                    Mistake{"w+w*w", 0, 1, "unknown name 'w'", "known here"},
                    Mistake{"sni(u)", 0, 3, "unknown function 'sni'", "did you mean 'sin'?"},
                    Mistake{"wobble(u)", 0, 6, "unknown function 'wobble'", "functions: sin, cos"},
                    Mistake{"arcsin(u)", 0, 6, "unknown function 'arcsin'", "write 'asin'"},
                    Mistake{"ln(u)", 0, 2, "unknown function 'ln'", "'log', the natural"},
                    Mistake{"log10(u)", 0, 5, "unknown function 'log10'", "log(x)/log(10)"},
                    Mistake{"ceil(u)", 0, 4, "unknown function 'ceil'", "-floor(-x)"},
                    Mistake{"u(v+1)", 0, 1, "'u' is a value, not a function", "to multiply, write 'u*('"},
                    Mistake{"pi(2)", 0, 2, "'pi' is a value, not a function", "write 'pi*('"},
                    Mistake{"inf", 0, 3, "unknown name 'inf'", "no infinity"},
                    Mistake{"NaN", 0, 3, "unknown name 'NaN'", "a number as its value"},
                    Mistake{"90 degrees", 3, 10, "unknown name 'degrees'", "written 18deg"},
                    Mistake{"2*time", 2, 6, "unknown name 'time'", "'t', in seconds"},
                    Mistake{"u and v", 2, 5, "unknown name 'and'", "'and' is a product"},
                    Mistake{"not u", 0, 3, "unknown name 'not'", "comparison with 0"},
                    Mistake{"i + 1", 0, 1, "unknown name 'i'", "known here"},
                    Mistake{"f(u)", 0, 1, "unknown function 'f'", "functions: sin"},
                    Mistake{"math.sin(u)", 0, 5, "a '.' inside a name", "write 'sin' alone"},
                    Mistake{"u.v", 0, 2, "a '.' inside a name", "'u*v' for a product"},
                    Mistake{"true", 0, 4, "unknown name 'true'", "write 1"}));

INSTANTIATE_TEST_SUITE_P(
    Functions, FormulaMistakes,
    testing::Values(Mistake{"1 + sin()", 4, 9, "sin takes 1 argument, not 0", "write sin(x)"},
                    Mistake{"sin(u, v)", 0, 9, "sin takes 1 argument, not 2", "write sin(x)"},
                    Mistake{"clamp(u, 1)", 0, 11, "clamp takes 3 arguments, not 2", "clamp(x, low, high)"},
                    Mistake{"max(u)", 0, 6, "max takes at least 2 arguments, not 1", "max(a, b, ...)"},
                    Mistake{"atan(u, v)", 0, 10, "atan takes 1 argument, not 2", "atan2(y, x)"},
                    Mistake{"log(u, 2)", 0, 9, "log takes 1 argument, not 2", "log(x)/log(base)"},
                    Mistake{"if(u<1, 2)", 0, 10, "if takes 3 arguments, not 2", "if(condition, a, b)"},
                    Mistake{"sin u", 0, 3, "the function 'sin' needs brackets", "'sin(u)'"},
                    Mistake{"2sin", 1, 4, "the function 'sin' needs brackets", "sin(x)"},
                    Mistake{"sin^2(u)", 0, 3, "the function 'sin' needs brackets", "sin(x)^2"},
                    Mistake{"tan^-1(u)", 0, 3, "the function 'tan' needs brackets", "atan(x)"},
                    Mistake{"sin 45deg", 0, 3, "the function 'sin' needs brackets", "'sin(45deg)'"},
                    Mistake{"max u v", 0, 3, "the function 'max' needs brackets", "max(a, b, ...)"},
                    Mistake{"if u<0 then 1 else 2", 0, 2, "the function 'if' needs brackets", "if(condition"},
                    Mistake{"sin(0,5)", 0, 8, "sin takes 1 argument, not 2", "decimals take a point: 0.5"},
                    Mistake{"sin(u,)", 5, 6, "an argument is missing behind this comma", ""},
                    Mistake{"min(u,,v)", 5, 6, "an argument is missing behind this comma", ""},
                    Mistake{"min(,u,v)", 4, 5, "an argument is missing before this comma", ""},
                    Mistake{"min(u,v,)", 7, 8, "an argument is missing behind this comma", ""}));

INSTANTIATE_TEST_SUITE_P(
    Brackets, FormulaMistakes,
    testing::Values(Mistake{"2*(u+1", 2, 3, "this '(' is never closed", "add the ')'"},
                    Mistake{"sin(u", 3, 4, "this '(' is never closed", "add the ')'"},
                    Mistake{"sin(", 3, 4, "this '(' is never closed", "add the ')'"},
                    Mistake{"(sin(u)", 0, 1, "this '(' is never closed", "add the ')'"},
                    Mistake{"u+1)", 3, 4, "this ')' closes no bracket", "remove it"},
                    Mistake{")", 0, 1, "')' has nothing on its left", ""},
                    Mistake{"u)*v", 1, 2, "this ')' closes no bracket", "remove it"},
                    Mistake{"2*()", 2, 4, "nothing between these brackets", ""},
                    Mistake{"(u)(v)", 3, 4, "an operator is missing before this", "')*('"},
                    Mistake{"u v", 2, 3, "an operator is missing before this", "'u*v'"},
                    Mistake{"sin(u)cos(v)", 6, 9, "an operator is missing before this", "')*cos'"},
                    Mistake{"(u+v)2", 5, 6, "an operator is missing before this", "')*2'"},
                    Mistake{"(1, 2)", 2, 3, "a comma that separates no arguments", ""},
                    Mistake{"1,5", 1, 2, "a comma that separates no arguments", "decimals take a point: 1.5"},
                    Mistake{"u, v", 1, 2, "a comma that separates no arguments", ""}));

INSTANTIATE_TEST_SUITE_P(
    Operators, FormulaMistakes,
    testing::Values(
        Mistake{"", 0, 0, "the formula is empty", "write a number"},
        Mistake{" \t", 0, 2, "the formula is empty", "write a number"},
        Mistake{"u+", 1, 2, "'+' has nothing on its right", ""},
        Mistake{"(u+)*2", 2, 3, "'+' has nothing on its right", ""},
        Mistake{"*u", 0, 1, "'*' has nothing on its left", ""},
        Mistake{"2+(/u)", 3, 4, "'/' has nothing on its left", ""},
        Mistake{"u*/v", 1, 2, "'*' has nothing on its right", ""},
        Mistake{"-", 0, 1, "'-' has nothing on its right", ""},
        Mistake{"2^", 1, 2, "'^' has nothing on its right", ""},
        Mistake{"u<", 1, 2, "'<' has nothing on its right", ""},
        Mistake{"0<u<1", 3, 4, "comparisons cannot be chained", "write (0<u)*(u<1)"},
        Mistake{"0 <= 2u < k+1", 8, 9, "comparisons cannot be chained", "(0 <= 2u)*(2u < k+1)"},
        Mistake{"u**2", 1, 3, "unexpected '**'", "'^'"}, Mistake{"u = 1", 2, 3, "unexpected '='", "'=='"},
        Mistake{"|u|", 0, 1, "unexpected '|'", "abs(x)"},
        Mistake{"'u'", 0, 1, "unexpected '\''", "no quotes"},
        Mistake{"u<0 ? 1 : 2", 4, 5, "unexpected '?'", "if(condition, a, b)"},
        Mistake{"sin[u]", 3, 4, "unexpected '['", "round"},
        Mistake{"0<u<v<1<2", 3, 4, "comparisons cannot be chained", "a product of comparisons"},
        Mistake{"u<1 && v<1", 4, 6, "unexpected '&&'", "product: (u < 1)*(v < 1)"},
        Mistake{"u<1 || v<1", 4, 6, "unexpected '||'", "maximum"},
        Mistake{"!(u<1)", 0, 1, "unexpected '!'", "== 0"},
        Mistake{"u % 2", 2, 3, "unexpected '%'", "mod(a, b)"},
        Mistake{"u =< 2", 2, 4, "unexpected '=<'", "'<='"},
        Mistake{"u & v", 2, 3, "unexpected '&'", "product"}, Mistake{"$k", 0, 1, "unexpected '$'", "alone"},
        Mistake{"u @ 2", 2, 3, "unexpected '@'", ""}, Mistake{"u;", 1, 2, "unexpected ';'", "','"},
        Mistake{"\\frac{u}{v}", 0, 5, "'\\frac' is LaTeX, which is not read", "a/b"},
        Mistake{"1 2", 2, 3, "two numbers in a row", "operator"},
        Mistake{"2*1.5.2", 2, 7, "'1.5.2' has more than one decimal point", ""},
        Mistake{"u + .", 4, 5, "a '.' without a number", "0.5"},
        Mistake{"2*1e999", 2, 7, "the number 1e999 is out of range", "1.8e308"},
        Mistake{"1e-999", 0, 6, "the number 1e-999 is out of range", "4.9e-324"}));

INSTANTIATE_TEST_SUITE_P(
    CopiedText, FormulaMistakes,
    testing::Values(Mistake{"u\u00d7v", 1, 3, "unexpected '\u00d7'", "write '*'"},
                    Mistake{"u\u00b7v", 1, 3, "unexpected '\u00b7'", "write '*'"},
                    Mistake{"2\u2212u", 1, 4, "unexpected '\u2212'", "write '-'"},
                    Mistake{"2\u03c0", 1, 3, "unexpected '\u03c0'", "write 'pi'"},
                    Mistake{"u\u00b2+v", 1, 3, "unexpected '\u00b2'", "write '^2'"},
                    Mistake{"\u221a(u)", 0, 3, "unexpected '\u221a'", "write 'sqrt'"},
                    Mistake{"\u221au", 0, 3, "unexpected '\u221a'", "write 'sqrt'"},
                    Mistake{"18\u00b0", 2, 4, "unexpected '\u00b0'", "write 'deg'"},
                    Mistake{"u\u2264v", 1, 4, "unexpected '\u2264'", "write '<='"},
                    Mistake{"1/\u221e", 2, 5, "unexpected '\u221e'", "no infinity"},
                    Mistake{"2\u00a0u", 1, 3, "an invisible character that is no space (U+00A0)",
                            "plain space"},
                    Mistake{"\u03b8+1", 0, 2, "unexpected character '\u03b8' (U+03B8)", "ASCII"},
                    Mistake{"u+\xff", 2, 3, "the byte 0xff is not text (UTF-8)", "UTF-8"},
                    Mistake{std::string_view("u+\0", 3), 2, 3, "unexpected control character (code 0)", ""}));

std::vector<std::size_t> placesIn(std::string_view text) {
  Scope scope = numbers();
  std::vector<std::size_t> places;
  for (const Diagnostic& d : parse(text, scope).diagnostics) places.push_back(d.where.begin);
  return places;
}

TEST(FormulaErrors, AllIndependentOnesAreReported) {
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(placesIn("foo(u) + uv + sin()"), (Places{0, 9, 14}));
  EXPECT_EQ(placesIn("sin(a, b) + c"), (Places{0, 4, 7, 12}));
  EXPECT_EQ(placesIn("(u + ) * (v * ) + w"), (Places{3, 12, 18}));
  EXPECT_EQ(placesIn("min(u v, q) + 1 2"), (Places{6, 9, 16}));
  EXPECT_EQ(placesIn("\u201cu\u00d7q\u201d"), (Places{0, 4, 6}));
  EXPECT_EQ(placesIn("u) + q"), (Places{1, 5}));
  EXPECT_EQ(placesIn("(u + q"), (Places{0, 5}));
}

TEST(FormulaErrors, StopAfterTen) {
  std::string names, symbols, commas;
  for (int i = 0; i < 50; ++i) {
    names += "+q" + std::to_string(i);
    symbols += "@";
    commas += ",";
  }
  for (const std::string& text : {names, symbols, commas}) {
    EXPECT_EQ(placesIn(text).size(), kMaxFormulaErrors) << text;
  }
}

TEST(FormulaLimits, ALongFormulaIsReadAndALongerOneRefused) {
  std::string text = "0";
  while (text.size() + 2 <= kMaxFormulaBytes) text += "+1";
  EXPECT_EQ(valueOf(text), static_cast<double>(text.size() / 2));
  text.append(kMaxFormulaBytes + 1 - text.size(), ' ');
  Scope scope;
  const Formula refused = parse(text, scope);
  EXPECT_FALSE(refused.ok);
  ASSERT_EQ(refused.diagnostics.size(), 1u);
  EXPECT_EQ(refused.diagnostics[0].message, "a formula of 65537 bytes; at most 65536 are read");
}

TEST(FormulaLimits, NestingIsReadToItsLimitAndRefusedBeyond) {
  const auto nested = [](int levels, std::string_view open, std::string_view close) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += open;
    text += "1";
    for (int i = 0; i < levels; ++i) text += close;
    return text;
  };
  for (const auto& [open, close] : {std::pair("(", ")"), {"abs(", ")"}, {"1^", ""}, {"max(0,", ")"}}) {
    EXPECT_EQ(valueOf(nested(kMaxFormulaNesting, open, close)), 1) << open;
    for (const int levels : {kMaxFormulaNesting + 1, 5'000}) {
      Scope scope;
      const Formula refused = parse(nested(levels, open, close), scope);
      EXPECT_FALSE(refused.ok);
      ASSERT_EQ(refused.diagnostics.size(), 1u) << open;
      EXPECT_EQ(refused.diagnostics[0].message, "brackets, calls and powers nest deeper than 256 levels");
    }
  }
  EXPECT_EQ(valueOf(nested(30'000, "-", "")), 1) << "signs do not nest";
}

TEST(FormulaLimits, NamesAndNumbersMayBeLong) {
  const std::string name(50'000, 'n');
  Scope scope;
  scope.bind(name, 3);
  EXPECT_TRUE(parse(name, scope).ok);
  const Formula unknown = parse(name + "x", scope);
  ASSERT_EQ(unknown.diagnostics.size(), 1u);
  EXPECT_LT(unknown.diagnostics[0].message.size(), 100u);
  EXPECT_EQ(valueOf("0." + std::string(50'000, '0')), 0);
}

}  // namespace
}  // namespace luxo
