// SPDX-License-Identifier: Apache-2.0
#include "measured_picture.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "draw/place_list.h"

namespace luxo {
namespace {

/// The lights of a picture whose shadows fall on meshes of formulas, or on triangles that are lit otherwise
/// than at each of their points; none where there are none, or too many.
std::vector<WholeLight> lightsOnMeshes(const Snapshot& snapshot, const DrawOptions& options) {
  const bool meshes = std::ranges::any_of(snapshot.nodes, [&](const SnapshotNode& node) {
    const Shading shading = snapshot.materials[node.material.index].shadingIn(options.shading);
    return isLitMesh(shading) && !(node.surface.isPolygonal() && shading == Shading::Phong);
  });
  std::vector<WholeLight> lights = wholeLights(withExactShadows(snapshot));
  const auto hasShadow = [](const WholeLight& whole) { return whole.light.hasShadow(); };
  if (!meshes || lights.size() > kMaxAlone || std::ranges::none_of(lights, hasShadow)) lights.clear();
  return lights;
}

SnapshotLight withoutShadow(SnapshotLight light) {
  light.shade.reset();
  light.casters.clear();
  return light;
}

}  // namespace

MeasuredFrame measure(Renderer& renderer, const Snapshot& snapshot, DrawOptions options) {
  options.samples = 1;
  const auto draw = [&](const Snapshot& drawn, Output output) {
    options.output = output;
    return renderer.render(drawn, options);
  };
  Picture color = draw(snapshot, Output::Color);
  MeasuredFrame frame{.picture = {.color = std::move(color.image),
                                  .depth = draw(snapshot, Output::Depth).image,
                                  .position = draw(snapshot, Output::Position).image,
                                  .normal = draw(snapshot, Output::Normal).image,
                                  .uv = draw(snapshot, Output::Uv).image,
                                  .id = draw(snapshot, Output::Id).image},
                      .statistics = color.statistics};
  Snapshot lit = snapshot;
  const auto light = [&](std::vector<SnapshotLight> lights) {
    lit.lights = std::move(lights);
    return draw(lit, Output::Color).image;
  };
  for (const WholeLight& one : lightsOnMeshes(snapshot, options))
    frame.picture.alone.push_back(light({withoutShadow(one.light)}));
  if (!frame.picture.alone.empty()) frame.picture.dark = light({});
  return frame;
}

}  // namespace luxo
