// SPDX-License-Identifier: Apache-2.0
// The pipelines of the scene passes, each made when a draw first needs it.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "draw/draw_list.h"
#include "draw/material_program.h"
#include "draw/view_targets.h"
#include "gpu/descriptor.h"
#include "gpu/pipeline.h"

namespace luxo {

/// Pushed to the vertex shaders of shells.
struct ShellDraw {
  float side = 1;   ///< of the surface that these triangles lead to: +1 front, -1 back
  float guard = 1;  ///< how many times as large as the picture the viewport is
};

/// Whether draws of this state read the mesh's surface parameters.
[[nodiscard]] bool readsParameters(const DrawState& state);

/// Keeps what pictures use again and again. Of what the last two have not used it keeps the most recent, so
/// many bytes, or so many times as much as those two use, as pictures of one view's outputs take turns: a
/// formula that is edited would leave its pipelines behind for ever.
inline constexpr std::size_t kMaxIdlePipelineBytes = std::size_t{64} << 20, kMaxIdlePipelines = 3;

class ScenePipelines {
 public:
  explicit ScenePipelines(gpu::Context& context);

  /// A picture begins. Forgets what is too old, with the shaders that no pipeline has any more; the device
  /// may still be drawing with it.
  void beginPicture();

  [[nodiscard]] const gpu::GraphicsPipeline& get(const DrawState& state, const TargetFormat& format);
  /// Makes those of the states that are not made yet, on all cores.
  void prepare(std::span<const DrawState> states, const TargetFormat& format);
  /// Set 0 of every pipeline: view, instances, lights (shared/scene_data.h).
  [[nodiscard]] const gpu::DescriptorLayout& sceneLayout() const { return sceneLayout_; }
  /// Set 1 of pipelines with a pattern: the parameters. Made when first asked for.
  [[nodiscard]] const gpu::DescriptorLayout& patternLayout();
  /// The same with a texture: and the texels; where it lights what was found, and the footprints there.
  [[nodiscard]] const gpu::DescriptorLayout& textureLayout();
  [[nodiscard]] const gpu::DescriptorLayout& foundTextureLayout();
  /// Set 2 of pipelines that find the surface: exact instances, patches, parameters, feedback. Made when
  /// first asked for.
  [[nodiscard]] const gpu::DescriptorLayout& exactLayout();
  /// Set 2 of pipelines that light what was found: its texels, parameters, materials, places. Made when first
  /// asked for.
  [[nodiscard]] const gpu::DescriptorLayout& foundLayout();
  /// Set 1 of pipelines that find shadows: casters, grids, cells, parameters, doubts. Made when first asked
  /// for.
  [[nodiscard]] const gpu::DescriptorLayout& shadowLayout();
  [[nodiscard]] const gpu::DescriptorLayout& layersLayout();
  [[nodiscard]] VkSampler texelSampler();
  /// The shaders that materials have.
  [[nodiscard]] MaterialPrograms& programs() { return programs_; }

 private:
  struct Made {
    gpu::GraphicsPipeline pipeline;
    std::size_t bytes = 0;
    std::uint64_t lastPicture = 0;  ///< that used it
  };

  void forgetShaders();
  /// Set 1 of a state: of any paint; of none that of patterns.
  [[nodiscard]] const gpu::DescriptorLayout& paintLayout(const DrawState& state);
  [[nodiscard]] gpu::GraphicsPipelineDesc describe(const DrawState& state, const TargetFormat& format);
  /// The fragment shader of that name below shaders/pattern, made for the state's pattern.
  [[nodiscard]] const std::vector<std::uint32_t>& patternShader(const DrawState& state,
                                                                std::string_view name);

  /// Has the fragment shaders that find these states' surfaces, with their patterns or without.
  void compileExactShaders(std::span<const DrawState> states);
  void describeExact(const DrawState& state, const TargetFormat& format, gpu::GraphicsPipelineDesc& desc);
  void describeMesh(const DrawState& state, gpu::GraphicsPipelineDesc& desc);
  void describeAgain(const DrawState& state, gpu::GraphicsPipelineDesc& desc);
  /// The fragment shader that finds what it does where rays meet the cells of the state's surface.
  [[nodiscard]] std::span<const std::uint32_t> casterShader(const DrawState& state) const;
  void describeCaster(const DrawState& state, gpu::GraphicsPipelineDesc& desc) const;
  void describeOpenness(gpu::GraphicsPipelineDesc& desc);
  void describeShade(const DrawState& state, gpu::GraphicsPipelineDesc& desc);
  void describePlaces(const DrawState& state, gpu::GraphicsPipelineDesc& desc);
  void describeShadow(const DrawState& state, gpu::GraphicsPipelineDesc& desc);
  void describeLightDepth(gpu::GraphicsPipelineDesc& desc);
  void describeLayers(const DrawState& state, gpu::GraphicsPipelineDesc& desc);

  gpu::Context* context_;
  gpu::DescriptorLayout sceneLayout_, patternLayout_, textureLayout_, foundTextureLayout_, exactLayout_,
      foundLayout_, shadowLayout_, layersLayout_;
  gpu::Handle<VkSampler> texelSampler_;
  /// Grazing; what it does with what it finds; whether it tells footprints, and frames.
  using ExactShaderKey = std::tuple<SurfaceCodePtr, Paint, bool, Form, bool, bool>;
  std::map<ExactShaderKey, std::vector<std::uint32_t>> exactShaders_;
  /// Whether vertices have tangents.
  std::map<std::tuple<Paint, std::string_view, bool>, std::vector<std::uint32_t>> patternShaders_;
  std::map<std::pair<DrawState, TargetFormat>, Made> pipelines_;
  MaterialPrograms programs_;
  std::uint64_t picture_ = 0;
};

}  // namespace luxo
