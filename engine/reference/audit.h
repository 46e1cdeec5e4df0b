// SPDX-License-Identifier: Apache-2.0
// Whether a pixel shows what its ray sees: hit or miss, the layer, the point, told by the depth it shows; and
// whether in the right light.
//
// A pixel is right where the truth shows that depth within kPointPx of its centre, and where an outline (a
// border, a fold, another layer, another node) passes within kSilhouettePx: there it may be on either side
// (verification.h).
#pragma once

#include <cstdint>
#include <span>

#include "reference/caster.h"

namespace luxo::reference {

enum class Judgement {
  Right,
  Wrong,
  Undecided  ///< by the truth
};

/// Of the point of the picture plane at `pixel` (pixel coordinates, x right, y down), at which only `nodes`
/// (ascending, opaque) count and the picture shows `depth`: metres along the view axis, +infinity where it
/// shows none of them, known within `rounding` metres. What is moved sideways along a surface that faces the
/// eye is not seen: no depth tells it. Cost: a ray; some hundred where they disagree.
[[nodiscard]] Judgement judge(const Caster& caster, std::span<const std::uint32_t> nodes, const Vec2& pixel,
                              double depth, double rounding);

/// Whether a pixel that is right tells the truth of a light (index into Snapshot::lights): how much of it
/// reaches what is seen there. Right, too, where the light would add nothing, and where a border of the
/// shadow passes within kSilhouettePx. Cost: two rays; some hundred where they disagree.
[[nodiscard]] Judgement judgeShadow(const Caster& caster, std::span<const std::uint32_t> nodes,
                                    const Vec2& pixel, std::uint32_t light, const Vec3& reaching);

/// Whether a pixel whose points are right has the truth's colour, to 1/255 (of what is brighter than 1, of
/// it). Right, too, between the colours that are within kSilhouettePx, of both sides of outlines and of
/// shadows' borders; and where the truth does not know it that well, or does not decide it: of drawings and
/// other shadings than exact, of patterns, maps, shaders, of highlights so small that single precision moves
/// them, and of surfaces that touch, where either is seen. `shown`: scene-linear. `rounding`: of depths,
/// metres. Cost: a ray, and one to each light that has a shadow; where they disagree some eighty times that.
[[nodiscard]] Judgement judgeColor(const Caster& caster, const Vec2& pixel, const Vec3& shown,
                                   double rounding);

/// What a pixel shows of what is seen through: how many points, and the sum of their depths.
struct LayerSums {
  double count = 0, depths = 0;
};
/// Whether it shows all points of `nodes` (ascending; others count as what they are) in front of what is
/// opaque. `rounding`: of each depth, metres. Cost: as judge().
[[nodiscard]] Judgement judgeLayers(const Caster& caster, std::span<const std::uint32_t> nodes,
                                    const Vec2& pixel, const LayerSums& shown, double rounding);

}  // namespace luxo::reference
