// SPDX-License-Identifier: Apache-2.0
// What the scene's pipelines ask of a device is what is looked at when it is chosen.
#include "draw/scene_layouts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "draw/scene_programs.h"
#include "gpu/device.h"
#include "support/gpu_fixture.h"
#include "support/spirv.h"
#include "surface/caster_code.h"
#include "surface/catalogue.h"

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

// Of the fragments that write most: points of formulas with all that lights them later, what is seen through,
// and, of each, the faults of a material's shader.
TEST_F(SceneLayoutsTest, AFragmentWritesNoMoreThanDevicesAreAskedFor) {
  using enum Form;
  SurfaceCodes codes;
  const Surface surface = makeSurface("klein");
  const SurfaceCodePtr formula = codes.get(surface.patches()[0].function, 0),
                       caster = casterCode(codes, surface, {}).code;
  const auto shaded = [](const std::string& text) {
    return Paint::of(
        {.shader = std::make_shared<const MaterialShader>(MaterialShader{{{"test.frag", text}}})});
  };
  const Paint clear = shaded("#pragma luxo opacity\nvec4 material(Point p) { return vec4(p.normal, 0.5); }"),
              mirror = shaded("vec4 material(Point p) { return vec4(trace(p.normal).color, 1.0); }");
  std::vector<DrawState> states = {
      {.form = Fused, .pattern = clear, .surface = formula, .grazing = true},
      {.form = FoundWithParameters,
       .pattern = clear,
       .footprint = true,
       .frame = true,
       .surface = formula,
       .grazing = true},
      {.form = FoundWithParameters, .footprint = true, .frame = true, .byRays = true},
      {.form = Shade, .pattern = mirror, .shadows = true},
      {.form = ShadeLayers, .pattern = clear},
      {.form = BlendLayers},
      {.output = Output::Depth, .form = BlendLayers},
      {.form = LayersByRays, .details = true},
      {.shading = Shading::Gouraud, .form = LayerAgain},
      {.form = LayerLightMap}};
  for (const Form form :
       {MeshPlace, LayerPlace, Shadow, Transmittance, LayerShadow, LayerTransmittance, Layer})
    states.push_back({.form = form, .details = form == Layer, .surface = caster});
  ScenePrograms programs(context());
  programs.prepare(states);
  std::size_t most = 0;
  for (const DrawState& state : states) most = std::max(most, outputsOf(programs.of(state).fragment));
  EXPECT_EQ(most, gpu::kFragmentOutputs);
}

}  // namespace
}  // namespace luxo::test
