// SPDX-License-Identifier: Apache-2.0
// Runs when luxo is built: the exact fragment shaders of the named surfaces, made from their formulas, as a
// C++ table.
//
//     luxo_exact_shaders HEADER
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "gpu/shader_compiler.h"
#include "luxo/shaders/sources.h"
#include "surface/catalogue.h"
#include "surface/surface_code.h"

namespace luxo {
namespace {

using Words = std::vector<std::uint32_t>;

/// The GLSL of every function that a named surface is made of.
std::set<std::string> formulas() {
  std::set<std::string> texts;
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    for (const Patch& patch : surface.patches())
      texts.insert(surfaceCode(*patch.function, patch.constants.size()).glsl);
  }
  return texts;
}

/// Without names and without functions that nobody calls; what it computes stays as it is.
Words slimmed(const Words& words) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
  optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateCompactIdsPass());
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);  // here it would know nothing of scalar layouts
  Words result;
  if (!optimizer.Run(words.data(), words.size(), &result, options))
    throw Error(ErrorKind::Internal, "cannot slim a shader");
  return result;
}

void validate(const Words& words) {
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
  std::string messages;
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
    messages += fmt::format("\n{}", message);
  });
  spvtools::ValidatorOptions options;
  options.SetScalarBlockLayout(true);
  if (!tools.Validate(words.data(), words.size(), options))
    throw Error(ErrorKind::Internal, fmt::format("a shader is not valid:{}", messages));
}

Words compile(std::string_view formula) {
  std::vector<gpu::ShaderSource> sources(std::begin(kShaderSources), std::end(kShaderSources));
  sources.push_back({"surface", formula});
  const auto source = std::ranges::find(kShaderSources, "exact/surface.frag", &gpu::ShaderSource::name);
  const gpu::ShaderCompiler compiler{std::filesystem::path()};
  Words words = slimmed(compiler.compile({.source = *source, .includes = sources}).spirv);
  validate(words);
  return words;
}

std::string table() {
  std::string arrays, entries;
  int index = 0;
  for (const std::string& formula : formulas()) {
    arrays += fmt::format("inline constexpr std::uint32_t kExactSurface{}[] = {{\n", index);
    const Words words = compile(formula);
    for (std::size_t i = 0; i < words.size(); ++i)
      arrays += fmt::format("{},{}", words[i], i % 16 == 15 ? "\n" : "");
    arrays += "};\n";
    entries += fmt::format("    {{R\"luxo({})luxo\", kExactSurface{}}},\n", formula, index);
    ++index;
  }
  return fmt::format(
      "#pragma once\n#include <cstdint>\n#include <span>\n#include <string_view>\n\nnamespace luxo {{\n\n{}\n"
      "struct ExactSurfaceShader {{\n  std::string_view formula;\n  std::span<const std::uint32_t> "
      "spirv;\n}};\n\n"
      "/// By formula.\ninline constexpr ExactSurfaceShader kExactSurfaces[] = {{\n{}}};\n\n}}  // namespace "
      "luxo\n",
      arrays, entries);
}

}  // namespace
}  // namespace luxo

int main(int count, char** arguments) {
  try {
    if (count != 2) throw luxo::Error(luxo::ErrorKind::Usage, "give the header to write");
    const std::string header = luxo::table();
    std::ofstream file(arguments[1]);
    if (!(file << header).flush())
      throw luxo::Error(luxo::ErrorKind::Write, fmt::format("cannot write {}", arguments[1]));
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "luxo_exact_shaders: {}\n", error.what());
    return 1;
  }
}
