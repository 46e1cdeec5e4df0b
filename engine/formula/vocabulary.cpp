// SPDX-License-Identifier: Apache-2.0
#include "formula/vocabulary.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/suggestion.h"

namespace luxo {
namespace {

using Arguments = std::span<const Expr>;

template <Expr (*function)(Expr)>
constexpr FormulaFunction unary(std::string_view name, std::string_view signature) {
  return {name, signature, 1, false, [](Arguments a) { return function(a[0]); }};
}

template <Expr (*function)(Expr, Expr)>
constexpr FormulaFunction binary(std::string_view name, std::string_view signature) {
  return {name, signature, 2, false, [](Arguments a) { return function(a[0], a[1]); }};
}

template <Expr (*function)(Expr, Expr, Expr)>
constexpr FormulaFunction ternary(std::string_view name, std::string_view signature) {
  return {name, signature, 3, false, [](Arguments a) { return function(a[0], a[1], a[2]); }};
}

template <Expr (*function)(Expr, Expr)>
constexpr FormulaFunction chain(std::string_view name, std::string_view signature) {
  return {name, signature, 2, true, [](Arguments a) {
            Expr result = a[0];
            for (const Expr& next : a.subspan(1)) result = function(result, next);
            return result;
          }};
}

constexpr FormulaFunction kFunctions[] = {
    unary<sin>("sin", "sin(x)"),
    unary<cos>("cos", "cos(x)"),
    unary<tan>("tan", "tan(x)"),
    unary<asin>("asin", "asin(x)"),
    unary<acos>("acos", "acos(x)"),
    unary<atan>("atan", "atan(x)"),
    binary<atan2>("atan2", "atan2(y, x)"),
    unary<sinh>("sinh", "sinh(x)"),
    unary<cosh>("cosh", "cosh(x)"),
    unary<tanh>("tanh", "tanh(x)"),
    unary<exp>("exp", "exp(x)"),
    unary<log>("log", "log(x)"),
    unary<sqrt>("sqrt", "sqrt(x)"),
    unary<abs>("abs", "abs(x)"),
    chain<min>("min", "min(a, b, ...)"),
    chain<max>("max", "max(a, b, ...)"),
    unary<floor>("floor", "floor(x)"),
    unary<sign>("sign", "sign(x)"),
    binary<mod>("mod", "mod(x, y)"),
    ternary<clamp>("clamp", "clamp(x, low, high)"),
    ternary<mix>("mix", "mix(a, b, t)"),
    ternary<smoothstep>("smoothstep", "smoothstep(low, high, x)"),
    ternary<select>("if", "if(condition, a, b)"),
    binary<pow>("pow", "pow(x, y)"),
};

constexpr FormulaConstant kConstants[] = {
    {"pi", std::numbers::pi},
    {"tau", 2 * std::numbers::pi},
    {"e", std::numbers::e},
    {"deg", std::numbers::pi / 180},
};

struct Advice {
  std::string_view name, hint;
};

constexpr Advice kAdvice[] = {
    {"arcsin", "write 'asin'"},
    {"arccos", "write 'acos'"},
    {"arctan", "write 'atan'"},
    {"arctan2", "write 'atan2(y, x)'"},
    {"ln", "write 'log', the natural logarithm"},
    {"lg", "write 'log(x)/log(10)'"},
    {"log10", "write 'log(x)/log(10)'"},
    {"log2", "write 'log(x)/log(2)'"},
    {"exp2", "write '2^x'"},
    {"sqr", "write 'x^2'"},
    {"square", "write 'x^2'"},
    {"power", "write 'x^y'"},
    {"cbrt", "write 'sign(x)*abs(x)^(1/3)'"},
    {"root", "write 'sqrt(x)', or 'x^(1/n)'"},
    {"hypot", "write 'sqrt(x^2 + y^2)'"},
    {"ceil", "write '-floor(-x)'"},
    {"round", "write 'floor(x + 0.5)'"},
    {"trunc", "write 'sign(x)*floor(abs(x))'"},
    {"int", "write 'floor(x)'"},
    {"fract", "write 'mod(x, 1)'"},
    {"frac", "write 'mod(x, 1)'"},
    {"fmod", "write 'mod(x, y)'"},
    {"sgn", "write 'sign'"},
    {"fabs", "write 'abs'"},
    {"lerp", "write 'mix(a, b, t)'"},
    {"step", "write 'x >= edge'"},
    {"heaviside", "write 'x >= 0'"},
    {"sec", "write '1/cos(x)'"},
    {"csc", "write '1/sin(x)'"},
    {"cot", "write '1/tan(x)'"},
    {"sech", "write '1/cosh(x)'"},
    {"csch", "write '1/sinh(x)'"},
    {"coth", "write '1/tanh(x)'"},
    {"tg", "write 'tan'"},
    {"sh", "write 'sinh'"},
    {"ch", "write 'cosh'"},
    {"th", "write 'tanh'"},
    {"asinh", "write 'log(x + sqrt(x^2 + 1))'"},
    {"acosh", "write 'log(x + sqrt(x^2 - 1))'"},
    {"atanh", "write 'log((1 + x)/(1 - x))/2'"},
    {"degrees", "degrees are written 18deg, and counted by x/deg"},
    {"radians", "write 'x*deg'"},
    {"degree", "degrees are written 18deg"},
    {"rad", "angles are radians already"},
    {"time", "the time is 't', in seconds"},
    {"sind", "write 'sin(x*deg)'"},
    {"cosd", "write 'cos(x*deg)'"},
    {"tand", "write 'tan(x*deg)'"},
    {"select", "write 'if(condition, a, b)'"},
    {"where", "write 'if(condition, a, b)'"},
    {"then", "write 'if(condition, a, b)'"},
    {"else", "write 'if(condition, a, b)'"},
    {"and", "'and' is a product: (u < 1)*(v < 1)"},
    {"or", "'or' is a maximum: max(u < 1, v < 1)"},
    {"not", "'not' is a comparison with 0: (u < 1) == 0"},
    {"true", "write 1"},
    {"false", "write 0"},
    {"inf", "formulas know no infinity: write a large number"},
    {"infinity", "formulas know no infinity: write a large number"},
    {"nan", "every formula has a number as its value"},
    {"random", "the same scene is always the same picture: there is no chance in it"},
    {"rand", "the same scene is always the same picture: there is no chance in it"},
    {"noise", "the same scene is always the same picture: there is no chance in it"},
};

constexpr std::size_t kLongestProduct = 32;  // a longer name is no product of letters
constexpr std::size_t kLongestTypo = 64;     // nor is a longer one a slip

std::string lowered(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

// The product with the fewest factors; numbers may start it: "2uv" -> "2*u*v". Quadratic in a short text.
std::string fewestFactors(std::string_view text, std::span<const std::string> values) {
  struct Best {
    std::size_t factors = 0;
    std::string product;
  };
  std::size_t digits = 0;
  while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9') ++digits;
  std::vector<Best> best(text.size() + 1);
  best[digits] = {1, std::string(text.substr(0, digits))};
  for (std::size_t begin = digits; begin < text.size(); ++begin) {
    if (best[begin].factors == 0) continue;
    for (const std::string& value : values) {
      if (value.empty() || !text.substr(begin).starts_with(value)) continue;
      Best& reached = best[begin + value.size()];
      if (reached.factors != 0 && reached.factors <= best[begin].factors + 1) continue;
      reached = {best[begin].factors + 1, best[begin].product + (begin == 0 ? "" : "*") + value};
    }
  }
  return best.back().factors == 0 ? std::string() : best.back().product;
}

// What to write for a name that other languages have; empty when it is none.
std::string_view adviceFor(std::string_view name) {
  const std::string known = lowered(name);
  for (const Advice& advice : kAdvice)
    if (advice.name == known) return advice.hint;
  return {};
}

// A name as a product of values; empty when it is none.
std::string asProduct(std::string_view name, std::span<const std::string> values) {
  return name.size() > kLongestProduct ? std::string() : fewestFactors(name, values);
}

// A name as a function beside its argument, "vsinu" -> "v*sin(u)", or where a bracket follows behind a
// factor: "vsin" -> "v*sin". Empty when it is neither.
std::string asCall(std::string_view name, std::span<const std::string> values, bool bracketFollows) {
  if (name.size() > kLongestProduct) return {};
  for (const FormulaFunction& function : kFunctions) {
    for (std::size_t at = name.find(function.name); at != name.npos; at = name.find(function.name, at + 1)) {
      const std::string_view before = name.substr(0, at), after = name.substr(at + function.name.size());
      if (after.empty() != bracketFollows || (bracketFollows && before.empty())) continue;
      const std::string factor = fewestFactors(before, values), argument = fewestFactors(after, values);
      if (factor.empty() != before.empty() || argument.empty() != after.empty()) continue;
      return (factor.empty() ? "" : factor + "*") + std::string(function.name) +
             (bracketFollows ? "" : "(" + argument + ")");
    }
  }
  return {};
}

std::string meant(std::string_view what) { return fmt::format("did you mean '{}'?", what); }

}  // namespace

std::span<const FormulaConstant> formulaConstants() { return kConstants; }

const FormulaFunction* findFunction(std::string_view name) {
  const auto* found = std::find_if(std::begin(kFunctions), std::end(kFunctions),
                                   [&](const FormulaFunction& f) { return f.name == name; });
  return found == std::end(kFunctions) ? nullptr : found;
}

const FormulaConstant* findConstant(std::string_view name) {
  const auto* found = std::find_if(std::begin(kConstants), std::end(kConstants),
                                   [&](const FormulaConstant& c) { return c.name == name; });
  return found == std::end(kConstants) ? nullptr : found;
}

std::string hintForValue(std::string_view name, const std::vector<std::string>& values) {
  if (const std::string product = asProduct(name, values); !product.empty()) return meant(product);
  if (const std::string_view advice = adviceFor(name); !advice.empty()) return std::string(advice);
  const std::string_view letters = name.substr(0, name.find_last_not_of("0123456789") + 1);
  if (std::find(values.begin(), values.end(), letters) != values.end())
    return fmt::format("did you mean '{0}^{1}' or '{1}*{0}'?", letters, name.substr(letters.size()));
  if (const std::string call = asCall(name, values, false); !call.empty()) return meant(call);
  if (name.size() <= kLongestTypo)
    if (const std::string closest = closestName(name, values); !closest.empty()) return meant(closest);
  constexpr std::size_t kMaxListed = 16;
  return values.size() <= kMaxListed ? "known here: " + listed(values) : std::string();
}

std::string hintForFunction(std::string_view name, const std::vector<std::string>& values) {
  if (const std::string_view advice = adviceFor(name); !advice.empty()) return std::string(advice);
  if (const std::string split = asCall(name, values, true); !split.empty()) return meant(split + "(");
  if (const std::string product = asProduct(name, values); !product.empty()) return meant(product + "*(");
  std::vector<std::string> functions;
  for (const FormulaFunction& function : kFunctions) functions.emplace_back(function.name);
  const std::string all = "functions: " + listed(functions);
  return name.size() <= kLongestTypo ? didYouMean(name, functions, all) : all;
}

}  // namespace luxo
