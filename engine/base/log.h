// SPDX-License-Identifier: Apache-2.0
// Messages for people. The library never prints by itself: an application installs a sink, or nothing is
// shown.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>

namespace luxo {

enum class LogLevel { Debug, Info, Warning };

using LogSink = std::function<void(LogLevel, const std::string&)>;

/// Replaces the process's sink (empty = silence). Not meant to be called while other threads log.
void setLogSink(LogSink sink);

/// Hands one message to the sink. Safe from any thread.
void log(LogLevel level, const std::string& message);

}  // namespace luxo
