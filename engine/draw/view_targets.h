// SPDX-License-Identifier: Apache-2.0
// What the passes of a view write to, and read from each other.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "gpu/context.h"
#include "gpu/pipeline.h"
#include "gpu/texture.h"
#include "gpu/vk.h"

namespace luxo {

/// Precision of the linear picture: files take Full, which is exact to float; a window shows 8 bits and takes
/// Half.
enum class Precision { Full, Half };

/// Found: of deferred shading, the points that rays see (shaders/lib/found_texel.glsl), and, where a pattern
/// asks for them, their parameters, and, where a texture does, the footprint of their pixel, and, where a map
/// of normals does, their frame; Shadows: the lights, a bit each, that do not reach them; Places: of meshes
/// the points of their surfaces (shaders/lib/mesh_place_fragment.glsl); Transmittance: how much of one light
/// its casters let through; Openness: how much of the ambient light gets there; MoreLight: of
/// meshes that are drawn again, the light of more lights than the first; LightDepth: a light's depth map.
enum class Target {
  Color,
  Depth,
  Found,
  FoundParameters,
  FoundFootprint,
  FoundFrame,
  Places,
  Shadows,
  Transmittance,
  Openness,
  MoreLight,
  LightDepth
};

/// How a picture and its depths are stored.
struct PictureFormat {
  VkFormat color = VK_FORMAT_R32G32B32A32_SFLOAT;
  VkFormat depth = VK_FORMAT_D32_SFLOAT;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

[[nodiscard]] VkFormat formatOf(Target target, const PictureFormat& picture);

/// What a pipeline has to know of the targets that it draws to.
struct TargetFormat {
  /// In the order of the fragment shader's outputs. The rest have no format.
  std::array<gpu::ColorAttachment, 4> colors;
  VkFormat depth = VK_FORMAT_UNDEFINED;  ///< undefined: there is none
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;

  friend auto operator<=>(const TargetFormat&, const TargetFormat&) = default;
};

class ViewTargets {
 public:
  ViewTargets(gpu::Context& context, Precision precision);

  /// Makes those that a picture of this size needs, and has none of yet.
  struct Needs {
    bool deferred = false;  ///< Found, FoundParameters
    bool footprints = false, frames = false;
    bool openness = false, moreLight = false;
    /// Shadows and Transmittance, a bit for each of so many (DrawList::shadowSlot()).
    std::uint32_t shadows = 0, transmittances = 0;
    bool places = false;         ///< with shadows; else there is one of a texel, to have something to bind
    VkExtent2D lightDepth = {};  ///< none: there is no map
  };
  void prepare(VkExtent2D extent, VkSampleCountFlagBits samples, const Needs& needs);

  /// `slot`: which of them, of shadows and what is let through.
  [[nodiscard]] gpu::Texture& texture(Target target, std::size_t slot = 0);
  /// What Color is averaged into at the end of a pass; null without multisampling.
  [[nodiscard]] gpu::Texture* resolved() { return resolved_ ? &resolved_ : nullptr; }
  /// Scene-linear RGBA, one sample, row 0 at the top.
  [[nodiscard]] gpu::Texture& picture() { return resolved_ ? resolved_ : color_; }

  [[nodiscard]] VkExtent2D extent() const { return color_.extent(); }
  [[nodiscard]] const PictureFormat& format() const { return format_; }
  /// Of a picture with so many samples.
  [[nodiscard]] PictureFormat format(VkSampleCountFlagBits samples) const {
    PictureFormat format = format_;
    format.samples = samples;
    return format;
  }
  /// How many times as large as the picture the viewport is, where the device allows. Triangles that reach
  /// past a viewport are cut into slivers, of which a CPU device rounds the slopes: a tenth of a pixel is
  /// lost of what a mesh interpolates. Those that leave the picture by less than half of it are not cut.
  [[nodiscard]] float guard() const;

 private:
  void makePicture(VkExtent2D extent);
  void makeLightDepth(VkExtent2D extent);

  gpu::Context* context_;
  PictureFormat format_;
  gpu::Texture color_, resolved_, depth_, found_, foundParameters_, foundFootprint_, foundFrame_, places_,
      openness_, moreLight_, lightDepth_;
  std::vector<gpu::Texture> shadows_, transmittances_;  ///< by slot
};

}  // namespace luxo
