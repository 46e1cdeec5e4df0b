// SPDX-License-Identifier: Apache-2.0
#include "surface/surface_code.h"

#include <fmt/format.h>

#include <algorithm>

namespace luxo {
namespace {

SurfaceCode codeOf(Graph& graph, const std::vector<Expr>& position, std::size_t parameters,
                   GlslNumber number) {
  return {.glsl = emitSurfaceGlsl(graph, "surfaceAt", {position[0], position[1], position[2]}, false, number),
          .parameters = static_cast<std::uint32_t>(parameters),
          .number = number};
}

}  // namespace

SurfaceCode surfaceCode(const SurfaceFunction& function, std::size_t parameters, GlslNumber number) {
  Graph graph;
  if (!function.originOfU) return codeOf(graph, function.position.expressions(graph), parameters, number);
  const std::uint32_t origin = *function.originOfU - 2;
  const std::vector<Expr> position = function.position.expressions(graph, {{*function.originOfU, 0}});
  SurfaceCode code = codeOf(graph, position, std::min<std::size_t>(parameters, origin), number);
  code.glsl = fmt::format("#define LUXO_ORIGIN_OF_U {}\n{}", origin, code.glsl);
  return code;
}

SurfaceCode surfaceCode(const GeneralForm& form, std::size_t parameters, GlslNumber number) {
  Graph graph;
  return codeOf(graph, form.position.expressions(graph), parameters, number);
}

SurfaceCode equationCode(Equation::Form form, std::size_t parameters, GlslNumber number) {
  return {.glsl = form == Equation::Form::Quadric ? "#define LUXO_QUADRIC\n" : "#define LUXO_TORUS\n",
          .parameters = static_cast<std::uint32_t>(parameters),
          .number = number};
}

SurfaceCode planeCode(std::size_t parameters) {
  return {.glsl = "#define LUXO_PLANE\n",
          .parameters = static_cast<std::uint32_t>(parameters),
          .number = GlslNumber::Double};
}

const SurfaceCode* SurfaceCodes::shared(SurfaceCode code) {
  std::pair key(code.glsl, code.number);
  return &byText_.try_emplace(std::move(key), std::move(code)).first->second;
}

const SurfaceCode* SurfaceCodes::get(Equation::Form form, std::size_t parameters, GlslNumber number) {
  return shared(equationCode(form, parameters, number));
}

template <class Formula>
const SurfaceCode* SurfaceCodes::ofFormula(const std::shared_ptr<const Formula>& formula,
                                           std::size_t parameters, GlslNumber number) {
  Known& known = byFormula_[{formula.get(), number}];
  if (known.formula.lock() != formula) known = {formula, shared(surfaceCode(*formula, parameters, number))};
  return known.code;
}

const SurfaceCode* SurfaceCodes::get(const std::shared_ptr<const SurfaceFunction>& function,
                                     std::size_t parameters, GlslNumber number) {
  return ofFormula(function, parameters, number);
}

const SurfaceCode* SurfaceCodes::get(const std::shared_ptr<const GeneralForm>& form, std::size_t parameters,
                                     GlslNumber number) {
  return ofFormula(form, parameters, number);
}

}  // namespace luxo
