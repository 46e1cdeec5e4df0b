// SPDX-License-Identifier: Apache-2.0
#include "viewer/notices.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/log.h"

namespace luxo {
namespace {

constexpr std::chrono::seconds kMessage{4}, kAlert{12}, kLasting{3600};

}  // namespace

std::string inWords(const Error& error) {
  return error.what() + (error.hint().empty() ? "" : "\nhelp: " + error.hint());
}

void Notices::tell(const Message& message) {
  message_ = message;
  end_ = Clock::now() + (message.alert ? kAlert : kMessage);
  log(LogLevel::Debug, message.text);
}

void Notices::tellWhile(const Message& message) {
  message_ = message;
  end_ = Clock::now() + kLasting;
}

void Notices::expire(Clock::time_point now) {
  if (message_ && now >= end_) message_.reset();
}

std::optional<Notices::Clock::time_point> Notices::end() const {
  return message_ ? std::optional(end_) : std::nullopt;
}

void Notices::file(const std::string& problem) {
  problem_ = problem;
  neverRead_ = neverRead_ && !problem.empty();
  if (!problem_.empty()) log(LogLevel::Debug, problem_);
}

void Notices::addPanels(std::vector<window::Panel>& panels, const std::string& impossible,
                        const std::string& refused, PixelSize size, double contentScale) const {
  const std::pair<const char*, const std::string&> wrong[] = {
      {neverRead_ ? "The shader has errors. This is the scene without it."
                  : "The file has errors. This is the scene before them.",
       problem_},
      {"There is no picture of this moment.", impossible},
      {"This cannot be drawn. The picture is the one before.", refused},
      {"Shaders do what they must not.", faults_}};
  const auto* worst = std::ranges::find_if(wrong, [](const auto& what) { return !what.second.empty(); });
  if (worst != std::end(wrong)) panels.push_back(errorPanel(worst->first, worst->second, size, contentScale));
  if (message_) panels.push_back(messagePanel(*message_));
}

}  // namespace luxo
