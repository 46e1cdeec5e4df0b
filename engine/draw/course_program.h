// SPDX-License-Identifier: Apache-2.0
// A material's shader in the style of GLSL 1.20 (draw/course_style.h): a fragment program and the vertex
// program beside it, each compiled by itself, and joined to one function that lights a point.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gpu/shader_reflection.h"
#include "scene/material_shader.h"
#include "scene/shader_text.h"

namespace luxo {

class CourseProgram {
 public:
  /// Error(Scene) about a word of the shader's files, where it stands first.
  using Refuse =
      std::function<void(const std::string& word, const std::string& why, const std::string& advice)>;

  /// What its programs are by themselves; without a vertex program nothing is handed over to the other.
  /// `texts`: of its files, as they were compiled. Error(Scene): they do not fit each other, or do not write
  /// what they have to.
  CourseProgram(const MaterialShader& shader, const std::vector<std::string>& texts,
                gpu::ShaderInterface fragment, std::optional<gpu::ShaderInterface> vertex,
                const Refuse& refuse);

  /// Of both: attributes as inputs, varyings as outputs, those of the language that are used among them; one
  /// block of uniforms; all names as the programs spell them. A sampler's type is its own.
  [[nodiscard]] const gpu::ShaderInterface& interface() const { return interface_; }

  /// The variables that a uniform is: of each program that has it.
  [[nodiscard]] std::vector<std::string> storagesOf(const std::string& uniform) const;
  /// A statement that gives the initialiser of one program to the other, which has none; else nothing.
  [[nodiscard]] std::string initialiserShared(const std::string& uniform) const;
  /// The text that is the material's: it includes files of the paths, and has `loads` in its function
  /// loadUniforms().
  [[nodiscard]] std::string material(const std::string& functions, const std::string& loads) const;
  /// The same for shaders/lib/vertex_movement.glsl: its function luxoMoveVertex() runs the vertex program,
  /// which there has to be.
  [[nodiscard]] std::string movement(const std::string& functions, const std::string& loads) const;
  /// Of the programs' files as they are joined.
  [[nodiscard]] std::vector<std::string> paths() const { return ofStages(&Stage::paths); }
  [[nodiscard]] std::vector<std::string> texts() const { return ofStages(&Stage::texts); }

 private:
  struct Stage {
    std::string_view prefix;  ///< of its names, where both are one text
    gpu::ShaderInterface interface;
    std::set<std::string, std::less<>> names = {};
    std::vector<std::string> paths = {}, texts = {};  ///< of the shader's files
  };

  [[nodiscard]] std::string programs(const std::string& functions, const std::string& loads) const;
  [[nodiscard]] std::string attributes(bool inPixels) const;
  [[nodiscard]] std::vector<std::string> ofStages(std::vector<std::string> Stage::*what) const;
  void name(Stage& stage, const std::vector<std::string>& texts) const;
  [[nodiscard]] std::vector<std::size_t> includedBy(std::size_t program) const;
  void link(const Refuse& refuse);
  void describe(const Refuse& refuse);
  [[nodiscard]] bool isInitialised(const Stage& stage, const std::string& uniform) const;

  const MaterialShader* shader_;
  std::vector<TextByName> initialisers_;      ///< of each of its files
  std::set<std::string, std::less<>> words_;  ///< of all of them
  Stage fragment_;
  std::optional<Stage> vertex_;
  gpu::ShaderInterface interface_;
  std::string macros_;  ///< what ends those of a program
  bool readsLights_ = false;
};

}  // namespace luxo
