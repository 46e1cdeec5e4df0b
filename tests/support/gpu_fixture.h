// SPDX-License-Identifier: Apache-2.0
// A Vulkan device for a test, watched by the validation layer.
#pragma once

#include "gpu/context.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace luxo::test {

/// Gives every test a context with validation and synchronization validation; any message, leaks found at its
/// end included, fails the test. Without a device the test is skipped, or fails when LUXO_REQUIRE_GPU=1. What
/// a test makes from the context must be gone before TearDown(): keep it in the test's body.
class GpuTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// What the context is made from; validation is added.
  [[nodiscard]] virtual gpu::ContextDesc contextDesc() const { return {}; }

  [[nodiscard]] gpu::Context& context() { return *context_; }

  /// Of two tolerances that of this device. CPU devices interpolate between a triangle's corners as they are
  /// and filter textures by floats; GPUs round corners to 1/256 of a pixel and weights to 8 bits. (Those on
  /// GPUs are twice what an H100 was off by.)
  [[nodiscard]] double tolerance(double onCpus, double onGpus) const;

 private:
  std::shared_ptr<gpu::ValidationLog> log_ = std::make_shared<gpu::ValidationLog>();
  std::unique_ptr<gpu::Context> context_;
};

/// Sets an environment variable, or removes it when null, until it goes out of scope.
class ScopedVariable {
 public:
  ScopedVariable(const char* name, const char* value);
  ~ScopedVariable();
  ScopedVariable(const ScopedVariable&) = delete;
  ScopedVariable& operator=(const ScopedVariable&) = delete;

 private:
  void set(const char* value);

  std::string name_;
  std::string before_;
  bool wasSet_;
};

}  // namespace luxo::test
