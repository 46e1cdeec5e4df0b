// SPDX-License-Identifier: Apache-2.0
#include "formula/glsl.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/assert.h"
#include "base/error.h"

namespace luxo {
namespace {

/// A float of nine digits reads back exactly; one beyond the largest is an infinity, which has no literal.
std::string floatLiteral(double value) {
  const auto rounded = static_cast<float>(value);
  if (!std::isfinite(rounded))
    return fmt::format("uintBitsToFloat({:#x}u)",
                       std::isnan(rounded) ? 0x7fc00000u : std::bit_cast<std::uint32_t>(rounded));
  std::string text = fmt::format("{:.9g}", rounded);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return std::signbit(rounded) ? fmt::format("({})", text) : text;
}

/// A double takes 17 digits.
std::string doubleLiteral(double value) {
  if (!std::isfinite(value))
    return fmt::format("packDouble2x32(uvec2(0u, {:#x}u))", std::isnan(value) ? 0x7ff80000u
                                                            : value > 0       ? 0x7ff00000u
                                                                              : 0xfff00000u);
  std::string text = fmt::format("{:.17g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  text += "lf";
  return std::signbit(value) ? fmt::format("({})", text) : text;
}

std::string literal(GlslNumber number, double value) {
  return number == GlslNumber::Float ? floatLiteral(value) : doubleLiteral(value);
}

/// A number, or a vector of so many.
std::string typeOf(GlslNumber number, std::size_t size = 1) {
  LUXO_REQUIRE(size >= 1 && size <= 4);
  const bool single = number == GlslNumber::Float;
  return size == 1 ? (single ? "float" : "double") : fmt::format("{}vec{}", single ? "" : "d", size);
}

std::string variable(std::uint32_t index) {
  return index == 0 ? "u" : index == 1 ? "v" : fmt::format("parameterAt({}u)", index - 2);
}

/// The statements of one function body.
class Body {
 public:
  Body(const std::vector<ExprNode>& nodes, GlslNumber number)
      : nodes_(nodes), number_(number), type_(typeOf(number)), names_(nodes.size()) {}

  /// What the roots need of the nodes, operands first.
  void compute(const std::vector<std::uint32_t>& order, const std::vector<std::uint32_t>& roots) {
    std::vector<bool> needed(nodes_.size());
    for (const std::uint32_t root : roots) needed[root] = true;
    for (auto node = order.rbegin(); node != order.rend(); ++node) {
      if (!needed[*node]) continue;
      const ExprNode& n = nodes_[*node];
      if (n.op == Op::Constant || n.op == Op::Variable) continue;
      if (isTurning(n)) {
        std::vector<std::uint32_t> terms;
        collectTerms(n.a, terms);
        for (const std::uint32_t term : terms)
          if (nodes_[term].op == Op::Multiply) needed[nodes_[term].b] = true;
        continue;
      }
      needed[n.a] = true;
      if (operandCount(n.op) > 1) needed[n.b] = true;
      if (operandCount(n.op) > 2) needed[n.c] = true;
    }
    for (const std::uint32_t node : order)
      if (needed[node]) names_[node] = valueOf(nodes_[node]);
  }

  [[nodiscard]] const std::string& name(std::uint32_t node) const { return names_[node]; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  /// How many turns the constant is as an angle, if so many 16ths that a shader multiplies by them without
  /// rounding.
  [[nodiscard]] static std::optional<double> turnsOf(double angle) {
    constexpr double kParts = 16, kMaxParts = 4096;
    const double turns = std::round(kParts * angle / (2 * std::numbers::pi)) / kParts;
    const bool exact = std::abs(turns * 2 * std::numbers::pi - angle) <= 1e-15 * std::abs(angle);
    return exact && std::abs(turns) * kParts < kMaxParts ? std::optional(turns) : std::nullopt;
  }

  /// The terms of a sum of a few; whether each of them is a constant, or something times a constant number of
  /// turns.
  bool collectTerms(std::uint32_t node, std::vector<std::uint32_t>& terms) const {
    constexpr std::size_t kMaxTerms = 8;
    const ExprNode& n = nodes_[node];
    if (n.op == Op::Add || n.op == Op::Subtract) return collectTerms(n.a, terms) && collectTerms(n.b, terms);
    const bool ofTurns = n.op == Op::Multiply && nodes_[n.a].op == Op::Constant && turnsOf(nodes_[n.a].value);
    if (!(ofTurns || (n.op == Op::Constant && std::isfinite(n.value))) || terms.size() == kMaxTerms)
      return false;
    terms.push_back(node);
    return true;
  }

  /// Whether the node is the sine or the cosine of an angle that is known in turns: computed so, nothing of
  /// whole turns is rounded away. A double has digits to spare.
  [[nodiscard]] bool isTurning(const ExprNode& node) const {
    std::vector<std::uint32_t> terms;
    return number_ == GlslNumber::Float && (node.op == Op::Sin || node.op == Op::Cos) &&
           nodes_[node.a].op != Op::Constant && collectTerms(node.a, terms);
  }

  /// An angle for which isTurning() holds, in turns; in a sum without whole ones, which would be rounded.
  std::string turns(std::uint32_t node, bool inSum = false) {
    const auto [known, isNew] = turns_.try_emplace({node, inSum});
    if (isNew) known->second = turnsAnew(nodes_[node], inSum);
    return known->second;
  }

  std::string turnsAnew(const ExprNode& n, bool inSum) {
    if (n.op == Op::Constant) {
      const double all = turnsOf(n.value).value_or(n.value / (2 * std::numbers::pi));
      return literal(number_, all - std::round(all));
    }
    if (n.op != Op::Multiply) {
      const std::string x = turns(n.a, true), y = turns(n.b, true);
      return define(fmt::format("{} {} {}", x, n.op == Op::Add ? '+' : '-', y));
    }
    const double times = *turnsOf(nodes_[n.a].value);
    const std::string &x = names_[n.b], factor = literal(number_, times);
    int power = 0;
    const bool exact = std::abs(std::frexp(times, &power)) == 0.5;  // a power of two
    if (inSum || !exact) return define(fmt::format("formulaTurns({}, {})", x, factor));
    return times == 1 ? x : define(fmt::format("{} * {}", factor, x));
  }

  /// The name or literal that stands for the node from now on.
  std::string valueOf(const ExprNode& node) {
    const auto x = [&] { return std::string_view(names_[node.a]); };
    const auto y = [&] { return std::string_view(names_[node.b]); };
    const auto call = [&](std::string_view function) {
      return define(operandCount(node.op) == 2 ? fmt::format("{}({}, {})", function, x(), y())
                                               : fmt::format("{}({})", function, x()));
    };
    switch (node.op) {
      case Op::Constant:
        return literal(number_, node.value);
      case Op::Variable:
        return node.a < 2 ? variable(node.a) : define(variable(node.a));
      case Op::Negate:
        return define(fmt::format("-{}", x()));
      case Op::Add:
        return define(fmt::format("{} + {}", x(), y()));
      case Op::Subtract:
        return define(fmt::format("{} - {}", x(), y()));
      case Op::Multiply:
        return define(fmt::format("{} * {}", x(), y()));
      case Op::Divide:
        return define(fmt::format("{} / {}", x(), y()));
      case Op::Power:
        return power(names_[node.a], static_cast<int>(node.value));
      case Op::Sqrt:
        return call("sqrt");
      case Op::Exp:
        return call("formulaExp");
      case Op::Log:
        return call("formulaLog");
      case Op::Sin:
        return sinCos(node) + ".x";
      case Op::Cos:
        return sinCos(node) + ".y";
      case Op::Tan:
        return call("formulaTan");
      case Op::Sinh:
        return call("formulaSinh");
      case Op::Cosh:
        return call("formulaCosh");
      case Op::Tanh:
        return call("formulaTanh");
      case Op::Asin:
        return call("formulaAsin");
      case Op::Acos:
        return call("formulaAcos");
      case Op::Atan:
        return call("formulaAtan");
      case Op::Atan2:
        return call("formulaAtan2");
      case Op::Abs:
        return call("abs");
      case Op::Min:
        return call("formulaMin");
      case Op::Max:
        return call("formulaMax");
      case Op::Floor:
        return call("floor");
      case Op::Sign:
        return call("formulaSign");
      case Op::Cardinal:
        return define(fmt::format("formulaCardinal({}, {})", x(), static_cast<int>(node.value)));
      case Op::Raise:
        return call("formulaPow");
      case Op::Less:
        return define(fmt::format("{}({} < {})", type_, x(), y()));
      case Op::LessEqual:
        return define(fmt::format("{}({} <= {})", type_, x(), y()));
      case Op::Equal:
        return define(fmt::format("{}({} == {})", type_, x(), y()));
      case Op::Select:
        return define(fmt::format("{} != {} ? {} : {}", x(), literal(number_, 0), y(), names_[node.c]));
    }
    LUXO_REQUIRE(false && "an operation");
    return {};
  }

  /// Sine and cosine of the node's operand: where one is needed, the other mostly is, too.
  const std::string& sinCos(const ExprNode& node) {
    const auto [known, isNew] = sinCos_.try_emplace(node.a);
    if (isNew)
      known->second = isTurning(node) ? define(fmt::format("formulaSinCosTurns({})", turns(node.a)), 2)
                                      : define(fmt::format("formulaSinCos({})", names_[node.a]), 2);
    return known->second;
  }

  /// A variable with that value, a number or a vector of so many.
  std::string define(std::string_view expression, std::size_t size = 1) {
    std::string name = fmt::format("t{}", count_++);
    fmt::format_to(std::back_inserter(text_), "  {} {} = {};\n", typeOf(number_, size), name, expression);
    return name;
  }

  /// By repeated squaring, as integerPower() does it.
  std::string power(std::string square, int exponent) {
    std::string result;
    for (auto n = std::abs(static_cast<std::int64_t>(exponent)); n > 0; n >>= 1) {
      if (n & 1) result = result.empty() ? square : define(fmt::format("{} * {}", result, square));
      if (n > 1) square = define(fmt::format("{0} * {0}", square));
    }
    const std::string one = literal(number_, 1);
    if (result.empty()) return one;
    return exponent < 0 ? define(fmt::format("{} / {}", one, result)) : result;
  }

  const std::vector<ExprNode>& nodes_;
  GlslNumber number_;
  std::string type_;
  std::vector<std::string> names_;
  std::map<std::pair<std::uint32_t, bool>, std::string> turns_;
  std::map<std::uint32_t, std::string> sinCos_;  ///< by operand
  std::string text_;
  std::size_t count_ = 0;
};

std::vector<std::uint32_t> rootsOf(Graph& graph, std::span<const GlslOutput> outputs) {
  std::vector<std::uint32_t> roots;
  for (const GlslOutput& output : outputs)
    for (const Expr& component : output.components) roots.push_back(graph.nodeOf(component));
  return roots;
}

/// In the code of shaders/lib/formula.glsl and double_math.glsl, where all is inlined.
std::size_t instructionsOf(Op op, GlslNumber number) {
  const bool single = number == GlslNumber::Float;
  switch (op) {
    case Op::Constant:
    case Op::Variable:
      return 0;
    case Op::Sin:
    case Op::Cos:
    case Op::Tan:
      return single ? 45 : 60;
    case Op::Exp:
    case Op::Log:
    case Op::Asin:
    case Op::Acos:
    case Op::Atan:
    case Op::Sinh:
    case Op::Cosh:
    case Op::Tanh:
      return single ? 40 : 70;
    case Op::Atan2:
      return single ? 60 : 90;
    case Op::Cardinal:
    case Op::Raise:
      return single ? 150 : 250;
    default:
      return 2;
  }
}

/// S, Su, Sv and, asked for, Suu, Suv, Svv of a position.
std::vector<ExprPoint> derivativesOf(Graph& graph, const ExprPoint& position, bool second) {
  const auto derivative = [&](const ExprPoint& p, std::uint32_t variable) {
    return ExprPoint{graph.derivative(p[0], variable), graph.derivative(p[1], variable),
                     graph.derivative(p[2], variable)};
  };
  std::vector<ExprPoint> all{position, derivative(position, 0), derivative(position, 1)};
  if (!second) return all;
  const ExprPoint du = all[1], dv = all[2];
  all.insert(all.end(), {derivative(du, 0), derivative(du, 1), derivative(dv, 1)});
  return all;
}

std::vector<GlslOutput> outputsOf(std::span<const ExprPoint> derivatives) {
  constexpr std::string_view kNames[] = {"S", "Su", "Sv", "Suu", "Suv", "Svv"};
  std::vector<GlslOutput> outputs;
  for (std::size_t i = 0; i < derivatives.size(); ++i) outputs.push_back({kNames[i], derivatives[i]});
  return outputs;
}

}  // namespace

std::size_t glslInstructions(Graph& graph, std::span<const GlslOutput> outputs, GlslNumber number) {
  const std::vector<ExprNode>& nodes = graph.nodes();
  std::size_t count = 0;
  std::set<std::uint32_t> angles;  // sine and cosine come together
  for (const std::uint32_t node : reachable(graph, rootsOf(graph, outputs))) {
    const Op op = nodes[node].op;
    const bool turns = op == Op::Sin || op == Op::Cos;
    if (!turns || angles.insert(nodes[node].a).second) count += instructionsOf(op, number);
  }
  return count;
}

std::string emitGlsl(Graph& graph, std::string_view name, std::span<const GlslOutput> outputs,
                     GlslNumber number) {
  const std::vector<std::uint32_t> roots = rootsOf(graph, outputs);
  const std::vector<std::uint32_t> order = inOrderOfNeed(graph, roots);
  if (order.size() > kMaxGlslOperations)
    throw Error(ErrorKind::Scene,
                fmt::format("cannot make a shader of a formula with {} operations; {} are the most",
                            order.size(), kMaxGlslOperations),
                "simplify the formula");
  Body body(graph.nodes(), number);
  body.compute(order, roots);

  std::string text = fmt::format("void {0}(const {1} u, const {1} v", name, typeOf(number));
  for (const GlslOutput& output : outputs)
    fmt::format_to(std::back_inserter(text), ", out {} {}", typeOf(number, output.components.size()),
                   output.name);
  text += ") {\n" + body.text();
  auto root = roots.begin();
  for (const GlslOutput& output : outputs) {
    std::string components;
    for (std::size_t k = 0; k < output.components.size(); ++k)
      components += (k > 0 ? ", " : "") + body.name(*root++);
    fmt::format_to(std::back_inserter(text), "  {} = {}({});\n", output.name,
                   typeOf(number, output.components.size()), components);
  }
  return text + "}\n";
}

std::string emitSurfaceGlsl(Graph& graph, std::string_view name, const ExprPoint& position,
                            bool secondDerivatives, GlslNumber number) {
  const std::vector<ExprPoint> derivatives = derivativesOf(graph, position, secondDerivatives);
  return emitGlsl(graph, name, outputsOf(derivatives), number);
}

std::size_t surfaceGlslInstructions(Graph& graph, const ExprPoint& position, GlslNumber number) {
  const std::vector<ExprPoint> derivatives = derivativesOf(graph, position, false);
  return glslInstructions(graph, outputsOf(derivatives), number);
}

}  // namespace luxo
