// SPDX-License-Identifier: Apache-2.0
#include "surface/surface_code.h"

#include "formula/glsl.h"

namespace luxo {

SurfaceCode surfaceCode(const SurfaceFunction& function, std::size_t parameters) {
  Graph graph;
  const std::vector<Expr> position = function.position.expressions(graph);
  SurfaceCode code{.glsl = emitSurfaceGlsl(graph, "surfaceAt", {position[0], position[1], position[2]}),
                   .parameters = static_cast<std::uint32_t>(parameters)};
  return code;
}

const SurfaceCode* SurfaceCodes::get(const std::shared_ptr<const SurfaceFunction>& function,
                                     std::size_t parameters) {
  Known& known = byFunction_[function.get()];
  if (known.function.lock() != function) {
    SurfaceCode code = surfaceCode(*function, parameters);
    std::string text = code.glsl;
    known = {function, &byText_.try_emplace(std::move(text), std::move(code)).first->second};
  }
  return known.code;
}

}  // namespace luxo
