// SPDX-License-Identifier: Apache-2.0
// What the scene's pipelines ask of a device is what is looked at when it is chosen.
#include "draw/scene_layouts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "gpu/device.h"
#include "support/gpu_fixture.h"

namespace luxo::test {
namespace {

using SceneLayoutsTest = GpuTest;

// Of the passes that read most: what is seen through, in the light of casters, found and painted.
TEST_F(SceneLayoutsTest, AStageReadsNoMoreThanDevicesAreAskedFor) {
  using enum SceneSet;
  const std::vector<std::vector<SceneSet>> passes = {
      {Scene, Texture, Exact}, {Scene, FoundTexture, Found, Layers}, {Scene, Shadow, Found, Layers}};
  SceneLayouts layouts(context());
  const auto countOf = [&](const std::vector<SceneSet>& sets, const std::vector<VkDescriptorType>& types) {
    std::uint32_t count = 0;
    for (const SceneSet set : sets)
      for (const gpu::DescriptorBinding& binding : layouts.get(set).bindings())
        count += (binding.stages & VK_SHADER_STAGE_FRAGMENT_BIT) != 0 &&
                 std::ranges::count(types, binding.type) > 0;
    return count;
  };
  std::uint32_t buffers = 0, textures = 0;
  for (const std::vector<SceneSet>& sets : passes) {
    buffers = std::max(buffers, countOf(sets, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}));
    textures = std::max(textures, countOf(sets, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                                 VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER}));
  }
  EXPECT_EQ(buffers, gpu::kStageStorageBuffers);
  EXPECT_LE(textures, 16U) << "all that Vulkan promises";
}

}  // namespace
}  // namespace luxo::test
