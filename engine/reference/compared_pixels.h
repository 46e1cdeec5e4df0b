// SPDX-License-Identifier: Apache-2.0
// A picture and the truth of it, pixel by pixel: what both say of a place, for those who judge it.
#pragma once

#include <cstdint>
#include <optional>

#include "reference/caster.h"
#include "reference/layers.h"
#include "reference/verification.h"

namespace luxo::reference {

/// Pixels are row * width + column. Reads all that it is made of, which must outlive it; safe from any
/// thread.
class ComparedPixels {
 public:
  ComparedPixels(const Snapshot& snapshot, const ReferencePicture& truth, const MeasuredPicture& measured,
                 const VerificationOptions& options);

 protected:
  [[nodiscard]] static Vec3 valueAt(const Image& image, std::uint32_t i);
  [[nodiscard]] Vec2 centerOf(std::uint32_t i) const;
  [[nodiscard]] Vec2 parametersAt(std::uint32_t i) const { return Vec2(valueAt(measured_.uv, i)); }
  [[nodiscard]] const Surface& surfaceOf(std::uint32_t node) const { return snapshot_.nodes[node].surface; }
  [[nodiscard]] const Material& materialOf(std::uint32_t node) const {
    return snapshot_.materials[snapshot_.nodes[node].material.index];
  }
  [[nodiscard]] Shading shadingOf(std::uint32_t node) const {
    return materialOf(node).shadingIn(options_.shading);
  }
  /// Whether a pixel shows a mesh whose colours the truth does not have: of a formula, whose points are off,
  /// or triangles that are lit otherwise than at each of their points by itself.
  [[nodiscard]] bool isMesh(std::uint32_t i) const;
  /// In exact shading: other ones have colours of their own.
  [[nodiscard]] bool showsTexture(std::uint32_t i) const;
  /// Of no mesh, and one colour but for the light: a pattern's, in floats, may jump where that of doubles
  /// does not.
  [[nodiscard]] bool showsPlainColor(std::uint32_t i) const;

  /// The point that a pixel shows of a node, near to what is seen there.
  [[nodiscard]] std::optional<Place> shownAt(std::uint32_t i, std::uint32_t node) const;
  /// The truth of a pixel that shows a surface.
  [[nodiscard]] Place seenAt(std::uint32_t i) const;
  /// Whether what a ray sees first, if anything, is of the layer that the truth of a pixel is of.
  [[nodiscard]] bool seesLayerOf(std::uint32_t i, const Hit* first, const Vec2& at) const;

  const Snapshot& snapshot_;
  const ReferencePicture& truth_;
  const MeasuredPicture& measured_;
  const VerificationOptions& options_;
  PixelSize size_;
  Layers layers_;
  bool hasLayers_;   ///< something is seen through
  bool hasShadows_;  ///< some light has one
};

}  // namespace luxo::reference
