// SPDX-License-Identifier: Apache-2.0
// Why a pixel looks as it does: every point of every surface on its ray, and what each light does there, in
// double precision, by the ground truth's own rays.
//
//     const ExplainedPixel why = explainPixel(snapshot, {312.5, 88.5});
//     if (!why.points.empty()) print(snapshot.nodes[why.points[0].node].number, why.points[0].parameters);
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/snapshot.h"
#include "surface/curvature.h"

namespace luxo {

/// A light at a point. One with a radius is the sum of its points (SnapshotLight): directions and distances
/// are of their middle.
struct LightOnPoint {
  NodeId light;
  Vec3 toward{0};       ///< unit
  double distance = 0;  ///< metres; infinite of directional ones
  double cosine = 0;    ///< between `toward` and the normal that is lit
  Vec3 radiance{0};     ///< scene-linear RGB that arrives there where nothing stands before it
  Vec3 arriving{0};     ///< that does arrive: as shaders are told, from behind, too
  Vec3 unshadowed{0};   ///< scene-linear RGB that it would add where nothing stands before it
  Vec3 share{0};        ///< that it adds
  Vec3 visibility{0};   ///< the part of it that gets there, 0 to 1; 0 where it is behind the surface
  bool faces = false;   ///< it is before the surface, not behind
  double cone = 1;      ///< the part of it that its cone sends there, 0 to 1: 1 of what is no spot
  std::uint32_t points = 0;
  bool shadows = false;   ///< something may stand before it: it has a shadow
  bool certified = true;  ///< the shadow is proven, of every point
};

struct PointOnRay {
  std::uint32_t node = 0;   ///< index into Snapshot::nodes
  std::uint32_t patch = 0;  ///< of a formula
  Vec2 parameters{0};       ///< (u, v)
  Vec3 position{0};         ///< world: S(u, v); of triangles where the ray meets them
  Vec3 positionObject{0};
  double depth = 0, distance = 0;  ///< metres: along the view axis, along the ray
  /// Unit, in the world: of the surface itself, outward (of triangles the triangle's own); and the one that
  /// is lit, toward the viewer where two-sided (of triangles interpolated).
  Vec3 outward{0}, lit{0};
  bool front = true;                             ///< seen from the side that `outward` points to
  std::optional<PrincipalCurvatures> curvature;  ///< in the world; nothing at poles, of triangles
  std::optional<double> residualPx;  ///< from the pixel's place to where S(u, v) is drawn; of formulas
  bool seen = true;                  ///< nothing opaque is before it
  bool certified = true;             ///< that it is there, and that nothing else is before it
  // Of points that are seen:
  Vec3 diffuse{0};
  double opacity = 1;
  Vec3 ambient{0};                   ///< what the ambient light adds
  std::vector<LightOnPoint> lights;  ///< in the order of their nodes
  Vec3 reflected{0};                 ///< the sum
};

struct ExplainedPixel {
  Vec2 at{0};                           ///< pixel coordinates (scene/view.h)
  Vec3 origin{0}, direction{0, 0, -1};  ///< of the ray, in the world
  Vec3 color{0};                        ///< scene-linear: what is seen, over the background
  bool certified = true;                ///< hits, misses and shadows of what is seen are proven
  /// All of them within the view's range, by distance: what is behind an opaque one, too, as if it were not
  /// there. Back faces that a material does not show are not among them.
  std::vector<PointOnRay> points;
};

/// Shadows are the exact ones, and points of materials that are drawn otherwise (toon, wireframe) are told as
/// lit.
/// Cost: the cells of surfaces that have no closed form, some rays.
[[nodiscard]] ExplainedPixel explainPixel(const Snapshot& snapshot, const Vec2& at);

}  // namespace luxo
