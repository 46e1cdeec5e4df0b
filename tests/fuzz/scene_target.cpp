// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <string>

#include "base/assert.h"
#include "base/error.h"
#include "base/utf8.h"
#include "fuzz/target.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/snapshot.h"

namespace luxo {
namespace {

// What is wrong with a scene is said in words that a terminal can show.
void checkMessage(const Error& error) {
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

template <class Action>
auto resultOf(Action action) -> std::optional<decltype(action())> {
  try {
    return action();
  } catch (const Error& error) {
    checkMessage(error);
    return std::nullopt;
  }
}

}  // namespace

void fuzzScene(std::string_view input) {
  const auto file = resultOf([&] { return parseScene(std::string(input), "fuzz.luxo.json"); });
  if (!file) return;
  const std::string written = writeScene(*file);
  const SceneFile again = parseScene(written, "written.luxo.json");
  LUXO_REQUIRE(again == *file);
  LUXO_REQUIRE(writeScene(again) == written);

  const auto scene = resultOf([&] { return buildScene(*file); });
  if (!scene) return;
  for (const double time : {0.0, 1.5})
    resultOf([&] { return takeSnapshot(*scene, time, {64, 48}).nodes.size(); });
}

}  // namespace luxo
