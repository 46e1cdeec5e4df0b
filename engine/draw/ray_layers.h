// SPDX-License-Identifier: Apache-2.0
// What is seen through where searches leave it open, by rays in double precision: all its points in a pixel,
// and the light that reaches them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "draw/ray_points.h"
#include "reference/caster.h"

namespace luxo {

/// Refers to what it is given.
class LayerRays {
 public:
  LayerRays(const reference::Caster& caster, const RayDraws& draws);

  struct LitPoint {
    reference::Hit hit;
    shared::LayerPoint point;
    std::vector<shared::ReachingLight> light;  ///< of all groups
  };
  /// Of one pixel.
  struct Seen {
    std::vector<LitPoint> found;
    std::vector<LitPoint> ofMeshes;  ///< which points these are no ray tells, but what reaches them
    bool certified = true;
  };
  /// From any thread. Cost: a ray through all there is, and one to each light from each point.
  [[nodiscard]] Seen look(const reference::Ray& ray, const Doubt& doubt) const;
  /// Those that look() casts toward lights.
  void appendRaysToLights(const Seen& seen, std::vector<reference::Ray>& rays) const;
  /// The points of a pixel, in the order of their ray.
  void append(const Seen& seen, PixelPlace pixel, RayPoints& points) const;

 private:
  [[nodiscard]] LitPoint lit(const reference::Hit& hit, const shared::LayerPoint& point, bool ofMesh,
                             bool& certified) const;
  /// The point of a surface that a mesh shows in a pixel: of triangles where the ray of the pixel meets them.
  [[nodiscard]] std::optional<reference::Hit> ofMesh(const shared::LayerPoint& point, std::uint32_t node,
                                                     const reference::Ray& ray,
                                                     const reference::Caster::Sight& sight) const;
  /// A point that its ray has found, as shaders know it.
  [[nodiscard]] shared::LayerPoint found(const LitPoint& point, float leastDepth) const;

  const reference::Caster& caster_;
  const RayDraws& draws_;
  double originDepth_ = 0;  // of what positions are relative to
};

}  // namespace luxo
