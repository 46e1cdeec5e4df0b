// SPDX-License-Identifier: Apache-2.0
// What C++ and shaders share lies in memory alike: where C++ has it, and where the compiler of shaders does.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "gpu/shader_reflection.h"
#include "luxo/shaders/sources.h"
#include "shared/cloth_data.h"
#include "shared/flat_pattern.h"
#include "shared/scene_data.h"

namespace luxo::shared {
namespace {

struct SharedStruct {
  std::string header, name, last;
  std::size_t size, lastOffset;
};

#define LUXO_SHARED(header, type, last) \
  SharedStruct { header, #type, #last, sizeof(type), offsetof(type, last) }

/// One in each: a struct of the header, as it is in a buffer.
gpu::ShaderBlock blockOf(const SharedStruct& shared) {
  const std::string text = fmt::format(
      "#version 460\n#extension GL_GOOGLE_include_directive : require\n#include \"shared/{}\"\n"
      "layout(scalar, set = 0, binding = 0) buffer Block {{ {} all[]; }};\nvoid main() {{}}\n",
      shared.header, shared.name);
  const gpu::ShaderCompiler compiler("");
  return gpu::reflect(
             compiler
                 .compile(
                     {.source = {"shared.frag", text}, .includes = kShaderSources, .forReflection = true})
                 .spirv)
      .blocks.at(0);
}

// A member that C++ aligns otherwise than shaders do, or a type of another width, moves the last member or
// the next struct.
TEST(SharedData, LiesInMemoryAlikeForCppAndShaders) {
  const std::vector<SharedStruct> all = {LUXO_SHARED("scene_data.h", ViewData, occlusionRadius),
                                         LUXO_SHARED("scene_data.h", InstanceData, domain),
                                         LUXO_SHARED("scene_data.h", MaterialData, leastOpaque),
                                         LUXO_SHARED("scene_data.h", LightData, inverseSquare),
                                         LUXO_SHARED("scene_data.h", ExactInstance, shellDepthLow),
                                         LUXO_SHARED("scene_data.h", ExactPatch, firstParameter),
                                         LUXO_SHARED("scene_data.h", ShellDraw, guard),
                                         LUXO_SHARED("scene_data.h", RayTarget, guard),
                                         LUXO_SHARED("scene_data.h", ShadeData, number),
                                         LUXO_SHARED("scene_data.h", SpotData, perPenumbra),
                                         LUXO_SHARED("scene_data.h", LightSet, spots),
                                         LUXO_SHARED("scene_data.h", CasterCell, bendsAway),
                                         LUXO_SHARED("scene_data.h", FlatShadow, transmittance),
                                         LUXO_SHARED("scene_data.h", LightMapFace, origin),
                                         LUXO_SHARED("scene_data.h", LightMap, radius),
                                         LUXO_SHARED("scene_data.h", GridEntry, nearest),
                                         LUXO_SHARED("scene_data.h", ShadowCaster, firstPatternParameter),
                                         LUXO_SHARED("scene_data.h", ClosedCaster, material),
                                         LUXO_SHARED("scene_data.h", MeshPlace, material),
                                         LUXO_SHARED("scene_data.h", ShownPoint, numberOfMaterial),
                                         LUXO_SHARED("scene_data.h", TraceRay, from),
                                         LUXO_SHARED("scene_data.h", ShaderFaults, manyTraces),
                                         LUXO_SHARED("scene_data.h", TraceQuestion, position),
                                         LUXO_SHARED("scene_data.h", TraceAnswer, inside),
                                         LUXO_SHARED("scene_data.h", LayerPoint, triangle),
                                         LUXO_SHARED("scene_data.h", LayerDetail, frame),
                                         LUXO_SHARED("scene_data.h", ReachingLight, transmittance),
                                         LUXO_SHARED("flat_pattern.h", FlatPattern, tintsLight),
                                         LUXO_SHARED("cloth_data.h", ClothData, gravity)};
  for (const SharedStruct& shared : all) {
    const gpu::ShaderBlock block = blockOf(shared);
    ASSERT_EQ(block.members.size(), 1U) << shared.name;
    EXPECT_EQ(block.members[0].arrayStride, shared.size) << shared.name;
    const auto last = std::ranges::find(block.members[0].members, shared.last, &gpu::ShaderVariable::name);
    ASSERT_NE(last, block.members[0].members.end()) << shared.name << " has no " << shared.last;
    EXPECT_EQ(last + 1, block.members[0].members.end())
        << shared.last << " is not the last of " << shared.name;
    EXPECT_EQ(last->offset, shared.lastOffset) << shared.name << "::" << shared.last;
  }
}

#undef LUXO_SHARED

}  // namespace
}  // namespace luxo::shared
