// SPDX-License-Identifier: Apache-2.0
// A scene at one moment: flat, read-only, in double. Everything downstream reads this and never the scene.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/scene.h"
#include "scene/shade.h"
#include "scene/spot_cone.h"
#include "scene/view.h"

namespace luxo {

/// A visible node with a surface.
struct SnapshotNode {
  NodeId id;
  std::uint32_t number =
      0;  ///< from 1, in depth-first order over all nodes of the scene: what the `id` view shows
  Transform worldFromObject;
  Surface surface;
  std::vector<double> parameters;  ///< of the surface, at this moment
  Box boundsObject, boundsWorld;   ///< conservative
  MaterialId material;             ///< always valid
  std::optional<Segments> segments;
  Vec3 evened{1};  ///< factors by which the surface is larger than the scene's (draw/scale_normalization.h)

  /// Same node, same picture: surfaces compare by identity, numbers bit by bit.
  friend bool operator==(const SnapshotNode& a, const SnapshotNode& b);
};

/// Where a light with a radius is: its middle, as SnapshotLight has positions; metres, or of a directional
/// light radians.
struct WidePlace {
  Vec4 middle{0};
  double radius = 0;

  friend bool operator==(const WidePlace&, const WidePlace&) = default;
};

/// A light of a visible node; of one with a radius and exact shadows one of the points that stand for it,
/// which share its light evenly.
struct SnapshotLight {
  NodeId id;
  /// w = 1: position in the world. w = 0: unit direction toward the light, a point at infinity.
  Vec4 positionWorld{0};
  Vec3 radiance{0};  ///< color * intensity
  Light::Attenuation attenuation = Light::Attenuation::None;
  std::optional<SpotCone> cone = {};  ///< of a spot
  std::vector<NodeId> casters;        ///< of its shadow, ascending; none where it has no shadow
  std::optional<ShadeRule> shade;     ///< the closed form of its exact shadow, if there is one
  std::optional<NodeId> plane = {};   ///< what a planar shadow falls on: it is on nothing else
  /// Its shadow is that of a depth map, but of what is seen through, which is exact: of a light with a radius
  /// that has such casters from each of its points.
  std::optional<ShadowMapThen> map = {};
  std::uint32_t samples = 1;  ///< of one with a map and a radius: points that would stand for it
  /// Of each of these points, where they do: the place of the light, whose map they share.
  std::optional<WidePlace> pointOf = {};

  [[nodiscard]] bool directional() const { return positionWorld.w == 0; }
  /// From a point to the light, metres; of one at infinity the unit direction.
  [[nodiscard]] Vec3 from(const Vec3& pointWorld) const {
    return Vec3(positionWorld) - positionWorld.w * pointWorld;
  }
  /// How much of its light its cone leaves a point, which is not where the light is: 0 to 1.
  [[nodiscard]] double coneTo(const Vec3& pointWorld) const {
    return cone ? spotAttenuation(*cone, -from(pointWorld)) : 1;
  }
  [[nodiscard]] bool approximate() const { return plane || map; }
  [[nodiscard]] bool hasShadow() const { return !casters.empty(); }
  friend bool operator==(const SnapshotLight&, const SnapshotLight&) = default;
};

struct Snapshot {
  View view;
  std::vector<SnapshotNode> nodes;  ///< by ascending id
  /// In an order that depends on the lights alone, so that sums over lights round the same way however the
  /// scene was put together.
  std::vector<SnapshotLight> lights;
  std::vector<Material> materials;  ///< index = MaterialId
  Vec3 background{0}, ambient{0};
  BlendOrder blendOrder = BlendOrder::Exact;
  AmbientOcclusion ambientOcclusion = {};
  /// Colours, lights and shininesses that formulas made larger than the ranges (scene/ranges.h), and that
  /// were cut off there, so that no pixel leaves float's range.
  std::uint32_t cutNumbers = 0;

  /// Whether both make the same picture at the same quality. The time itself is not compared. Cost: linear.
  friend bool operator==(const Snapshot&, const Snapshot&) = default;
};

/// Evaluates the scene with its parameters' values then: one linear pass, parents before children. No id: the
/// scene's first camera, or where it has none fitCamera() (scene/fitted_camera.h) around the scene at its
/// default time (so that an animation does not make the camera breathe), which takes longer: of many moments,
/// fit it once. Throws Error(Scene) naming the node or camera, the value and the time: values that are not
/// finite, a zero axis with an angle, a bad camera, a shadow that is not supported yet (Light::Shadow).
/// `mostShadowSamples`: of any light (Light::shadowSamples), for those who want a picture soon.
[[nodiscard]] Snapshot takeSnapshot(const Scene& scene, double timeSeconds, PixelSize size,
                                    CameraId camera = {},
                                    std::uint32_t mostShadowSamples = kMaxShadowSamples);
[[nodiscard]] Snapshot takeSnapshot(const Scene& scene, double timeSeconds, PixelSize size,
                                    const Camera& camera,
                                    std::uint32_t mostShadowSamples = kMaxShadowSamples);

/// The same with exact shadows instead of those that are approximations or on some things only: what these
/// are held against.
[[nodiscard]] Snapshot withExactShadows(Snapshot snapshot);
/// The same with exact shadows instead of depth maps; planar ones stay on their plane alone.
[[nodiscard]] Snapshot withoutShadowMaps(Snapshot snapshot);
/// A snapshot's light, or all points together that stand for one whose shadow a map estimates.
struct WholeLight {
  SnapshotLight light;                  ///< of points that share a place the light there, with all they have
  std::optional<std::uint32_t> number;  ///< index into Snapshot::lights; nothing of points
  double radius = 0;                    ///< of what they stand for
};
/// By their first in Snapshot::lights.
[[nodiscard]] std::vector<WholeLight> wholeLights(const Snapshot& snapshot);
/// Of the lights, how many have such shadows.
[[nodiscard]] std::size_t approximateShadows(const Snapshot& snapshot);

/// A finite box: the surfaces' bounds, and where those are infinite their framing(). An orthographic view
/// clips what lies outside its depth range.
[[nodiscard]] Box framingOf(const Snapshot& snapshot);

}  // namespace luxo
