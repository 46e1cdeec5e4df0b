// SPDX-License-Identifier: Apache-2.0
#include "support/gpu_fixture.h"

#include "base/error.h"

#include <cstdlib>
#include <string_view>

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

double GpuTest::tolerance(double onCpus, double onGpus) const {
  return context_->deviceInfo().type == gpu::DeviceType::Cpu ? onCpus : onGpus;
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
