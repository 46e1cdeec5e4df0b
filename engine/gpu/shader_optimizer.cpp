// SPDX-License-Identifier: Apache-2.0
#include "gpu/shader_optimizer.h"

#include "base/error.h"

#include <fmt/format.h>
#include <spirv-tools/libspirv.h>
#include <spirv-tools/optimizer.hpp>

#include <cstddef>
#include <unordered_map>
#include <unordered_set>

namespace luxo::gpu {
namespace {

// Raised whenever the passes below change.
constexpr int kRevision = 1;

// What the stage before writes is read, or validation layers warn.
constexpr bool kKeepsInterface = true;

constexpr std::size_t kHeaderWords = 5;
constexpr std::uint32_t kOpName = 5, kOpFunction = 54, kDontInline = 2;

/// The function stays a function until CreateRemoveDontInlinePass(). GLSL's names end in "(" and the types of
/// arguments.
void keepWhole(std::vector<std::uint32_t>& words, std::string_view function) {
  std::uint32_t id = 0;
  for (std::size_t i = kHeaderWords; i < words.size() && words[i] >> 16 > 0; i += words[i] >> 16) {
    const std::uint32_t operation = words[i] & 0xffff;
    if (operation == kOpName) {
      const std::string_view name = reinterpret_cast<const char*>(&words[i + 2]);
      if (name.starts_with(function) && name.substr(function.size()).starts_with('(')) id = words[i + 1];
    } else if (operation == kOpFunction && words[i + 2] == id) {
      words[i + 3] |= kDontInline;
    }
  }
}

/// Functions become part of those that call them, and variables values.
void addInlining(spvtools::Optimizer& optimizer) {
  optimizer.RegisterPass(spvtools::CreateInlineExhaustivePass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreatePrivateToLocalPass())
      .RegisterPass(spvtools::CreateScalarReplacementPass(0))
      .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
      .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
      .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
      .RegisterPass(spvtools::CreateSSARewritePass())
      .RegisterPass(spvtools::CreateVectorDCEPass())
      .RegisterPass(spvtools::CreateDeadInsertElimPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass(kKeepsInterface))
      .RegisterPass(spvtools::CreateBlockMergePass());
}

std::vector<std::uint32_t> run(const spvtools::Optimizer& optimizer, std::span<const std::uint32_t> words) {
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);  // here it would know nothing of scalar layouts
  std::vector<std::uint32_t> result;
  if (!optimizer.Run(words.data(), words.size(), &result, options))
    throw Error(ErrorKind::Internal, "cannot optimise a shader");
  return result;
}

}  // namespace

std::vector<std::uint32_t> optimized(std::vector<std::uint32_t> words, std::string_view shared) {
  if (!shared.empty()) keepWhole(words, shared);
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
  optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass())
      .RegisterPass(spvtools::CreateWrapOpKillPass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateMergeReturnPass());
  addInlining(optimizer);
  optimizer.RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateIfConversionPass())
      .RegisterPass(spvtools::CreateRedundancyEliminationPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass(kKeepsInterface));
  if (!shared.empty()) {
    optimizer.RegisterPass(spvtools::CreateRemoveDontInlinePass());
    addInlining(optimizer);
  }
  optimizer.RegisterPass(spvtools::CreateCFGCleanupPass()).RegisterPass(spvtools::CreateCompactIdsPass());
  return run(optimizer, words);
}

ShaderStages stripped(std::span<const std::uint32_t> vertex, std::span<const std::uint32_t> fragment,
                      std::span<const SpecializationConstant> constants) {
  constexpr bool kRemovesOutputs = true;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
  for (const SpecializationConstant& constant : constants) values[constant.id] = {constant.bits};
  const auto addFreezing = [&](spvtools::Optimizer& optimizer) {
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass(!kKeepsInterface));
  };
  std::unordered_set<std::uint32_t> locations, builtIns;
  spvtools::Optimizer ofFragment(SPV_ENV_VULKAN_1_3), ofVertex(SPV_ENV_VULKAN_1_3);
  addFreezing(ofFragment);
  ofFragment.RegisterPass(spvtools::CreateAnalyzeLiveInputPass(&locations, &builtIns));
  ShaderStages stages{.fragment = run(ofFragment, fragment)};
  addFreezing(ofVertex);
  ofVertex.RegisterPass(spvtools::CreateEliminateDeadOutputStoresPass(&locations, &builtIns))
      .RegisterPass(spvtools::CreateAggressiveDCEPass(!kKeepsInterface, kRemovesOutputs));
  stages.vertex = run(ofVertex, vertex);
  return stages;
}

std::string optimizerVersion() { return fmt::format("{} {}", spvSoftwareVersionDetailsString(), kRevision); }

}  // namespace luxo::gpu
