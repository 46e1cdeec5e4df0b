// SPDX-License-Identifier: Apache-2.0
// What the validation layer said. Outlives the context, since leaks are only reported as the device goes.
#pragma once

#include "gpu/vk.h"

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace luxo::gpu {

/// Counts warnings and errors and keeps the first texts. Safe from any thread: layers report where they like.
class ValidationLog {
 public:
  static constexpr std::size_t kKept = 20;

  void add(std::string_view text);
  [[nodiscard]] std::uint64_t count() const;
  /// The first kKept texts, in order.
  [[nodiscard]] std::vector<std::string> messages() const;

 private:
  mutable std::mutex mutex_;
  std::uint64_t count_ = 0;
  std::vector<std::string> messages_;
};

/// Reports warnings and errors of type validation and performance (the loader's own chatter is of type
/// general) to `log`, which must live as long as the messenger.
[[nodiscard]] VkDebugUtilsMessengerCreateInfoEXT messengerInfo(ValidationLog& log);

}  // namespace luxo::gpu
