// SPDX-License-Identifier: Apache-2.0
#include "exit_code.h"

#include <fmt/format.h>

#include <new>
#include <system_error>

#include "console.h"
#include "interruption.h"

namespace luxo {

int exitCodeOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Internal:
      return exit_code::kInternal;
    case ErrorKind::Usage:
      return exit_code::kUsage;
    case ErrorKind::Scene:
      return exit_code::kScene;
    case ErrorKind::Device:
      return exit_code::kDevice;
    case ErrorKind::Write:
      return exit_code::kWrite;
    case ErrorKind::Requirement:
      return exit_code::kRequirement;
    case ErrorKind::Retry:
      return exit_code::kRetry;
  }
  return exit_code::kInternal;
}

int runToExitCode(const std::function<int()>& body) {
  const auto report = [](const Error& error) {
    if (const int signal = interruptingSignal(); signal != 0 && error.kind() == ErrorKind::Retry)
      return exit_code::kSignal + signal;
    printError(error);
    return exitCodeOf(error.kind());
  };
  try {
    return body();
  } catch (const Error& error) {
    return report(error);
  } catch (const std::bad_alloc&) {
    return report(
        {ErrorKind::Retry, "out of memory", "ask for a smaller size, or try again when more is free"});
  } catch (const std::system_error& error) {
    // Threads are what asks the system without asking for its answer.
    return report({ErrorKind::Retry, fmt::format("the system refused: {}", error.what()),
                   "allow more processes (ulimit -u) or memory (ulimit -v), or try again when more is free"});
  } catch (const std::exception& error) {
    return report(
        {ErrorKind::Internal, error.what(), "this is a bug in luxo; please report it with the command"});
  }
}

}  // namespace luxo
