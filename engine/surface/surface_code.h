// SPDX-License-Identifier: Apache-2.0
// Surfaces as shader code: what the exact fragment shaders are made with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "formula/glsl.h"
#include "surface/equation.h"
#include "surface/patch.h"
#include "surface/surface_function.h"

namespace luxo {

/// A formula's GLSL: `void surfaceAt(float u, float v, out vec3 S, out vec3 Su, out vec3 Sv)`, or of doubles,
/// for shaders/lib/exact_root.glsl, with LUXO_ORIGIN_OF_U where u is counted from that parameter; or which
/// form of an equation shaders/lib/exact_equation.glsl solves, or that it is a plane, for
/// shaders/lib/exact_plane.glsl.
struct SurfaceCode {
  std::string glsl;
  std::uint32_t parameters = 0;  ///< how many it may read to find a point; its name may take one more
  GlslNumber number = GlslNumber::Float;
  std::size_t instructions = 0;  ///< of a formula, about

  /// There is no code: surfaces must be found in another way.
  [[nodiscard]] bool isTooLarge() const { return glsl.empty(); }
};

using SurfaceCodePtr = std::shared_ptr<const SurfaceCode>;

/// Formulas of more instructions are too large for exact shaders. Those of a sum of 100 sines, 5300, take a
/// driver and us 3 s of processor time: at this limit it is about 12 s, on two cores 7.
inline constexpr std::size_t kMaxInstructions = 20'000;

/// The code of a formula, or of a general form, that reads at most `parameters` variables beyond u and v. It
/// is empty where the formula is too large. Cost: tens of microseconds for usual formulas.
[[nodiscard]] SurfaceCode surfaceCode(const SurfaceFunction& function, std::size_t parameters,
                                      GlslNumber number = GlslNumber::Float);
[[nodiscard]] SurfaceCode surfaceCode(const GeneralForm& form, std::size_t parameters,
                                      GlslNumber number = GlslNumber::Float);

/// The code of all surfaces with an equation of that form, which reads `parameters` numbers of it.
[[nodiscard]] SurfaceCode equationCode(Equation::Form form, std::size_t parameters,
                                       GlslNumber number = GlslNumber::Float);
/// The code of patches of several formulas, all in float: those read `parameters` numbers at most, and one
/// more tells which of the codes a patch has. It is empty where one is, or all together are too large.
[[nodiscard]] SurfaceCode unitedCode(std::span<const SurfaceCodePtr> codes, std::size_t parameters);
/// What is read of a triangle that rays meet (shaders/lib/triangle_ray.glsl).
inline constexpr std::uint32_t kTriangleNumbers = 9;
/// The code of all of them.
[[nodiscard]] SurfaceCode triangleCode();
/// The code of all planes that fill a shell, in double.
[[nodiscard]] SurfaceCode planeCode(std::size_t parameters);

/// Every function's code, made once while the function is there. Equal formulas share one, whoever made them:
/// codes that are there at the same time are equal where their addresses are.
class SurfaceCodes {
 public:
  [[nodiscard]] SurfaceCodePtr get(const std::shared_ptr<const SurfaceFunction>& function,
                                   std::size_t parameters, GlslNumber number = GlslNumber::Float);
  [[nodiscard]] SurfaceCodePtr get(const std::shared_ptr<const GeneralForm>& form, std::size_t parameters,
                                   GlslNumber number = GlslNumber::Float);
  [[nodiscard]] SurfaceCodePtr get(Equation::Form form, std::size_t parameters,
                                   GlslNumber number = GlslNumber::Float);
  [[nodiscard]] SurfaceCodePtr united(std::span<const SurfaceCodePtr> codes, std::size_t parameters) {
    return shared(unitedCode(codes, parameters));
  }
  [[nodiscard]] SurfaceCodePtr triangles() { return shared(triangleCode()); }
  [[nodiscard]] SurfaceCodePtr plane(std::size_t parameters) { return shared(planeCode(parameters)); }

  /// Codes that are remembered, whether or not anyone has them still.
  [[nodiscard]] std::size_t count() const { return byText_.size(); }

 private:
  struct Known {
    std::weak_ptr<const void> formula;  ///< another one may get the address of one that is gone
    SurfaceCodePtr code;
  };

  SurfaceCodePtr shared(SurfaceCode code);
  template <class Formula>
  SurfaceCodePtr ofFormula(const std::shared_ptr<const Formula>& formula, std::size_t parameters,
                           GlslNumber number);
  /// Functions and codes that are gone.
  void forgetGone();

  std::map<std::pair<std::string, GlslNumber>, std::weak_ptr<const SurfaceCode>> byText_;
  std::map<std::pair<const void*, GlslNumber>, Known> byFormula_;
};

}  // namespace luxo
