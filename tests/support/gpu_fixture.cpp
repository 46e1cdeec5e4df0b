// SPDX-License-Identifier: Apache-2.0
#include "support/gpu_fixture.h"

#include "base/error.h"

#include <cstdlib>
#include <string_view>

#if defined(__SANITIZE_ADDRESS__)
// Drivers and layers leak on their own account. The leak checker can only be told to ignore them by name
// while they are loaded, so they are kept loaded until it has run. What luxo leaks on the device the layer
// itself reports.
extern "C" int dlclose(void*) noexcept { return 0; }
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libVkLayer\nleak:libvulkan_\nleak:libLLVM\n";
}
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

namespace luxo::test {
namespace {

bool deviceRequired() {
  const char* value = std::getenv("LUXO_REQUIRE_GPU");
  return value != nullptr && std::string_view(value) == "1";
}

}  // namespace

void GpuTest::SetUp() {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // drivers run threads, which a mere fork would lose
  gpu::ContextDesc desc = contextDesc();
  desc.validation = true;
  desc.validationLog = log_;
  try {
    context_ = std::make_unique<gpu::Context>(desc);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Device || deviceRequired()) throw;
    GTEST_SKIP() << error.what() << "\n" << error.hint();
  }
}

void GpuTest::TearDown() {
  context_.reset();
  for (const std::string& message : log_->messages()) ADD_FAILURE() << message;
}

ScopedVariable::ScopedVariable(const char* name, const char* value) : name_(name) {
  const char* before = std::getenv(name);
  wasSet_ = before != nullptr;
  if (wasSet_) before_ = before;
  set(value);
}

ScopedVariable::~ScopedVariable() { set(wasSet_ ? before_.c_str() : nullptr); }

void ScopedVariable::set(const char* value) {
  if (value != nullptr) {
    setenv(name_.c_str(), value, 1);
  } else {
    unsetenv(name_.c_str());
  }
}

}  // namespace luxo::test
