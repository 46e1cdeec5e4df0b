// SPDX-License-Identifier: Apache-2.0
// The world's failures: a missing device, a bad scene, a full disk. Thrown once, never also logged.
// Programmer mistakes assert (base/assert.h); expected outcomes are return values.
#pragma once

#include <stdexcept>
#include <string>

namespace luxo {

/// Whose problem it is; an application turns it into its exit code.
enum class ErrorKind {
  Internal,     ///< luxo itself failed; please report it
  Usage,        ///< an argument or option is wrong
  Scene,        ///< a scene, formula, model or shader is wrong or not supported yet
  Device,       ///< no usable Vulkan device
  Write,        ///< an output cannot be written
  Requirement,  ///< the result is fine but misses what was asked of it
  Retry,        ///< out of memory, device lost: the same call may work later
};

/// what() = what was attempted, with which values, and what the system said; hint() = what to try, or empty.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message, std::string hint = {})
      : std::runtime_error(message), kind_(kind), hint_(std::move(hint)) {}

  [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }
  [[nodiscard]] const std::string& hint() const noexcept { return hint_; }

 private:
  ErrorKind kind_;
  std::string hint_;
};

}  // namespace luxo
