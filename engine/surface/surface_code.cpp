// SPDX-License-Identifier: Apache-2.0
#include "surface/surface_code.h"

namespace luxo {

SurfaceCode surfaceCode(const SurfaceFunction& function, std::size_t parameters, GlslNumber number) {
  Graph graph;
  const std::vector<Expr> position = function.position.expressions(graph);
  return {.glsl = emitSurfaceGlsl(graph, "surfaceAt", {position[0], position[1], position[2]}, false, number),
          .parameters = static_cast<std::uint32_t>(parameters),
          .number = number};
}

const SurfaceCode* SurfaceCodes::get(const std::shared_ptr<const SurfaceFunction>& function,
                                     std::size_t parameters, GlslNumber number) {
  Known& known = byFunction_[{function.get(), number}];
  if (known.function.lock() != function) {
    SurfaceCode code = surfaceCode(*function, parameters, number);
    std::string text = code.glsl;
    known = {function, &byText_.try_emplace(std::move(text), std::move(code)).first->second};
  }
  return known.code;
}

}  // namespace luxo
