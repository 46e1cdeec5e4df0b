// SPDX-License-Identifier: Apache-2.0
#include "measured_picture.h"

#include <utility>

namespace luxo {

MeasuredFrame measure(Renderer& renderer, const Snapshot& snapshot, DrawOptions options) {
  options.samples = 1;
  const auto draw = [&](Output output) {
    options.output = output;
    return renderer.render(snapshot, options);
  };
  Picture color = draw(Output::Color);
  return {.picture = {.color = std::move(color.image),
                      .depth = draw(Output::Depth).image,
                      .position = draw(Output::Position).image,
                      .normal = draw(Output::Normal).image,
                      .uv = draw(Output::Uv).image,
                      .id = draw(Output::Id).image},
          .statistics = color.statistics};
}

}  // namespace luxo
