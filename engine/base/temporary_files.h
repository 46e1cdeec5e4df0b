// SPDX-License-Identifier: Apache-2.0
// Names under which files are being written, for a process that has to end at once.
#pragma once

#include <string>

namespace luxo {

/// A file that goes when the process is interrupted; nothing else happens to it. Of more than 64 at a time,
/// or names longer than 4,095 bytes, nobody knows. Safe from any thread. Does not throw.
class TemporaryName {
 public:
  explicit TemporaryName(const std::string& path) noexcept;
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

 private:
  int place_ = -1;
};

/// Removes them all. Safe in a signal's handler, and only to be followed by the end of the process.
void removeTemporaryFiles() noexcept;

}  // namespace luxo
