// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "base/assert.h"
#include "fuzz/message.h"
#include "fuzz/target.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/snapshot.h"

namespace luxo {

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
