// SPDX-License-Identifier: Apache-2.0
// The two streams: data on stdout, everything people read on stderr.
#pragma once

#include <string>

#include "base/error.h"

namespace luxo {

enum class Verbosity { Quiet, Normal, Verbose };

/// Of -q and -v. Error(Usage): both.
[[nodiscard]] Verbosity verbosityOf(bool quiet, bool verbose);

/// Whether stderr takes colour: it is a terminal and NO_COLOR is not set (no-color.org).
[[nodiscard]] bool colouredConsole();

/// "error: what" and, when there is one, "help: hint"; the first word red and green where `coloured`.
[[nodiscard]] std::string errorText(const Error& error, bool coloured);

/// Writes to stdout. Error(Write) when it is closed or full.
void printData(const std::string& text);

void printError(const Error& error);
void printNote(const std::string& message);
/// "warning: message"
void printWarning(const std::string& message);

/// Shows what the library logs: warnings always unless Quiet, information unless Quiet, details when Verbose.
void showLog(Verbosity verbosity);

}  // namespace luxo
