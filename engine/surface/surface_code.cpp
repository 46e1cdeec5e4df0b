// SPDX-License-Identifier: Apache-2.0
#include "surface/surface_code.h"

#include <fmt/format.h>

#include <algorithm>

namespace luxo {
namespace {

SurfaceCode codeOf(Graph& graph, const std::vector<Expr>& position, std::size_t parameters,
                   GlslNumber number) {
  const ExprPoint point{position[0], position[1], position[2]};
  const std::size_t instructions = surfaceGlslInstructions(graph, point, number);
  return {.glsl = instructions > kMaxInstructions ? std::string()
                                                  : emitSurfaceGlsl(graph, "surfaceAt", point, false, number),
          .parameters = static_cast<std::uint32_t>(parameters),
          .number = number,
          .instructions = instructions};
}

constexpr std::string_view kFunction = "void surfaceAt(";

}  // namespace

SurfaceCode surfaceCode(const SurfaceFunction& function, std::size_t parameters, GlslNumber number) {
  Graph graph;
  if (!function.originOfU) return codeOf(graph, function.position.expressions(graph), parameters, number);
  const std::uint32_t origin = *function.originOfU - 2;
  const std::vector<Expr> position = function.position.expressions(graph, {{*function.originOfU, 0}});
  SurfaceCode code = codeOf(graph, position, std::min<std::size_t>(parameters, origin), number);
  if (!code.isTooLarge()) code.glsl = fmt::format("#define LUXO_ORIGIN_OF_U {}\n{}", origin, code.glsl);
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

SurfaceCode unitedCode(std::span<const SurfaceCodePtr> codes, std::size_t parameters) {
  SurfaceCode united{.glsl = {}, .parameters = static_cast<std::uint32_t>(parameters + 1)};
  std::string functions, cases;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    united.instructions += codes[i]->instructions;
    if (codes[i]->isTooLarge() || united.instructions > kMaxInstructions) return united;
    const std::string_view text = codes[i]->glsl;
    functions += fmt::format("void surfaceAt{}({}", i, text.substr(text.find(kFunction) + kFunction.size()));
    cases += fmt::format("    case {0}: surfaceAt{0}(u, v, S, Su, Sv); break;\n", i);
  }
  united.glsl = fmt::format(
      "{}{}const float u, const float v, out vec3 S, out vec3 Su, out vec3 Sv) {{\n"
      "  S = Su = Sv = vec3(0);\n"
      "  switch (int(parameterAt({}u))) {{\n{}  }}\n}}\n",
      functions, kFunction, parameters, cases);
  return united;
}

SurfaceCodePtr SurfaceCodes::shared(SurfaceCode code) {
  std::weak_ptr<const SurfaceCode>& known = byText_[{code.glsl, code.number}];
  SurfaceCodePtr there = known.lock();
  if (!there) known = there = std::make_shared<const SurfaceCode>(std::move(code));
  return there;
}

void SurfaceCodes::forgetGone() {
  std::erase_if(byFormula_, [](const auto& entry) { return entry.second.formula.expired(); });
  std::erase_if(byText_, [](const auto& entry) { return entry.second.expired(); });
}

SurfaceCode triangleCode() { return {.glsl = "#define LUXO_TRIANGLES\n", .parameters = kTriangleNumbers}; }

SurfaceCodePtr SurfaceCodes::get(Equation::Form form, std::size_t parameters, GlslNumber number) {
  return shared(equationCode(form, parameters, number));
}

template <class Formula>
SurfaceCodePtr SurfaceCodes::ofFormula(const std::shared_ptr<const Formula>& formula, std::size_t parameters,
                                       GlslNumber number) {
  const auto known = byFormula_.find({formula.get(), number});
  if (known != byFormula_.end() && known->second.formula.lock() == formula) return known->second.code;
  forgetGone();
  SurfaceCodePtr code = shared(surfaceCode(*formula, parameters, number));
  byFormula_[{formula.get(), number}] = {formula, code};
  return code;
}

SurfaceCodePtr SurfaceCodes::get(const std::shared_ptr<const SurfaceFunction>& function,
                                 std::size_t parameters, GlslNumber number) {
  return ofFormula(function, parameters, number);
}

SurfaceCodePtr SurfaceCodes::get(const std::shared_ptr<const GeneralForm>& form, std::size_t parameters,
                                 GlslNumber number) {
  return ofFormula(form, parameters, number);
}

}  // namespace luxo
