// SPDX-License-Identifier: Apache-2.0
// From a snapshot to the sorted list of what the picture needs. Nothing here needs a mesh: bounds come from
// formulas.
//
// Every skip is a proof: switching any of them off never changes a bit of the image, or, of back faces that
// are searched for, more than draw/options.h says. Margins cover what happens later in single precision:
// 2^-20 of the distance to the eye for vertices, 1/32 pixel for their snap to the raster.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/snapshot.h"

namespace luxo {

struct CullOptions {
  double tolerancePx = 0.5;  ///< how far a mesh may be from its surface on the screen
  int samples = 1;           ///< per pixel, 1 or 4, at Vulkan's standard positions plus View::sampleOffsetPx
  /// Of materials that do not say otherwise. Lines reach a pixel beyond their surface and hide nothing behind
  /// it.
  Shading shading = Shading::Exact;
  /// Materials are seen through in their holes alone (Material::seenThroughIn). Nothing is ever seen of one
  /// that is invisible().
  bool ofGeometry = false;
  bool frustum = true;   ///< skip nodes outside the picture
  bool small = true;     ///< skip nodes that cover no sample
  bool backface = true;  ///< skip what only turns its back to the viewer
  bool lights = true;    ///< skip lights that cannot reach a node
};

/// One node to draw.
struct VisibleNode {
  std::uint32_t node = 0;  ///< index into Snapshot::nodes
  /// How far a mesh may deviate, metres of object space: eps = tau z / (f sqrt(1 + tan^2 phi) + tau) /
  /// stretch, z the nearest depth, phi the angle off axis (accuracy bound of a perspective image);
  /// orthographic: tau / f / stretch.
  double toleranceObject = 0;
  double nearestDepth = 0;   ///< lower bound of the depth of any point, clamped to the near plane
  double farthestDepth = 0;  ///< upper bound of the depth of any point; infinite without finite bounds
  double centerDepth = 0;    ///< depth of the centre of the bounds
  double pixelsPerUnit = 0;  ///< f sqrt(1 + tan^2 phi), at depth 1; orthographic: pixels per metre
  double stretch = 1;        ///< metres of the world per metre of the object, at most
  std::uint32_t firstLight = 0, lightCount = 0;  ///< range of VisibleList::lights
  bool mirrored = false;                         ///< the transform turns counter-clockwise into clockwise
  bool twoSided = false;                         ///< the normal turns toward the viewer
  bool hideBackFaces = false;                    ///< the material says so
  /// Closed, opaque, and seen from outside: if it also bounds a solid (boundsSolid()), front faces hide its
  /// back faces.
  bool closedFromOutside = false;
};

struct CullCounts {
  std::uint32_t nodes = 0;  ///< with a surface, visible in the scene
  std::uint32_t drawn = 0;
  std::uint32_t culledFrustum = 0, culledSmall = 0, culledBackface = 0;
  std::uint32_t culledLights = 0;  ///< pairs of a drawn node and a light that cannot reach it

  friend bool operator==(const CullCounts&, const CullCounts&) = default;
};

/// The order of what is opaque depends on the nodes' places alone, not on the order in which the scene was
/// put together; nodes in the very same place follow their numbers.
struct VisibleList {
  std::vector<VisibleNode> opaque;       ///< front to back by nearest depth
  std::vector<VisibleNode> transparent;  ///< as they are given
  std::vector<std::uint32_t> lights;     ///< indices into Snapshot::lights, ascending within a node
  CullCounts counts;
};

[[nodiscard]] VisibleList cull(const Snapshot& snapshot, const CullOptions& options = {});

/// Largest distance on the screen, in pixels, between a point of the surface and its stand-in `errorObject`
/// metres away: infinite when the stand-in could reach the eye.
[[nodiscard]] double boundPx(const View& view, const VisibleNode& visible, double errorObject);

}  // namespace luxo
