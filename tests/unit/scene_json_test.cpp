// SPDX-License-Identifier: Apache-2.0
// JSON: values and their places, every kind of mistake with its line and column, limits.
#include "scene/json.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "scene/json_writer.h"

namespace luxo {
namespace {

JsonDocument read(std::string text) {
  return JsonDocument(std::make_shared<const std::string>(std::move(text)));
}

/// Of a text that is one value.
JsonValue only(const JsonDocument& document) {
  EXPECT_TRUE(document.complete());
  EXPECT_TRUE(document.diagnostics().empty());
  return document.root();
}

std::string textAt(const JsonDocument& document, SourceRange where) {
  return document.text().substr(where.begin, where.end - where.begin);
}

TEST(Json, HoldsWhatIsWritten) {
  const JsonDocument document = read(R"({ "a": [1, -2.5e3, true, false, null], // a comment
      "b\n": { }, "": "x" })");
  const JsonValue root = only(document);
  ASSERT_EQ(root.kind(), JsonKind::Object);
  ASSERT_EQ(root.size(), 3u);

  const JsonValue a = root.first();
  EXPECT_EQ(a.key(), "a");
  EXPECT_EQ(textAt(document, a.keyWhere()), "\"a\"");
  EXPECT_EQ(textAt(document, a.where()), "[1, -2.5e3, true, false, null]");
  ASSERT_EQ(a.size(), 5u);
  JsonValue element = a.first();
  EXPECT_EQ(element.number(), 1);
  element = element.next();
  EXPECT_EQ(element.number(), -2500);
  EXPECT_EQ(textAt(document, element.where()), "-2.5e3");
  element = element.next();
  EXPECT_EQ(element.kind(), JsonKind::True);
  element = element.next();
  EXPECT_EQ(element.kind(), JsonKind::False);
  element = element.next();
  EXPECT_EQ(element.kind(), JsonKind::Null);
  EXPECT_FALSE(element.next().exists());

  const JsonValue b = a.next();
  EXPECT_EQ(b.key(), "b\n");
  EXPECT_EQ(b.kind(), JsonKind::Object);
  EXPECT_FALSE(b.first().exists());
  const JsonValue empty = b.next();
  EXPECT_EQ(empty.key(), "");
  EXPECT_EQ(empty.string(), "x");
  EXPECT_FALSE(empty.next().exists());
}

TEST(Json, ResolvesEscapes) {
  const JsonDocument document =
      read(R"(["\"\\\/\b\f\n\r\t", "\u0041\u00e9\u20ac", "\ud83d\ude00", "\ud83d!", "a\u0000b"])");
  JsonValue element = only(document).first();
  EXPECT_EQ(element.string(), "\"\\/\b\f\n\r\t");
  element = element.next();
  EXPECT_EQ(element.string(), "A\u00e9\u20ac");
  element = element.next();
  EXPECT_EQ(element.string(), "\U0001F600");
  element = element.next();
  EXPECT_EQ(element.string(), "\uFFFD!");  // half a pair
  element = element.next();
  EXPECT_EQ(element.string(), std::string("a\0b", 3));
}

TEST(Json, NumbersAreTheNearestDoubles) {
  const JsonDocument document = read(
      "[0, -0, 0.1, 1e308, 1.7976931348623157e308, 4.9e-324, 1e-400, 123456789012345678901234567890,"
      " 0.000000000000000000000000000000000001e36]");
  std::vector<double> numbers;
  for (JsonValue e = only(document).first(); e.exists(); e = e.next()) numbers.push_back(e.number());
  const std::vector<double> expected = {0,
                                        -0.0,
                                        0.1,
                                        1e308,
                                        std::numeric_limits<double>::max(),
                                        std::numeric_limits<double>::denorm_min(),
                                        0,  // too small for any other
                                        123456789012345678901234567890.0,
                                        1};
  EXPECT_EQ(numbers, expected);
  EXPECT_TRUE(std::signbit(numbers[1]));
}

TEST(Json, SkipsAByteOrderMarkAndComments) {
  const JsonDocument document = read("\xEF\xBB\xBF// first\n\t[1, // one\r\n2]// last");
  EXPECT_EQ(only(document).size(), 2u);
}

struct Slip {
  const char* text;
  std::size_t line, column;
  const char* message;
  bool complete;  ///< the reading goes on behind it
};

TEST(Json, PointsAtEveryMistake) {
  const std::vector<Slip> slips = {
      {"", 1, 1, "the file is empty", false},
      {" \n ", 1, 1, "the file is empty", false},
      {"// nothing", 1, 11, "expected a value, but the file ends here", false},
      {"[1,\n 2,\n]", 2, 3, "a comma after the last value", true},
      {"{\"a\": 1,}", 1, 8, "a comma after the last value", true},
      {"[1,, 2]", 1, 4, "one comma too many", true},
      {"[1 2]", 1, 3, "a comma is missing between this and what comes before", true},
      {"{\"a\": 1\n \"b\": 2}", 1, 8, "a comma is missing between this and what comes before", true},
      {"{'a': 1}", 1, 2, "texts are written in double quotes", true},
      {"{a: 1}", 1, 2, "names are written in double quotes", true},
      {"{\"a\" = 1}", 1, 6, "expected ':', found '='", true},
      {"{\"a\" 1}", 1, 6, "expected ':', found '1'", false},
      {"{\"a\": sin(t), \"b\": 1}", 1, 7, "a text without quotes", true},
      {"[2*t]", 1, 3, "expected ',' or ']', found '*'", false},
      {"[2t]", 1, 3, "expected ',' or ']', found 't'", false},
      {"[NaN]", 1, 2, "NaN is not a number here", true},
      {"[True]", 1, 2, "unknown word", true},
      {"[1] 2", 1, 5, "expected the end of the file, found '2'", false},
      {"[1e999]", 1, 2, "this number is too large", true},
      {"[-1e99999999999999999999]", 1, 2, "this number is too large", true},
      {"[+1]", 1, 2, "a number does not start with '+'", true},
      {"[.5]", 1, 2, "a digit is missing before the point", true},
      {"[5.]", 1, 2, "a digit is missing after the point", true},
      {"[-]", 1, 3, "expected a digit, found ']'", false},
      {"[1e]", 1, 3, "expected ',' or the end of the number, found 'e'", false},
      {"[007]", 1, 2, "a number does not start with extra zeros", true},
      {"[\"a\nb\"]", 1, 2, "this text has no closing quote", false},
      {"[\"a", 1, 2, "this text has no closing quote", false},
      {"[\"a\tb\"]", 1, 4, "the byte 0x09 inside a text", true},
      {"[\"\\alpha\"]", 1, 3, "a '\\' in a text must be written twice", true},
      {"[\"\\u12\"]", 1, 3, "four hexadecimal digits must follow \\u", true},
      {"[1 /* two */]", 1, 4, "comments between /* and */ are not read", true},
      {"[1 # one\n]", 1, 4, "a comment does not start with '#'", true},
      {"[\xE2\x80\x9C"
       "a]",
       1, 2, "expected a value, found '\u201C'", false},
      {"[\"\xE9\"]", 1, 3, "the byte 0xE9 is not UTF-8", false},
      {"[\"\xC0\x80\"]", 1, 3, "the byte 0xC0 is not UTF-8", false},          // too long a form
      {"[\"\xED\xA0\x80\"]", 1, 3, "the byte 0xED is not UTF-8", false},      // half a pair
      {"[\"\xF4\x90\x80\x80\"]", 1, 3, "the byte 0xF4 is not UTF-8", false},  // beyond Unicode
      {"[\"\xE2\x82", 1, 3, "the byte 0xE2 is not UTF-8", false},             // cut off
      {"\xFF\xFE[\0", 1, 1, "the file is UTF-16", false},
      {"{\"a\": [1, 2}", 1, 12, "expected ',' or ']', found '}'", false},
      {"{\"a\": [1", 1, 9, "expected ',' or ']', but the file ends here", false},
      {"{\"k\": 1, \"l\": 2,\n \"k\": 3}", 2, 2, "the name \"k\" is given twice", true},
      {"{\"k\": 1, \"\\u006b\": 2}", 1, 10, "the name \"k\" is given twice", true},
  };
  for (const Slip& slip : slips) {
    const JsonDocument document = read(slip.text);
    ASSERT_EQ(document.diagnostics().size(), 1u) << slip.text;
    const Diagnostic& found = document.diagnostics()[0];
    EXPECT_EQ(found.message, slip.message) << slip.text;
    EXPECT_EQ(positionAt(document.text(), found.where.begin), (TextPosition{slip.line, slip.column}))
        << slip.text;
    EXPECT_EQ(document.complete(), slip.complete) << slip.text;
  }
}

TEST(Json, FindsSeveralSlipsAtOnce) {
  const JsonDocument document = read("{a: [1 2], 'b': .5,}");
  EXPECT_TRUE(document.complete());
  EXPECT_EQ(document.diagnostics().size(), 5u);
  EXPECT_EQ(document.root().size(), 2u);
  EXPECT_EQ(document.root().first().next().key(), "b");
}

TEST(Json, StopsAfterManyErrors) {
  const JsonDocument document = read(fmt::format("[{}]", std::string(100000, ',')));
  EXPECT_LE(document.diagnostics().size(), kMaxJsonErrors);
  EXPECT_FALSE(document.complete());
}

TEST(Json, FindsKeysGivenTwiceAmongMany) {
  std::string text = "{";
  for (int i = 0; i < 1000; ++i) text += fmt::format("\"k{}\": 0, ", i);
  const JsonDocument good = read(text + "\"k\": 0}"), bad = read(text + "\"k7\": 0}");
  EXPECT_TRUE(good.diagnostics().empty());
  ASSERT_EQ(bad.diagnostics().size(), 1u);
  EXPECT_EQ(bad.diagnostics()[0].message, "the name \"k7\" is given twice");
}

TEST(Json, NestsToItsLimitAndNoDeeper) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_TRUE(read(nested(kMaxJsonDepth)).complete());
  const JsonDocument deeper = read(nested(kMaxJsonDepth + 1));
  ASSERT_EQ(deeper.diagnostics().size(), 1u);
  EXPECT_EQ(deeper.diagnostics()[0].where.begin, kMaxJsonDepth);
  EXPECT_FALSE(read(std::string(1000000, '[')).complete());
}

TEST(Json, EveryTruncationIsAnError) {
  const std::string whole = R"({ "a": [1, -2.5e3, true, null, "\u00e9\n"], "b": { "c": "d" } } )";
  EXPECT_TRUE(read(whole).complete());
  for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
    const JsonDocument cut = read(whole.substr(0, size));
    EXPECT_FALSE(cut.complete()) << size;
    EXPECT_FALSE(cut.diagnostics().empty()) << size;
  }
}

TEST(Json, WritesWhatItReads) {
  JsonText object = JsonText::object(), array = JsonText::array();
  for (const double x : {0.1, -0.0, 1e300, 5e-324, 1.0 / 3, 123456789.0}) array.add(JsonText::number(x));
  object.add("numbers \"here\"", array);
  object.add("text", JsonText::string("\\\n\x01\u00e9"));
  object.add("yes", JsonText::boolean(true));
  object.add("nothing", JsonText::array());
  const JsonDocument document = read(object.text());
  JsonValue member = only(document).first();
  EXPECT_EQ(member.key(), "numbers \"here\"");
  std::vector<std::uint64_t> bits;
  for (JsonValue e = member.first(); e.exists(); e = e.next())
    bits.push_back(std::bit_cast<std::uint64_t>(e.number()));
  EXPECT_EQ(bits, (std::vector<std::uint64_t>{
                      std::bit_cast<std::uint64_t>(0.1), std::bit_cast<std::uint64_t>(-0.0),
                      std::bit_cast<std::uint64_t>(1e300), 1u, std::bit_cast<std::uint64_t>(1.0 / 3),
                      std::bit_cast<std::uint64_t>(123456789.0)}));
  member = member.next();
  EXPECT_EQ(member.string(), "\\\n\x01\u00e9");
}

TEST(Json, WritesShortThingsOnOneLine) {
  JsonText numbers = JsonText::array();
  for (int i = 0; i < 3; ++i) numbers.add(JsonText::number(i));
  JsonText object = JsonText::object();
  object.add("a", numbers);
  object.add("b", JsonText::object());
  EXPECT_EQ(object.text(), R"({ "a": [0, 1, 2], "b": {} })");
  object.add("long", JsonText::string(std::string(JsonText::kLineLength, 'x')));
  EXPECT_EQ(object.text(), "{\n  \"a\": [0, 1, 2],\n  \"b\": {},\n  \"long\": \"" +
                               std::string(JsonText::kLineLength, 'x') + "\"\n}");
}

TEST(Json, LinesEndWhereTheyShould) {
  // `[x, x, ...]` of exactly the line's length, but for the comma that might follow, stays on it.
  const std::size_t inside = JsonText::kLineLength - 1 - 2 - 2;  // brackets, quotes
  JsonText fits = JsonText::array(), wide = JsonText::array();
  fits.add(JsonText::string(std::string(inside, 'x')));
  wide.add(JsonText::string(std::string(inside + 1, 'x')));
  EXPECT_EQ(fits.text().find('\n'), std::string::npos);
  EXPECT_NE(wide.text().find('\n'), std::string::npos);
}

}  // namespace
}  // namespace luxo
