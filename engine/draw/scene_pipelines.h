// SPDX-License-Identifier: Apache-2.0
// The pipelines of the scene passes, each made when a draw first needs it.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>

#include "draw/draw_state.h"
#include "draw/scene_layouts.h"
#include "draw/scene_programs.h"
#include "draw/view_targets.h"
#include "gpu/descriptor.h"
#include "gpu/pipeline.h"

namespace luxo {

/// Keeps what pictures use again and again. Of what the last two have not used it keeps the most recent, so
/// many bytes, or so many times as much as those two use, as pictures of one view's outputs take turns: a
/// formula that is edited would leave its pipelines behind for ever.
inline constexpr std::size_t kMaxIdlePipelineBytes = std::size_t{72} << 20, kMaxIdlePipelines = 3;

class ScenePipelines {
 public:
  explicit ScenePipelines(gpu::Context& context)
      : context_(&context), layouts_(context), programs_(context) {}

  /// A picture begins. Forgets what is too old, with the shaders that no pipeline has any more; the device
  /// may still be drawing with it.
  void beginPicture();

  /// What decides a pipeline: a draw, and what it draws to.
  struct Wanted {
    DrawState state;
    TargetFormat targets;

    friend auto operator<=>(const Wanted&, const Wanted&) = default;
  };

  [[nodiscard]] const gpu::GraphicsPipeline& get(const DrawState& state, const TargetFormat& targets);
  /// Makes those that are not made yet, on all cores.
  void prepare(std::span<const Wanted> wanted);
  [[nodiscard]] const gpu::DescriptorLayout& layout(SceneSet set) { return layouts_.get(set); }
  [[nodiscard]] VkSampler texelSampler();
  /// The shaders that materials have.
  [[nodiscard]] MaterialPrograms& programs() { return programs_.materials(); }

 private:
  struct Made {
    gpu::GraphicsPipeline pipeline;
    std::size_t bytes = 0;
    std::uint64_t lastPicture = 0;  ///< that used it
  };

  [[nodiscard]] static std::array<Wanted, 2> otherSearches(const Wanted& transversal);
  [[nodiscard]] gpu::GraphicsPipelineDesc describe(const Wanted& wanted);

  gpu::Context* context_;
  SceneLayouts layouts_;
  ScenePrograms programs_;
  gpu::Handle<VkSampler> texelSampler_;
  std::map<Wanted, Made> pipelines_;
  std::uint64_t picture_ = 0;
};

}  // namespace luxo
