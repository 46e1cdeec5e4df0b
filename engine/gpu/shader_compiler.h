// SPDX-License-Identifier: Apache-2.0
// GLSL to SPIR-V while the program runs: for shaders that only exist once a scene is read. What is known when
// luxo is built is compiled then (cmake/shaders.cmake).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace luxo::gpu {

/// A text and the path by which `#include "..."` and messages name it.
struct ShaderSource {
  std::string_view name;
  std::string_view text;
  std::string_view shown = {};  ///< the lines that messages show, where the text is not as it was written
};

/// The last three are read (gpu/shader_reflection.h), and in no pipeline.
enum class ShaderStage { Vertex, Fragment, Compute, Geometry, TessellationControl, TessellationEvaluation };

struct ShaderDesc {
  ShaderSource source;  ///< with its #version
  ShaderStage stage = ShaderStage::Fragment;
  /// All that it may include, by name or by its path from the including one's; those it does not use cost
  /// nothing.
  std::span<const ShaderSource> includes = {};
  std::string_view preamble = {};        ///< read after the #version: lines of #define
  std::string_view sharedFunction = {};  ///< of optimized()
  /// To be reflected (gpu/shader_reflection.h), not run: every name stays, functions that nobody calls too,
  /// nothing is optimised; uniforms may be outside of blocks, and places (set, binding, location) left out.
  bool forReflection = false;
  /// Where names in the texts are not spelled as in what messages show: gives the message as that is.
  std::string (*asShown)(std::string_view) = nullptr;
};

/// Keeps on disk what it compiled and optimised, by content: the source, what it includes and the compiler's
/// version. A shader that was compiled once, by whatever program, is read back without starting the compiler.
/// The files may be deleted or damaged at any time. Safe from any thread.
class ShaderCompiler {
 public:
  /// At most this many files are kept; then those unused for longest go.
  static constexpr std::size_t kMaxFiles = 512;

  ShaderCompiler();  ///< in cacheDirectory()
  /// An empty `directory` keeps nothing.
  explicit ShaderCompiler(std::filesystem::path directory);

  struct Result {
    std::vector<std::uint32_t> spirv;  ///< for Vulkan 1.3, entry `main`
    bool compiled = false;             ///< false: it was on disk
  };

  /// Optimised (shader_optimizer.h). From disk 0.1 ms. Compiled and optimised 1 ms and more with the size,
  /// exact shaders 100 to 200 ms; the first one of a process 65 to 90 ms longer. Throws Error(Scene) with
  /// every message of the compiler, its file, line and the line itself.
  [[nodiscard]] Result compile(const ShaderDesc& desc) const;

 private:
  std::filesystem::path directory_;
};

}  // namespace luxo::gpu
