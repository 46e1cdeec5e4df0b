// SPDX-License-Identifier: Apache-2.0
// The exact shadow of a paraboloid lamp shade on the light at its focus: no map, no rays, one dot product.
//
// A paraboloid of focal length f and height h has its rim at distance h + f from the focus (focus and
// directrix), so the rim is seen from the focus under cos = (h - f) / (h + f). A point X is lit iff it lies
// inside the paraboloid or (X - focus) . axis >= cosRim |X - focus|; the shade itself is always lit (its
// normals decide: it is convex, so none of it is between its wall and the focus).
#pragma once

#include <optional>

#include "math/transform.h"
#include "scene/ids.h"
#include "surface/surface.h"

namespace luxo {

/// World space, metres.
struct ShadeRule {
  NodeId caster;
  Vec3 vertex{0}, focus{0};
  Vec3 axis{0, 1, 0};  ///< unit, from the vertex through the focus to the opening
  double cosRim = 0;
  double focalLength = 0, height = 0;
  double scale = 1;  ///< metres of the world per metre of the shade

  friend bool operator==(const ShadeRule&, const ShadeRule&) = default;
};

/// The rule of a shade placed by a similarity, to a relative 1e-9. Nothing for any other transform: a sheared
/// or unevenly scaled paraboloid has no focus.
[[nodiscard]] std::optional<ShadeRule> shadeRule(const Paraboloid& paraboloid,
                                                 const Transform& worldFromShade, NodeId caster);

/// Whether the light at the focus reaches a point that is not on the shade itself. Decides right unless the
/// point is within a relative 1e-14 of the border.
[[nodiscard]] bool lit(const ShadeRule& rule, const Vec3& pointWorld);

}  // namespace luxo
