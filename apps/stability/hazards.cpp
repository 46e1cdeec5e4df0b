// SPDX-License-Identifier: Apache-2.0
// ST-32: formulas without values beside good ones.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "stability/cases.h"
#include "stability/pictures.h"
#include "tessellate/tessellator.h"

namespace luxo {
namespace {

struct BadFormula {
  std::string_view name, z;  ///< the third coordinate over the unit square
  bool hole;                 ///< there is a region without values, and a person can be told which
};

constexpr BadFormula kBadFormulas[] = {{"1/0", "1/(u - 0.5)", false},
                                       {"log(-1)", "log(v - 0.5)", true},
                                       {"sqrt(-x)", "sqrt(0.3 - u)", true},
                                       {"1e30 sin", "1e30*sin(tau*u)", false}};

/// Good surfaces, and a bad one where a formula is given.
Scene besideBad(std::string_view z, std::vector<Diagnostic>* warnings = nullptr) {
  const std::string bad =
      z.empty()
          ? std::string()
          : fmt::format(R"json({{ "name": "bad", "translate": [-0.7, -0.5, -1], "surface": "bad" }},)json");
  const std::string surface = fmt::format(
      R"json("bad": {{ "type": "formula", "position": ["1.4u", "v", "{}"] }},)json", z.empty() ? "0" : z);
  return buildScene(parseScene(fmt::format(R"json({{
    "luxo": 1,
    "surfaces": {{ {}
      "ball": {{ "type": "sphere", "radius": 0.6 }},
      "ring": {{ "type": "torus", "major": 0.6, "minor": 0.2 }},
      "floor": {{ "type": "rectangle", "size": [6, 5] }} }},
    "nodes": [
      {{ "translate": [-1.3, 0, 0], "surface": "ball" }},
      {{ "translate": [1.3, 0, 0], "rotate": {{ "axis": [1, 0, 0.3], "angle": 1 }}, "surface": "ring" }},
      {{ "translate": [0, -0.9, 0], "surface": "floor" }},
      {}
      {{ "translate": [3, 5, 4], "light": {{ "intensity": 1 }} }} ],
    "camera": {{ "eye": [0, 1, 5], "look_at": [0, 0, 0] }} }})json",
                                           surface, bad),
                               "beside"),
                    {}, warnings);
}

std::vector<Measurement> badFormulas(StressContext& context) {
  const Snapshot good = takeSnapshot(besideBad({}), 0, context.size());
  const Image expected = context.draw(good).image;
  std::vector<Measurement> result;
  for (const BadFormula& formula : kBadFormulas) {
    std::vector<Diagnostic> warnings;
    const Scene scene = besideBad(formula.z, &warnings);
    const Snapshot snapshot = takeSnapshot(scene, 0, context.size());
    const auto number = static_cast<float>(
        std::ranges::find(snapshot.nodes, *scene.findNode("bad"), &SnapshotNode::id)->number);
    const Image ids = context.draw(snapshot, {.output = Output::Id}).image;
    const Picture picture = context.draw(snapshot);
    std::int64_t changed = 0, kept = 0;
    for (int y = 0; y < ids.height(); ++y)
      for (int x = 0; x < ids.width(); ++x) {
        if (ids.pixel(x, y)[0] == number) continue;
        ++kept;
        // Where the shell of the bad surface tells nothing, points of the others are found by rays, not by
        // searches: no colour of 8 bits may tell.
        changed += glm::distance(colorAt(picture.image, x, y), colorAt(expected, x, y)) > 0.5 / 255;
      }
    std::int64_t notFinite = samplesNotFinite(picture.image);
    for (const Output output : {Output::Normal, Output::Position, Output::Uv})
      notFinite += samplesNotFinite(context.draw(snapshot, {.output = output}).image);
    const std::string name(formula.name);
    result.push_back(none(name + ": pixels of other surfaces that change", changed, "pixels"));
    result.push_back(none(name + ": samples that are not finite", notFinite, "samples"));
    result.push_back(atLeast(name + ": pixels of other surfaces", kept, context.of(400000, 30000), "pixels"));
    if (!formula.hole) continue;
    const SnapshotNode& bad = *std::ranges::find(snapshot.nodes, *scene.findNode("bad"), &SnapshotNode::id);
    const Mesh mesh = tessellate(bad.surface, bad.parameters, {.uniform = Segments{16, 16}});
    result.push_back(atLeast(name + ": pixels of what has values",
                             static_cast<double>(std::int64_t{ids.width()} * ids.height() - kept),
                             context.of(5000, 300), "pixels"));
    result.push_back(atLeast(name + ": triangles left out and counted", static_cast<double>(mesh.dropped), 1,
                             "triangles"));
    const auto told = std::ranges::count_if(
        warnings, [](const Diagnostic& w) { return w.message.find("no value in u") != std::string::npos; });
    result.push_back(atLeast(name + ": messages that name the region", told, 1, "messages"));
  }
  return result;
}

}  // namespace

std::vector<StressCase> hazardCases() {
  return {{.id = "ST-32", .title = "formulas without values beside good ones", .run = badFormulas}};
}

}  // namespace luxo
