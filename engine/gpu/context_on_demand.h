// SPDX-License-Identifier: Apache-2.0
// A device for what may never need one.
#pragma once

#include <memory>
#include <utility>

#include "gpu/context.h"

namespace luxo::gpu {

class ContextOnDemand {
 public:
  /// One of its own, opened when it is first asked for.
  explicit ContextOnDemand(ContextDesc desc) : desc_(std::move(desc)) {}
  /// The caller's, which must outlive it.
  explicit ContextOnDemand(Context& context) : context_(&context) {}

  /// The same each time. Error(Device) where there is none.
  [[nodiscard]] Context& get() {
    if (!context_) {
      owned_ = std::make_unique<Context>(desc_);
      context_ = owned_.get();
    }
    return *context_;
  }

 private:
  ContextDesc desc_;
  std::unique_ptr<Context> owned_;
  Context* context_ = nullptr;
};

}  // namespace luxo::gpu
