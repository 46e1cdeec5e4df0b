// SPDX-License-Identifier: Apache-2.0
// Assertions for programmer mistakes: they print the expression and both operands, then abort.
// On in builds without NDEBUG; LUXO_REQUIRE* stays on in every build and guards public boundaries.
#pragma once

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <string>

namespace luxo::detail {

[[noreturn]] void assertionFailed(const char* file, int line, const char* expression,
                                  const std::string& values);

template <class A, class B>
[[noreturn]] void comparisonFailed(const char* file, int line, const char* expression, const A& a,
                                   const B& b) {
  assertionFailed(file, line, expression, fmt::format("{} versus {}", a, b));
}

}  // namespace luxo::detail

#define LUXO_REQUIRE(expression) \
  ((expression) ? void() : ::luxo::detail::assertionFailed(__FILE__, __LINE__, #expression, {}))

#define LUXO_REQUIRE_COMPARE(a, op, b)                                                       \
  do {                                                                                       \
    const auto& luxoA = (a);                                                                 \
    const auto& luxoB = (b);                                                                 \
    if (!(luxoA op luxoB))                                                                   \
      ::luxo::detail::comparisonFailed(__FILE__, __LINE__, #a " " #op " " #b, luxoA, luxoB); \
  } while (false)

#ifdef NDEBUG
#define LUXO_ASSERT(expression) void()
#define LUXO_ASSERT_COMPARE(a, op, b) void()
#else
#define LUXO_ASSERT(expression) LUXO_REQUIRE(expression)
#define LUXO_ASSERT_COMPARE(a, op, b) LUXO_REQUIRE_COMPARE(a, op, b)
#endif
