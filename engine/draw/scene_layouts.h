// SPDX-License-Identifier: Apache-2.0
// The descriptor sets that the scene's shaders read: which buffers and textures, by the numbers of
// shared/bindings.h. They are written down here, not made by reflection: sets of one number differ between
// kinds of passes, and which offsets are dynamic no shader says. That shaders find all they read in them is
// checked by reflection (gpu/pipeline.h).
#pragma once

#include <array>
#include <cstddef>

#include "draw/draw_state.h"
#include "gpu/descriptor.h"

namespace luxo {

enum class SceneSet {
  Scene,         ///< view, instances, lights, materials
  Pattern,       ///< parameters of patterns
  Texture,       ///< and texels
  FoundTexture,  ///< and the footprints and frames of what was found
  Exact,         ///< shells: instances, patches, parameters, feedback
  Found,         ///< what was found, and what light reaches it
  Shadow,        ///< casters: grids, cells, parameters, doubts
  Layers,        ///< what is seen through
};
inline constexpr std::size_t kSceneSets = 8;

class SceneLayouts {
 public:
  explicit SceneLayouts(gpu::Context& context) : context_(&context) {}

  /// Made when first asked for.
  [[nodiscard]] const gpu::DescriptorLayout& get(SceneSet set);
  /// Of the sets of a draw, in the order of their numbers.
  [[nodiscard]] gpu::SetLayouts of(const DrawState& state);

 private:
  gpu::Context* context_;
  std::array<gpu::DescriptorLayout, kSceneSets> layouts_;
};

}  // namespace luxo
