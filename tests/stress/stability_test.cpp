// SPDX-License-Identifier: Apache-2.0
// The stability suite as tests: every case passes, but for the misses that are known, and every canary fails,
// watched by the validation layer.
// Pictures are smaller than those of `luxo verify --stability`, the thresholds the same.
#include "stability/stability.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"
#include "stability/known_misses.h"

namespace luxo {

void PrintTo(const StressCase& one, std::ostream* out) { *out << one.title; }

namespace {

bool deviceRequired() {
  const char* value = std::getenv("LUXO_REQUIRE_GPU");
  return value != nullptr && std::string_view(value) == "1";
}

class Stress : public ::testing::TestWithParam<StressCase> {
 protected:
  void TearDown() override {
    context_.reset();
    for (const std::string& message : log_->messages()) ADD_FAILURE() << message;
  }

  /// Nothing, and the test is skipped, where there is no device.
  std::optional<std::vector<Measurement>> measure(const StressRun& run) {
    try {
      return run(*context_);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Device || deviceRequired()) throw;
      [&] { GTEST_SKIP() << error.what() << "\n" << error.hint(); }();
      return std::nullopt;
    }
  }

  static void print(const Measurement& one) {
    fmt::print("  {:<60} {:>12.5g} {} {:.6g} {}\n", one.what, one.measured,
               one.bound == Measurement::Bound::AtMost ? "<=" : ">=", one.threshold, one.unit);
  }

 private:
  std::shared_ptr<gpu::ValidationLog> log_ = std::make_shared<gpu::ValidationLog>();
  std::optional<StressContext> context_{
      StressContext({.quick = true, .validate = true, .program = LUXO_PROGRAM, .validationLog = log_})};
};

TEST_P(Stress, Passes) {
  const auto measured = measure(GetParam().run);
  if (!measured) return;
  EXPECT_FALSE(measured->empty());
  for (const Measurement& one : *measured) {
    print(one);
    if (const auto reason = reasonForMiss(GetParam().id, one.what); reason && !one.passed()) {
      fmt::print("    known: {}\n", *reason);
      continue;
    }
    EXPECT_TRUE(one.passed()) << one.what << ": " << one.measured << " " << one.unit << ", threshold "
                              << one.threshold;
  }
}

class Canary : public Stress {};

TEST_P(Canary, Fails) {
  const auto measured = measure(GetParam().canary);
  if (!measured) return;
  bool allPassed = true;
  for (const Measurement& one : *measured) {
    print(one);
    allPassed = allPassed && one.passed();
  }
  EXPECT_FALSE(allPassed) << "the naive way passes: the test cannot tell";
}

std::vector<StressCase> withCanary() {
  std::vector<StressCase> cases;
  for (const StressCase& one : stressCases())
    if (one.canary) cases.push_back(one);
  return cases;
}

std::string nameOfCase(const ::testing::TestParamInfo<StressCase>& info) {
  std::string name(info.param.id);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Stability, Stress, ::testing::ValuesIn(stressCases().begin(), stressCases().end()),
                         nameOfCase);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Canary);
INSTANTIATE_TEST_SUITE_P(Stability, Canary, ::testing::ValuesIn(withCanary()), nameOfCase);

}  // namespace
}  // namespace luxo
