// SPDX-License-Identifier: Apache-2.0
// What a shader asks of whoever runs it, read from its SPIR-V: uniforms, attributes, varyings and blocks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/shader_compiler.h"

namespace luxo::gpu {

/// A variable, or a member of a block or of a structure.
struct ShaderVariable {
  std::string name;
  std::string type;  ///< as GLSL writes it, arrays apart: "vec3"; of a structure its name
  std::vector<std::uint32_t> array = {};  ///< sizes, the outermost first; 0: as long as the buffer is
  std::optional<std::uint32_t> location = {}, set = {}, binding = {};
  std::uint32_t offset = 0, size = 0;               ///< bytes, of a member
  std::uint32_t arrayStride = 0, matrixStride = 0;  ///< the latter from column to column, or row to row
  bool rowMajor = false;                            ///< of a matrix in a block
  bool patch = false;                               ///< of a patch, not of each of its vertices
  bool active = true;                               ///< something that runs reads or writes it
  std::vector<ShaderVariable> members = {};         ///< of a structure
  std::vector<ShaderStage> stages = {};  ///< of two stages together: which of them have it, in their order

  [[nodiscard]] std::uint32_t elements() const;  ///< of the array, 1 of none
};

struct ShaderBlock {
  enum class Kind { Uniform, Storage, Push };
  std::string name;
  Kind kind = Kind::Uniform;
  bool loose = false;  ///< made of the uniforms that are outside of blocks
  std::uint32_t set = 0, binding = 0;
  std::uint32_t size = 0;  ///< bytes, without an array at its end that is as long as the buffer is
  bool active = true;
  std::vector<ShaderVariable> members;
};

struct ShaderInterface {
  ShaderStage stage = ShaderStage::Fragment;
  /// What its stage takes and gives, in the words of `layout(...)`: "triangles", "max_vertices = 3".
  std::vector<std::string> layout;
  std::vector<ShaderVariable> inputs,
      outputs;  ///< by location; then GLSL's own that it uses, which have none
  std::vector<ShaderBlock> blocks;
  std::vector<ShaderVariable> samplers;   ///< images among them
  std::vector<ShaderVariable> constants;  ///< specialization constants, whose location is their number
  std::uint32_t loops = 0;
  std::vector<std::string> calls;  ///< of functions, each by the name of what it calls
  bool discards = false;           ///< some of its fragments may end with nothing
  std::vector<std::string> functions, structures, globals;  ///< names that the text gives
  std::vector<std::string> computedGlobals;                 ///< of these, what begins as no constant
  std::string beyond;  ///< what it asks of a device beyond plain GLSL, the first of it: "ray queries"
};

/// Names are there if the words were compiled for reflection. Error(Scene): they are no SPIR-V; those of
/// others are asked for that first (gpu/shader_validation.h). Cost: linear.
[[nodiscard]] ShaderInterface reflect(std::span<const std::uint32_t> spirv);

/// Truth in a buffer is a number, in SPIR-V as well: the type of GLSL, where whoever asks knows that
/// `type`, "uint" or "uvec3", is one: "bool", "bvec3".
[[nodiscard]] std::string boolOf(const std::string& type);

/// What a shader is given at one location: a scalar, a vector, a column of a matrix.
struct StageInput {
  std::uint32_t location = 0;
  std::string type;  ///< as GLSL writes it: "vec3"
  std::string name;  ///< of all of the variable; optimised words have none
};

/// Of that only what a pipeline is made from.
struct StageInterface {
  std::vector<StageInput> inputs;  ///< by location
  std::uint32_t pushConstantBytes = 0;
};

/// Cost: some 6 us for each KB. Error(Scene) as above.
[[nodiscard]] StageInterface stageInterface(std::span<const std::uint32_t> spirv);

}  // namespace luxo::gpu
