// SPDX-License-Identifier: Apache-2.0
// The shaders of a draw: those that were compiled when luxo was built, and those that formulas, patterns and
// materials of a scene are joined with.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "draw/draw_state.h"
#include "draw/material_programs.h"
#include "gpu/context.h"

namespace luxo {

class ScenePrograms {
 public:
  using Shader = std::span<const std::uint32_t>;  ///< SPIR-V
  struct Program {
    Shader vertex, fragment;  ///< the fragment's is empty where only depth is drawn
  };

  explicit ScenePrograms(gpu::Context& context) : context_(&context) {}

  /// Compiles what finds these states' surfaces and is not there yet, on all cores.
  void prepare(std::span<const DrawState> states);
  /// Requires prepare(). Valid until forgetAllBut().
  [[nodiscard]] Program of(const DrawState& state);
  void forgetAllBut(std::span<const DrawState* const> used);

  /// The shaders that materials have.
  [[nodiscard]] MaterialPrograms& materials() { return materials_; }

 private:
  [[nodiscard]] Shader vertexOf(const DrawState& state) const;
  [[nodiscard]] Shader fragmentOf(const DrawState& state);
  [[nodiscard]] Shader fragmentOfTriangles(const DrawState& state);
  /// The fragment shader that finds the state's surface, or where rays meet its cells.
  [[nodiscard]] Shader exactShader(const DrawState& state) const;
  /// The fragment shader of that name below shaders/pattern, made for the state's pattern; `plain` where it
  /// has none.
  [[nodiscard]] Shader withPattern(const DrawState& state, std::string_view name, Shader plain);
  [[nodiscard]] Shader patternShader(const DrawState& state, std::string_view name);

  gpu::Context* context_;
  /// Grazing; what it does with what it finds; whether it tells footprints, and frames.
  using ExactShaderKey = std::tuple<SurfaceCodePtr, Paint, bool, Form, bool, bool>;
  [[nodiscard]] static ExactShaderKey exactShaderKey(const DrawState& state);
  std::map<ExactShaderKey, std::vector<std::uint32_t>> exactShaders_;
  /// Whether vertices have tangents.
  std::map<std::tuple<Paint, std::string_view, bool>, std::vector<std::uint32_t>> patternShaders_;
  MaterialPrograms materials_;
};

}  // namespace luxo
