// SPDX-License-Identifier: Apache-2.0
// What every refusal promises.
#pragma once

#include <optional>
#include <string>

#include "base/assert.h"
#include "base/error.h"
#include "base/utf8.h"

namespace luxo {

/// What is wrong with a scene or a model is said in words that a terminal can show.
inline void checkMessage(const Error& error) {
  LUXO_REQUIRE(error.kind() == ErrorKind::Scene);
  const std::string message = error.what();
  LUXO_REQUIRE(!message.empty());
  LUXO_REQUIRE_COMPARE(message.size(), <, 64u * 1024);
  for (std::size_t i = 0; i < message.size(); i += decodeUtf8(message, i).bytes) {
    const Utf8Character c = decodeUtf8(message, i);
    LUXO_REQUIRE(c.valid);
    LUXO_REQUIRE(c.point >= 0x20 || c.point == '\n' || c.point == '\t');
  }
}

/// What an action gives, unless it refuses.
template <class Action>
auto resultOf(Action action) -> std::optional<decltype(action())> {
  try {
    return action();
  } catch (const Error& error) {
    checkMessage(error);
    return std::nullopt;
  }
}

}  // namespace luxo
