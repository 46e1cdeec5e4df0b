// SPDX-License-Identifier: Apache-2.0
// A material's shader as luxo compiles it: its text made safe to join with luxo's own, and its uniforms by
// name.
//
// The values of uniforms are data of a material, so that all materials of a shader share its modules: they
// lie among the material's numbers (DrawList::patternParameters), after shared::kShaderNumbers others.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "draw/course_program.h"
#include "draw/paint.h"
#include "gpu/shader_cost.h"
#include "gpu/shader_reflection.h"
#include "scene/snapshot.h"

namespace luxo {

class MaterialProgram {
 public:
  /// Compiles it by itself, or reads that from disk (gpu::ShaderCompiler). Error(Scene): what is wrong, at
  /// its own file, line and column.
  explicit MaterialProgram(MaterialShaderPtr shader);

  /// Of a program in the course's style: of its stages together.
  [[nodiscard]] const gpu::ShaderInterface& interface() const {
    return course_ ? course_->interface() : interface_;
  }
  /// Whether it is a program in the course's style (draw/course_style.h).
  [[nodiscard]] bool inCourseStyle() const { return course_.has_value(); }
  [[nodiscard]] const std::vector<gpu::ShaderVariable>& uniforms() const { return uniforms_; }
  [[nodiscard]] bool compiled() const { return compiled_; }

  /// Error(Scene): a value is for a uniform that there is not, or is none of its type.
  void check(const Material& material) const;
  /// A message for each value that the shader does not use.
  [[nodiscard]] std::vector<std::string> unused(const Material& material) const;

  /// All that shaders with LUXO_SHADER include beside luxo's own, for a paint that has it: uniforms that are
  /// not given keep what the shader says, or 0.
  struct Joined {
    std::string curvature;                         ///< the file of that name; empty: there is none
    std::string material;                          ///< the file of that name
    std::vector<std::string> names, texts, shown;  ///< of the shader's own files

    /// Valid as long as this.
    [[nodiscard]] std::vector<gpu::ShaderSource> sources() const;
  };
  [[nodiscard]] Joined joined(const Paint& paint) const;
  /// What lib/vertex_movement.glsl includes in the same way. Requires a vertex program in the course's style.
  [[nodiscard]] Joined movement(const Paint& paint) const;

 private:
  /// By itself, in one of luxo's own shaders, of which it is the file "material": the files[index].
  [[nodiscard]] gpu::ShaderInterface compileAlone(std::string_view in, std::size_t index,
                                                  gpu::ShaderStage stage);
  void compileCourse();
  using CourseText = std::string (CourseProgram::*)(const std::string&, const std::string&) const;
  [[nodiscard]] Joined joinedCourse(const Paint& paint, CourseText text) const;
  void requireSettable();
  void requireOwnNames() const;
  void addCopiedArrays();
  /// The variables that it is in the joined texts.
  [[nodiscard]] std::vector<std::string> storagesOf(const gpu::ShaderVariable& uniform) const;
  void requirePure(const gpu::ShaderInterface& interface) const;
  void requireFewInstructions() const;
  void requireAffordable() const;
  [[noreturn]] void refuseTable() const;
  [[nodiscard]] bool isWrapped(const std::string& name) const;
  /// Error(Scene) where the word stands in a file of its own; nothing where it stands in none.
  void refuseWord(const std::string& word, const std::string& why, const std::string& advice) const;
  /// What gives uniforms their values: a function for each, luxoAt_NAME(), of arrays by indices; and
  /// statements.
  struct Loads {
    std::string functions, statements;
  };
  /// Has `texts`, the shader's own, read elements of arrays where they lie; where they cannot, the array is
  /// copied to each point, as other uniforms are.
  [[nodiscard]] Loads loads(const Paint& paint, std::vector<std::string>& texts) const;
  static bool readElements(std::vector<std::string>& texts, const std::string& name, std::size_t dimensions);
  /// An expression of `element`, the index in all of an array. Nothing: it keeps what the shader says.
  [[nodiscard]] std::optional<std::string> valueOf(const gpu::ShaderVariable& uniform,
                                                   const Paint& paint) const;
  void nameTypes();
  void requireTextures(const Material& material) const;
  [[nodiscard]] const gpu::ShaderVariable* find(const std::string& name) const;

  MaterialShaderPtr shader_;
  std::vector<std::string> texts_;  ///< of its files, with bounded loops
  std::set<std::string>
      initialised_;  ///< variables whose declarations say what they are where a scene does not
  gpu::ShaderCost cost_;
  gpu::ShaderInterface interface_;
  std::optional<CourseProgram> course_;
  std::vector<gpu::ShaderVariable> uniforms_;
  bool compiled_ = false;
};

/// The numbers of its shader (shared::kShaderOrigin and on), of its uniforms, and the parameters of
/// Material::curvature.
void appendShader(const Material& material, const SnapshotNode& node, const Vec3& origin, const Vec3& ambient,
                  std::vector<float>& numbers);
/// Those of the uniforms alone.
void appendUniforms(const Material& material, std::vector<float>& numbers);

}  // namespace luxo
