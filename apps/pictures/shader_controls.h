// SPDX-License-Identifier: Apache-2.0
// What people turn of a shader: its uniforms, as its text declares and comments them.
//
//     uniform float grooves = 400.0;   // @slider 50 800 15
//     uniform vec3 metal = vec3(0.6);  // @color
//     uniform int pattern = 1;         // @select plain|brushed|knurled
//
// shaders/MATERIALS.md is their page.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/shader_reflection.h"
#include "math/interval.h"
#include "scene/material_shader.h"

namespace luxo {

struct UniformControl {
  enum class Kind {
    Plain,   ///< numbers without a comment
    Slider,  ///< ... in `range`
    Color,   ///< three numbers, linear RGB
    Choice,  ///< the index of one of `choices`
    Switch,  ///< 0 or 1
    None     ///< arrays, matrices, and what begins as something else than numbers
  };
  std::string name, type;  ///< type: as GLSL writes it, arrays apart
  Kind kind = Kind::None;
  std::vector<double> initial = {};  ///< one of each component; empty of None
  std::optional<Interval> range = {};
  std::optional<double> step = {};  ///< above 0
  std::vector<std::string> choices = {};
  bool active = true;       ///< the shader uses it
  std::size_t numbers = 1;  ///< in all, of arrays and matrices, too
};

/// Of each of `uniforms`, which are the shader's, in their order. A uniform without an initialiser begins at
/// 0, one with a slider at its lower end.
/// Error(Scene), at its file, line and column: a comment that is wrong, or that the type does not take; an
/// initial value that it excludes. `warnings`, where given, takes comments of unknown names.
[[nodiscard]] std::vector<UniformControl> uniformControls(const MaterialShader& shader,
                                                          std::span<const gpu::ShaderVariable> uniforms,
                                                          std::vector<std::string>* warnings = nullptr);

}  // namespace luxo
