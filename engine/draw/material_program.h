// SPDX-License-Identifier: Apache-2.0
// A material's shader as luxo compiles it: its text made safe to join with luxo's own, and its uniforms by
// name.
//
// The values of uniforms are data of a material, so that all materials of a shader share its modules: they
// lie among the material's numbers (DrawList::patternParameters), after kShaderNumbers others, which
// appendShader() lists.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
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

  /// All that shaders with LUXO_SHADER include beside luxo's own, the files "material" and "curvature" among
  /// it, for a paint that has it: uniforms that are not given keep what the shader says, or 0. Valid as long
  /// as this, the paint and `material`, which it fills.
  [[nodiscard]] std::vector<gpu::ShaderSource> sources(const Paint& paint, std::string& material) const;

 private:
  /// By itself, in one of luxo's own shaders, of which it is the file "material": the files[index].
  [[nodiscard]] gpu::ShaderInterface compileAlone(std::string_view in, std::size_t index,
                                                  gpu::ShaderStage stage);
  void compileCourse();
  void requireSettable();
  void requirePure(const gpu::ShaderInterface& interface) const;
  void requireAffordable() const;
  /// Error(Scene) where the word stands in a file of its own; nothing where it stands in none.
  void refuseWord(const std::string& word, const std::string& why, const std::string& advice) const;
  /// Whether its declaration says what it is where a scene does not.
  [[nodiscard]] bool isInitialised(const std::string& uniform) const;
  /// Statements that give uniforms their values; `storageOf` gives the variable.
  template <typename StorageOf>
  [[nodiscard]] std::string loads(const Paint& paint, StorageOf storageOf) const;
  void nameSamplers();
  void requireTextures(const Material& material) const;
  [[nodiscard]] const gpu::ShaderVariable* find(const std::string& name) const;

  MaterialShaderPtr shader_;
  std::vector<std::string> texts_;  ///< of its files, with bounded loops
  gpu::ShaderCost cost_;
  gpu::ShaderInterface interface_;
  std::optional<CourseProgram> course_;
  std::vector<gpu::ShaderVariable> uniforms_;
  bool compiled_ = false;
};

/// Keeps those of the last pictures' shaders.
class MaterialPrograms {
 public:
  [[nodiscard]] const MaterialProgram& of(const MaterialShaderPtr& shader);
  /// Of all materials that are on something: MaterialProgram::check(). What is not used is logged, once.
  void check(const Snapshot& snapshot);
  /// Since the last time: shaders that no run before had.
  [[nodiscard]] std::uint64_t takeCompiled() { return std::exchange(compiled_, 0); }

 private:
  void tellShadows(const Snapshot& snapshot);

  std::map<MaterialShaderPtr, MaterialProgram> programs_;
  std::uint64_t compiled_ = 0;
  std::set<std::string> told_;
};

/// What is before the uniforms: the origin of positions, what takes them to the node's axes (columns and a
/// constant), the ambient light, what takes directions back. Behind them are the parameters of
/// Material::curvature.
inline constexpr std::uint32_t kShaderNumbers = 27;
void appendShader(const Material& material, const SnapshotNode& node, const Vec3& origin, const Vec3& ambient,
                  std::vector<float>& numbers);

}  // namespace luxo
