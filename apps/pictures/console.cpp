// SPDX-License-Identifier: Apache-2.0
#include "console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/log.h"

namespace luxo {
namespace {

constexpr const char* kRed = "\x1b[1;31m";
constexpr const char* kGreen = "\x1b[1;32m";
constexpr const char* kYellow = "\x1b[1;33m";
constexpr const char* kPlain = "\x1b[0m";

std::string labelled(const char* label, const char* colour, const std::string& text, bool coloured) {
  return coloured ? fmt::format("{}{}:{} {}\n", colour, label, kPlain, text)
                  : fmt::format("{}: {}\n", label, text);
}

// One call per message, so that lines of several threads or processes do not mix.
void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace

Verbosity verbosityOf(bool quiet, bool verbose) {
  if (quiet && verbose) throw Error(ErrorKind::Usage, "-q and -v contradict each other", "keep one of them");
  return quiet ? Verbosity::Quiet : verbose ? Verbosity::Verbose : Verbosity::Normal;
}

bool colouredConsole() {
  const char* refused = std::getenv("NO_COLOR");
  return isatty(STDERR_FILENO) == 1 && (refused == nullptr || *refused == '\0');
}

std::string errorText(const Error& error, bool coloured) {
  std::string text = labelled("error", kRed, error.what(), coloured);
  if (!error.hint().empty()) text += labelled("help", kGreen, error.hint(), coloured);
  return text;
}

void printData(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw Error(ErrorKind::Write, fmt::format("cannot write to standard output: {}", std::strerror(errno)));
}

void printError(const Error& error) { print(errorText(error, colouredConsole())); }

void printNote(const std::string& message) { print(message + "\n"); }

void printWarning(const std::string& message) {
  print(labelled("warning", kYellow, message, colouredConsole()));
}

void showLog(Verbosity verbosity) {
  if (verbosity == Verbosity::Quiet) return setLogSink({});
  setLogSink([verbosity](LogLevel level, const std::string& message) {
    if (level == LogLevel::Warning) return printWarning(message);
    if (level == LogLevel::Info || verbosity == Verbosity::Verbose) print(message + "\n");
  });
}

}  // namespace luxo
