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

SurfaceCode equationCode(Equation::Form form, std::size_t parameters, GlslNumber number) {
  return {.glsl = form == Equation::Form::Quadric ? "#define LUXO_QUADRIC\n" : "#define LUXO_TORUS\n",
          .parameters = static_cast<std::uint32_t>(parameters),
          .number = number};
}

const SurfaceCode* SurfaceCodes::shared(SurfaceCode code) {
  std::pair key(code.glsl, code.number);
  return &byText_.try_emplace(std::move(key), std::move(code)).first->second;
}

const SurfaceCode* SurfaceCodes::get(Equation::Form form, std::size_t parameters, GlslNumber number) {
  return shared(equationCode(form, parameters, number));
}

const SurfaceCode* SurfaceCodes::get(const std::shared_ptr<const SurfaceFunction>& function,
                                     std::size_t parameters, GlslNumber number) {
  Known& known = byFunction_[{function.get(), number}];
  if (known.function.lock() != function)
    known = {function, shared(surfaceCode(*function, parameters, number))};
  return known.code;
}

}  // namespace luxo
