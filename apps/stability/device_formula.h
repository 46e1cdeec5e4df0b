// SPDX-License-Identifier: Apache-2.0
// A list of expressions as the device computes them, in float.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "formula/expression.h"
#include "gpu/context.h"
#include "gpu/descriptor.h"
#include "gpu/pipeline.h"
#include "math/vec.h"

namespace luxo {

class DeviceFormula {
 public:
  /// At most 12 outputs. Compiles: 0.1 s.
  DeviceFormula(gpu::Context& context, Graph& graph, const std::vector<Expr>& outputs);
  /// `glsl` defines `void formula(float u, float v, out vec4 first, out vec4 second, out vec4 third)`; it may
  /// include the shader library, and parameterAt(k) is input k.
  DeviceFormula(gpu::Context& context, const std::string& glsl, std::size_t outputs);

  /// Output k at (u, v) = points[i] in result[k][i]; `inputs` are variables 2, 3, ...
  [[nodiscard]] std::vector<std::vector<float>> at(const std::vector<Vec2f>& points,
                                                   std::span<const double> inputs);

 private:
  static constexpr std::uint32_t kTargets = 3;  // of four floats each
  static constexpr std::uint32_t kWidth = 1024;

  gpu::Context* context_;
  std::size_t outputs_;
  gpu::DescriptorLayout layout_;
  gpu::GraphicsPipeline pipeline_;
};

}  // namespace luxo
