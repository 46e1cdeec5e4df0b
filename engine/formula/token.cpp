// SPDX-License-Identifier: Apache-2.0
#include "formula/token.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <span>

#include "base/utf8.h"
#include "formula/parse.h"

namespace luxo {
namespace {

struct Operator {
  std::string_view text;
  TokenKind kind;
  std::string_view hint = {};  ///< given: an error, with what to write instead
};

// Longer ones first.
constexpr Operator kOperators[] = {
    {"<=", TokenKind::LessEqual},
    {">=", TokenKind::GreaterEqual},
    {"==", TokenKind::Equal},
    {"!=", TokenKind::NotEqual},
    {"**", TokenKind::Power, "powers are written with '^': u^2"},
    {"&&", TokenKind::Bad, "'and' is a product: (u < 1)*(v < 1)"},
    {"||", TokenKind::Bad, "'or' is a maximum: max(u < 1, v < 1)"},
    {"<>", TokenKind::NotEqual, "write '!='"},
    {"=<", TokenKind::LessEqual, "write '<='"},
    {"=>", TokenKind::GreaterEqual, "write '>='"},
    {"//", TokenKind::Bad, "the whole part of a division is floor(a/b)"},
    {":=", TokenKind::Bad, "a formula has a value only; name parts of it in 'let'"},
    {"+", TokenKind::Plus},
    {"-", TokenKind::Minus},
    {"*", TokenKind::Times},
    {"/", TokenKind::Divide},
    {"^", TokenKind::Power},
    {"(", TokenKind::Open},
    {")", TokenKind::Close},
    {",", TokenKind::Comma},
    {"<", TokenKind::Less},
    {">", TokenKind::Greater},
    {"=", TokenKind::Equal, "write only what stands on its right; a comparison is '=='"},
    {"[", TokenKind::Open, "brackets are round: ( )"},
    {"]", TokenKind::Close, "brackets are round: ( )"},
    {"{", TokenKind::Open, "brackets are round: ( )"},
    {"}", TokenKind::Close, "brackets are round: ( )"},
    {"%", TokenKind::Bad, "a remainder is mod(a, b), a percentage a division by 100"},
    {"&", TokenKind::Bad, "'and' is a product: (u < 1)*(v < 1)"},
    {"|", TokenKind::Bad, "an absolute value is abs(x)"},
    {"!", TokenKind::Bad, "'not' is a comparison with 0: (u < 1) == 0; there are no factorials"},
    {"?", TokenKind::Bad, "write if(condition, a, b)"},
    {":", TokenKind::Bad, "write if(condition, a, b)"},
    {";", TokenKind::Comma, "arguments are separated by ','"},
    {"\"", TokenKind::Bad, "a formula holds no quotes"},
    {"'", TokenKind::Bad, "a formula holds no quotes; derivatives are taken for you"},
    {"`", TokenKind::Bad, "a formula holds no quotes"},
    {"$", TokenKind::Bad, "names are written alone: k, not $k"},
};

struct Symbol {
  char32_t point;
  TokenKind kind;
  std::string_view text;  ///< what it is read as, and what to write
  double number = 0;
};

// What a text copied from elsewhere holds. Bad with text: advice only; Bad without: a space.
constexpr Symbol kSymbols[] = {
    {U'\u00d7', TokenKind::Times, "*"},
    {U'\u00b7', TokenKind::Times, "*"},
    {U'\u22c5', TokenKind::Times, "*"},
    {U'\u2219', TokenKind::Times, "*"},
    {U'\u2217', TokenKind::Times, "*"},
    {U'\u2022', TokenKind::Times, "*"},
    {U'\u00f7', TokenKind::Divide, "/"},
    {U'\u2215', TokenKind::Divide, "/"},
    {U'\u2044', TokenKind::Divide, "/"},
    {U'\u2212', TokenKind::Minus, "-"},
    {U'\u2010', TokenKind::Minus, "-"},
    {U'\u2011', TokenKind::Minus, "-"},
    {U'\u2012', TokenKind::Minus, "-"},
    {U'\u2013', TokenKind::Minus, "-"},
    {U'\u2014', TokenKind::Minus, "-"},
    {U'\u2264', TokenKind::LessEqual, "<="},
    {U'\u2265', TokenKind::GreaterEqual, ">="},
    {U'\u2260', TokenKind::NotEqual, "!="},
    {U'\u00b2', TokenKind::Power, "^2", 2},
    {U'\u00b3', TokenKind::Power, "^3", 3},
    {U'\u2074', TokenKind::Power, "^4", 4},
    {U'\u00bd', TokenKind::Number, "0.5", 0.5},
    {U'\u00bc', TokenKind::Number, "0.25", 0.25},
    {U'\u00be', TokenKind::Number, "0.75", 0.75},
    {U'\u03c0', TokenKind::Name, "pi"},
    {U'\u03c4', TokenKind::Name, "tau"},
    {U'\u00b0', TokenKind::Name, "deg"},
    {U'\u221a', TokenKind::Name, "sqrt"},
    {U'\u221e', TokenKind::Bad, "a large number: formulas know no infinity"},
    {U'\u201c', TokenKind::Bad, "the formula without quotes"},
    {U'\u201d', TokenKind::Bad, "the formula without quotes"},
    {U'\u201e', TokenKind::Bad, "the formula without quotes"},
    {U'\u2018', TokenKind::Bad, "the formula without quotes"},
    {U'\u2019', TokenKind::Bad, "the formula without quotes"},
    {U'\u2032', TokenKind::Bad, "the formula alone: derivatives are taken for you"},
    {U'\u00a0', TokenKind::Bad, ""},
    {U'\u2007', TokenKind::Bad, ""},
    {U'\u2009', TokenKind::Bad, ""},
    {U'\u202f', TokenKind::Bad, ""},
    {U'\u200b', TokenKind::Bad, ""},
    {U'\u2062', TokenKind::Bad, ""},
    {U'\u3000', TokenKind::Bad, ""},
    {U'\ufeff', TokenKind::Bad, ""},
};

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

class Tokenizer {
 public:
  Tokenizer(std::string_view text, std::vector<Diagnostic>& diagnostics)
      : text_(text), diagnostics_(diagnostics) {}

  std::vector<Token> run() {
    while (at_ < text_.size() && diagnostics_.size() < kMaxFormulaErrors) {
      const char c = text_[at_];
      if (isSpace(c))
        ++at_;
      else if (isDigit(c) || c == '.')
        number();
      else if (isLetter(c))
        name();
      else if (c == '\\')
        latex();
      else if (static_cast<unsigned char>(c) >= 0x80)
        symbol();
      else
        operation();
    }
    if (at_ < text_.size()) add(TokenKind::Bad, text_.size() - at_);  // too many errors: the rest is not read
    add(TokenKind::End, 0);
    return std::move(tokens_);
  }

 private:
  void add(TokenKind kind, std::size_t bytes, double number = 0) {
    tokens_.push_back({kind, {at_, at_ + bytes}, text_.substr(at_, bytes), number});
    at_ += bytes;
  }

  void report(std::size_t bytes, std::string message, std::string hint) {
    diagnostics_.push_back({{at_, at_ + bytes}, std::move(message), std::move(hint)});
  }

  // A pair of quotes, a pair of wrong brackets: one advice for both.
  void reportOnce(std::size_t bytes, std::string message, std::string_view hint) {
    const auto says = [&](const Diagnostic& d) { return d.hint == hint; };
    if (hint.empty() || std::none_of(diagnostics_.begin(), diagnostics_.end(), says))
      report(bytes, std::move(message), std::string(hint));
  }

  std::size_t digitsFrom(std::size_t begin) const {
    std::size_t end = begin;
    while (end < text_.size() && isDigit(text_[end])) ++end;
    return end;
  }

  bool hasDigit(std::size_t at) const { return at < text_.size() && isDigit(text_[at]); }

  void number() {
    std::size_t end = digitsFrom(at_);
    if (end < text_.size() && text_[end] == '.') end = digitsFrom(end + 1);
    if (end == at_ + 1 && text_[at_] == '.') {
      report(1, "a '.' without a number", "a number has at least one digit: 0.5");
      return add(TokenKind::Bad, 1);
    }
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      const bool sign = end + 1 < text_.size() && (text_[end + 1] == '+' || text_[end + 1] == '-');
      if (const std::size_t digits = end + (sign ? 2 : 1); hasDigit(digits)) end = digitsFrom(digits);
    }
    const std::size_t whole = end;
    while (end < text_.size() && text_[end] == '.') end = digitsFrom(end + 1);
    double value = 0;
    if (end != whole) {
      report(end - at_,
             fmt::format("'{}' has more than one decimal point", shortened(text_.substr(at_, end - at_))),
             {});
    } else if (std::from_chars(text_.data() + at_, text_.data() + end, value).ec != std::errc()) {
      report(end - at_, fmt::format("the number {} is out of range", shortened(text_.substr(at_, end - at_))),
             "numbers reach from 4.9e-324 to 1.8e308");
      value = 1;
    }
    add(TokenKind::Number, end - at_, value);
  }

  void name() {
    std::size_t end = at_;
    while (end < text_.size() && (isLetter(text_[end]) || isDigit(text_[end]))) ++end;
    if (end + 1 < text_.size() && text_[end] == '.' && isLetter(text_[end + 1])) return prefix(end);
    add(TokenKind::Name, end - at_);
  }

  // "math.sin": read as "sin".
  void prefix(std::size_t dot) {
    const std::string_view left = text_.substr(at_, dot - at_);
    std::size_t end = dot + 1;
    while (end < text_.size() && (isLetter(text_[end]) || isDigit(text_[end]))) ++end;
    const std::string right = shortened(text_.substr(dot + 1, end - dot - 1));
    report(dot + 1 - at_, "a '.' inside a name",
           fmt::format("write '{}' alone, or '{}*{}' for a product", right, shortened(left), right));
    at_ = dot + 1;
  }

  // Whatever follows is LaTeX as well: one error says it all.
  void latex() {
    std::size_t end = at_ + 1;
    while (end < text_.size() && isLetter(text_[end])) ++end;
    report(end - at_,
           fmt::format("'{}' is LaTeX, which is not read", shortened(text_.substr(at_, end - at_))),
           "write a/b, sqrt(a), sin(a), pi");
    add(TokenKind::Bad, text_.size() - at_);
  }

  void operation() {
    for (const Operator& known : kOperators) {
      if (!text_.substr(at_).starts_with(known.text)) continue;
      if (!known.hint.empty())
        reportOnce(known.text.size(), fmt::format("unexpected '{}'", known.text), known.hint);
      return add(known.kind, known.text.size());
    }
    const unsigned char c = static_cast<unsigned char>(text_[at_]);
    report(1,
           c > 0x20 && c < 0x7f ? fmt::format("unexpected '{}'", char(c))
                                : fmt::format("unexpected control character (code {})", int(c)),
           {});
    add(TokenKind::Bad, 1);
  }

  void symbol() {
    const Utf8Character c = decodeUtf8(text_, at_);
    const std::string_view bytes = text_.substr(at_, c.bytes);
    if (!c.valid) {
      reportOnce(1,
                 fmt::format("the byte 0x{:02x} is not text (UTF-8)", static_cast<unsigned char>(bytes[0])),
                 "save the file as UTF-8");
      return add(TokenKind::Bad, 1);
    }
    for (const Symbol& known : kSymbols)
      if (known.point == c.point) return symbol(known, bytes);
    report(c.bytes,
           fmt::format("unexpected character '{}' (U+{:04X})", bytes, static_cast<std::uint32_t>(c.point)),
           "names and operators are written in ASCII");
    add(TokenKind::Bad, c.bytes);
  }

  void symbol(const Symbol& known, std::string_view bytes) {
    if (known.text.empty()) {
      reportOnce(bytes.size(),
                 fmt::format("an invisible character that is no space (U+{:04X})",
                             static_cast<std::uint32_t>(known.point)),
                 "delete it, or write a plain space");
      at_ += bytes.size();
      return;
    }
    const bool literal = known.kind != TokenKind::Bad;
    const std::string message = fmt::format("unexpected '{}'", bytes);
    if (literal)
      report(bytes.size(), message, fmt::format("write '{}'", known.text));
    else
      reportOnce(bytes.size(), message, fmt::format("write {}", known.text));
    add(known.kind, bytes.size(), known.number);
    if (known.kind == TokenKind::Name) tokens_.back().text = known.text;
    if (known.kind == TokenKind::Power)
      tokens_.push_back({TokenKind::Number, tokens_.back().where, bytes, known.number});
  }

  std::string_view text_;
  std::vector<Diagnostic>& diagnostics_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<Token> tokenize(std::string_view text, std::vector<Diagnostic>& diagnostics) {
  if (text.size() <= kMaxFormulaBytes) return Tokenizer(text, diagnostics).run();
  diagnostics.push_back(
      {{0, text.size()},
       fmt::format("a formula of {} bytes; at most {} are read", text.size(), kMaxFormulaBytes),
       "name parts of it in 'let'"});
  return {{.kind = TokenKind::Bad}, {.kind = TokenKind::End}};
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  if (text.size() <= kLongest) return std::string(text);
  std::size_t end = kLongest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace luxo
