// SPDX-License-Identifier: Apache-2.0
#include "exit_code.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "console.h"
#include "gpu/address_space.h"
#include "interruption.h"

namespace luxo {
namespace {

constexpr const char* kOutOfMemory = "out of memory";
constexpr const char* kFreeMemory = "ask for a smaller size, or try again when more is free";

std::terminate_handler usualEnd = nullptr;

/// There is no memory to make a text.
[[noreturn]] void endOutOfMemory() {
  for (const std::string_view part : {"error: ", kOutOfMemory, "\nhelp: ", kFreeMemory, "\n"})
    static_cast<void>(write(STDERR_FILENO, part.data(), part.size()) < 0);
  std::_Exit(exit_code::kRetry);
}

/// Where nothing catches: in threads of a driver, and of the compiler in it.
[[noreturn]] void endUncaught() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    endOutOfMemory();
  } catch (...) {
  }
  usualEnd();
  std::abort();
}

/// That compiler, LLVM, throws nothing where it has no memory, but says so and aborts. It is known by what a
/// limit leaves: less than all that the driver takes.
extern "C" void endAborted(int) {
  if (gpu::addressSpaceLeft() < gpu::kDriverBytes) endOutOfMemory();
}

}  // namespace

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
  if (std::get_terminate() != endUncaught) usualEnd = std::set_terminate(endUncaught);
  std::signal(SIGABRT, endAborted);
  try {
    return body();
  } catch (const Error& error) {
    return report(error);
  } catch (const std::bad_alloc&) {
    return report({ErrorKind::Retry, kOutOfMemory, kFreeMemory});
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
