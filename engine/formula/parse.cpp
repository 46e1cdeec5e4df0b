// SPDX-License-Identifier: Apache-2.0
// Precedence climbing. After an error reading goes on as if the nearest right thing had been written, so that
// one reading finds every independent mistake; what follows from a mistake is not reported.
#include "formula/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "formula/names.h"
#include "formula/token.h"
#include "formula/vocabulary.h"

namespace luxo {
namespace {

bool isComparison(TokenKind kind) { return kind >= TokenKind::Less && kind <= TokenKind::NotEqual; }

bool startsOperand(TokenKind kind) {
  return kind == TokenKind::Number || kind == TokenKind::Name || kind == TokenKind::Open;
}

Expr compare(TokenKind kind, Expr a, Expr b) {
  switch (kind) {
    case TokenKind::Less:
      return less(a, b);
    case TokenKind::LessEqual:
      return lessEqual(a, b);
    case TokenKind::Greater:
      return less(b, a);
    case TokenKind::GreaterEqual:
      return lessEqual(b, a);
    case TokenKind::Equal:
      return equal(a, b);
    default:
      return notEqual(a, b);
  }
}

class Parser {
 public:
  Parser(std::string_view text, const std::vector<Token>& tokens, std::vector<Diagnostic> diagnostics,
         const FormulaNames& names)
      : text_(text), tokens_(tokens), diagnostics_(std::move(diagnostics)), names_(names) {}

  Formula run() {
    Expr value = 0;
    if (kind() == TokenKind::End)
      report({0, text_.size()}, "the formula is empty", "write a number or an expression");
    else
      value = formula();
    while (kind() != TokenKind::End) {
      if (kind() == TokenKind::Comma)
        strayComma();
      else
        report(peek().where, fmt::format("this '{}' closes no bracket", peek().text),
               "remove it, or open one");
      take();
      if (kind() != TokenKind::End) continueAfterError();
    }
    std::stable_sort(diagnostics_.begin(), diagnostics_.end(),
                     [](const Diagnostic& a, const Diagnostic& b) { return a.where.begin < b.where.begin; });
    Formula result;
    result.ok = diagnostics_.empty() && !broken_;
    if (result.ok) result.value = value;
    result.diagnostics = std::move(diagnostics_);
    return result;
  }

 private:
  /// Counts what is inside each other, for as long as it lives.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) { ++parser_.depth_; }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

    [[nodiscard]] bool isTooDeep() const { return parser_.depth_ > kMaxFormulaNesting; }

   private:
    Parser& parser_;
  };

  const Token& peek() const { return tokens_[next_]; }
  const Token& previous() const { return tokens_[next_ - 1]; }
  TokenKind kind() const { return peek().kind; }
  const Token& take() { return kind() == TokenKind::End ? peek() : tokens_[next_++]; }
  // To the end; nothing found on the way out is reported.
  void giveUp() {
    next_ = tokens_.size() - 1;
    gaveUp_ = true;
  }

  void report(SourceRange where, std::string message, std::string hint) {
    const bool known = std::any_of(diagnostics_.begin(), diagnostics_.end(),
                                   [&](const Diagnostic& d) { return d.where.begin == where.begin; });
    if (diagnostics_.size() >= kMaxFormulaErrors) giveUp();
    if (!known && !gaveUp_) diagnostics_.push_back({where, std::move(message), std::move(hint)});
  }

  // A value to go on with. What is built from it is thrown away.
  Expr broken() {
    broken_ = true;
    return 1;
  }

  std::string_view between(std::size_t firstToken, std::size_t endToken) const {
    const std::size_t begin = tokens_[firstToken].where.begin, end = tokens_[endToken - 1].where.end;
    return end > begin ? text_.substr(begin, end - begin) : std::string_view();
  }

  // formula := comparison; a Bad token stands for an operator that was meant.
  Expr formula() {
    Expr value = comparison();
    while (kind() == TokenKind::Bad) {
      take();
      broken();
      if (startsOperand(kind()) || kind() == TokenKind::Minus || kind() == TokenKind::Plus)
        comparison();
      else
        continueAfterError();
    }
    return value;
  }

  // Behind an error: an operator or an operand may follow.
  void continueAfterError() {
    while (kind() >= TokenKind::Plus && kind() <= TokenKind::Power) take();
    if (isComparison(kind())) take();
    if (startsOperand(kind())) formula();
  }

  Expr comparison() {
    const std::size_t first = next_;
    Expr a = sum();
    if (!isComparison(kind())) return a;
    const std::size_t operation = next_;
    take();
    const Expr b = sum();
    a = compare(tokens_[operation].kind, a, b);
    if (isComparison(kind())) chainedComparison(first, operation);
    return a;
  }

  void chainedComparison(std::size_t first, std::size_t operation) {
    const std::size_t chained = next_;
    take();
    sum();
    const std::string_view left = between(first, chained), right = between(operation + 1, next_);
    const bool isLong = isComparison(kind()) || left.size() + right.size() > 60;
    report(tokens_[chained].where, "comparisons cannot be chained",
           isLong ? "write a product of comparisons" : fmt::format("write ({})*({})", left, right));
    while (isComparison(kind())) {
      take();
      sum();
    }
  }

  Expr sum() {
    Expr value = product();
    while (kind() == TokenKind::Plus || kind() == TokenKind::Minus) {
      const bool plus = take().kind == TokenKind::Plus;
      const Expr next = product();
      value = plus ? value + next : value - next;
    }
    return value;
  }

  Expr product() {
    Expr value = signedPower();
    while (true) {
      if (kind() == TokenKind::Times || kind() == TokenKind::Divide) {
        const bool times = take().kind == TokenKind::Times;
        const Expr next = signedPower();
        value = times ? value * next : value / next;
      } else if (startsOperand(kind())) {
        const bool afterNumber = previous().kind == TokenKind::Number && kind() != TokenKind::Number;
        if (!afterNumber) missingOperator();
        value = value * power();
      } else {
        return value;
      }
    }
  }

  void missingOperator() {
    const Token& left = previous();
    const Token& right = peek();
    if (left.kind == TokenKind::Number && right.kind == TokenKind::Number)
      return report(right.where, "two numbers in a row",
                    fmt::format("write an operator between them, or no space: {}{}", shortened(left.text),
                                shortened(right.text)));
    broken();
    if (isUnknown(left) || isUnknown(right)) return;  // "u and v": the name is the mistake
    report(right.where, "an operator is missing before this",
           fmt::format("to multiply, write '{}*{}'", shortened(left.text), shortened(right.text)));
  }

  bool isUnknown(const Token& token) const {
    return token.kind == TokenKind::Name && !findFunction(token.text) && !findConstant(token.text) &&
           !names_.find(token.text);
  }

  Expr signedPower() {
    bool negative = false;
    while (kind() == TokenKind::Minus || kind() == TokenKind::Plus)
      if (take().kind == TokenKind::Minus) negative = !negative;
    const Expr value = power();
    return negative ? -value : value;
  }

  Expr power() {
    const Expr base = primary();
    if (kind() != TokenKind::Power) return base;
    const Level level(*this);
    if (level.isTooDeep()) return tooDeep();
    take();
    return pow(base, signedPower());
  }

  Expr primary() {
    while (kind() == TokenKind::Bad) {
      take();
      broken();
      if (!startsOperand(kind()) && kind() != TokenKind::Bad) return 1;
    }
    switch (kind()) {
      case TokenKind::Number:
        return take().number;
      case TokenKind::Name:
        return tokens_[next_ + 1].kind == TokenKind::Open ? call() : value();
      case TokenKind::Open:
        return group();
      default:
        return missingOperand();
    }
  }

  Expr tooDeep() {
    report(peek().where,
           fmt::format("brackets, calls and powers nest deeper than {} levels", kMaxFormulaNesting),
           "name parts of the formula in 'let'");
    giveUp();
    return broken();
  }

  Expr missingOperand() {
    broken();
    const bool first = next_ == 0 || previous().kind == TokenKind::Open;
    if (first && next_ > 0 && kind() == TokenKind::Close)
      report({previous().where.begin, peek().where.end}, "nothing between these brackets", {});
    else if (first && kind() == TokenKind::Comma)
      report(peek().where, "an argument is missing before this comma", {});
    else if (first && kind() != TokenKind::End)
      report(peek().where, fmt::format("'{}' has nothing on its left", peek().text), {});
    else if (!first && previous().kind == TokenKind::Comma)
      report(previous().where, "an argument is missing behind this comma", {});
    else if (!first)
      report(previous().where, fmt::format("'{}' has nothing on its right", previous().text), {});
    return 1;
  }

  Expr group() {
    const Level level(*this);
    if (level.isTooDeep()) return tooDeep();
    const Token& open = take();
    const Expr inner = formula();
    while (kind() == TokenKind::Comma) {
      strayComma();
      take();
      formula();
    }
    close(open);
    return inner;
  }

  void close(const Token& open) {
    if (kind() == TokenKind::Close) {
      take();
      return;
    }
    broken();
    report(open.where, fmt::format("this '{}' is never closed", open.text), "add the ')' that belongs to it");
  }

  void strayComma() { report(peek().where, "a comma that separates no arguments", decimalHint(next_)); }

  // What to say about a comma between digits; empty elsewhere.
  std::string decimalHint(std::size_t comma) const {
    if (comma == 0 || tokens_[comma].kind != TokenKind::Comma) return {};
    const Token &left = tokens_[comma - 1], &right = tokens_[comma + 1];
    const bool decimal = left.kind == TokenKind::Number && right.kind == TokenKind::Number &&
                         left.where.end + 1 == right.where.begin;
    return decimal ? fmt::format("decimals take a point: {}.{}", shortened(left.text), shortened(right.text))
                   : std::string();
  }

  Expr call() {
    const Level level(*this);
    if (level.isTooDeep()) return tooDeep();
    const std::size_t first = next_;
    const Token& name = take();
    const FormulaFunction* function = findFunction(name.text);
    if (!function) unknownFunction(name);
    const Token& open = take();
    std::vector<Expr> arguments;
    bool complete = true;
    if (kind() != TokenKind::Close && kind() != TokenKind::End) {
      do {
        if (!arguments.empty()) take();
        complete = complete && kind() != TokenKind::Comma && kind() != TokenKind::Close;
        arguments.push_back(formula());
      } while (kind() == TokenKind::Comma);
    }
    complete = complete && kind() == TokenKind::Close;
    close(open);
    if (!function || !complete) return broken();
    const std::size_t count = arguments.size();
    if (function->more ? count >= function->arguments : count == function->arguments)
      return function->build(arguments);
    wrongCount(*function, first, count);
    return broken();
  }

  void wrongCount(const FormulaFunction& function, std::size_t first, std::size_t count) {
    std::string hint = fmt::format("write {}", function.signature);
    if (function.name == "atan" && count == 2) hint = "the angle of a point is atan2(y, x)";
    if (function.name == "log" && count == 2) hint = "a logarithm to another base is log(x)/log(base)";
    for (std::size_t i = first; i < next_ && count > function.arguments; ++i)
      if (std::string decimal = decimalHint(i); !decimal.empty()) hint = std::move(decimal);
    report({tokens_[first].where.begin, previous().where.end},
           fmt::format("{} takes {}{} argument{}, not {}", function.name, function.more ? "at least " : "",
                       function.arguments, function.arguments == 1 ? "" : "s", count),
           std::move(hint));
  }

  Expr value() {
    const Token& name = take();
    if (const FormulaConstant* constant = findConstant(name.text)) return constant->value;
    if (const FormulaFunction* function = findFunction(name.text))
      return functionWithoutBrackets(*function, name);
    const FormulaNames::Entry* entry = names_.find(name.text);
    if (!entry || entry->meaning == FormulaNames::Meaning::Absent) {
      if (reported_.insert(name.text).second) unknownValue(name, entry);
      return broken();
    }
    if (entry->meaning == FormulaNames::Meaning::Value) return entry->value;
    return entry->progress == FormulaNames::Progress::Read && entry->formula.ok ? entry->formula.value
                                                                                : broken();
  }

  // "sin u", "sin^2(u)" and "sin^-1(u)" are how it is written on paper.
  Expr functionWithoutBrackets(const FormulaFunction& function, const Token& name) {
    const bool simple = function.arguments == 1;
    const bool beside = simple && (kind() == TokenKind::Name || kind() == TokenKind::Number);
    std::string hint = fmt::format("write {}", function.signature);
    if (simple && kind() == TokenKind::Power) {
      const std::string inverse = fmt::format("a{}", function.name);
      hint = tokens_[next_ + 1].kind == TokenKind::Minus && findFunction(inverse)
                 ? fmt::format("the inverse of {} is {}(x)", function.name, inverse)
                 : fmt::format("a power of {0} is {0}(x)^2", function.name);
    }
    if (beside) {
      const bool product = kind() == TokenKind::Number && tokens_[next_ + 1].kind == TokenKind::Name;
      hint = fmt::format("did you mean '{}({}{})'?", function.name, shortened(peek().text),
                         product ? shortened(tokens_[next_ + 1].text) : "");
    }
    report(name.where, fmt::format("the function '{}' needs brackets", name.text), std::move(hint));
    if (beside) power();
    if (!simple) giveUp();  // nobody knows how far its arguments reach
    return broken();
  }

  void unknownValue(const Token& name, const FormulaNames::Entry* absent) {
    const std::string shown = shortened(name.text);
    if (absent) return report(name.where, fmt::format("'{}' is not known here", shown), absent->text);
    report(name.where, fmt::format("unknown name '{}'", shown), hintForValue(name.text, names_.values()));
  }

  void unknownFunction(const Token& name) {
    broken();
    const FormulaNames::Entry* entry = names_.find(name.text);
    const bool value = findConstant(name.text) || (entry && entry->meaning != FormulaNames::Meaning::Absent);
    const std::string shown = shortened(name.text);
    if (value)
      return report(name.where, fmt::format("'{}' is a value, not a function", shown),
                    fmt::format("to multiply, write '{}*('", shown));
    report(name.where, fmt::format("unknown function '{}'", shown),
           hintForFunction(name.text, names_.values()));
  }

  std::string_view text_;
  const std::vector<Token>& tokens_;
  std::vector<Diagnostic> diagnostics_;
  const FormulaNames& names_;
  std::set<std::string_view> reported_;
  std::size_t next_ = 0;
  int depth_ = 0;
  bool broken_ = false;
  bool gaveUp_ = false;
};

}  // namespace

Formula readFormula(std::string_view text, const std::vector<Token>& tokens,
                    std::vector<Diagnostic> diagnostics, const FormulaNames& names) {
  return Parser(text, tokens, std::move(diagnostics), names).run();
}

}  // namespace luxo
