// SPDX-License-Identifier: Apache-2.0
// The surfaces that most programs are made of, as C++ functions; surface/catalogue.h has these and all others
// by name. Each is one formula; u and v run over the unit square. Axes along +Y. u runs around the axis from
// +X toward -Z (right-handed about +Y), v along the axis or outward. Lengths in metres, from 1e-12 to 1e12;
// others throw Error(Scene).
#pragma once

#include "math/animated.h"
#include "surface/surface.h"

namespace luxo {

/// (x (u - 1/2), 0, -z (v - 1/2)): centred on the origin, normal +Y.
[[nodiscard]] Surface rectangle(double sizeX, double sizeZ);

/// Radius r: r v (cos 2 pi u, 0, -sin 2 pi u), normal +Y, pole at the centre. Su x Sv points down:
/// orientation -1.
[[nodiscard]] Surface disk(double radius);

/// (r cos 2 pi u, h v, -r sin 2 pi u): rises from the origin, open at both ends, outward normals.
[[nodiscard]] Surface cylinder(double radius, double height);

/// As the cylinder with radius r + (top - r) v. A radius of 0 at one end makes an apex there (both: an
/// error).
[[nodiscard]] Surface cone(double radius, double topRadius, double height);

/// Latitude pi (v - 1/2): v = 0 is the south pole (0, -r, 0). Centred on the origin.
[[nodiscard]] Surface sphere(double radius);

/// y = (x^2 + z^2) / 4f from the vertex at the origin up to `height`, with distance from the axis
/// proportional to v. Su x Sv points to the outer, convex side. Area (8 pi f^2 / 3) ((1 + h/f)^(3/2) - 1).
[[nodiscard]] Surface paraboloid(double focalLength, double height);

/// Ring radius `major` around Y, tube radius `minor`; major > minor. Centred on the origin.
[[nodiscard]] Surface torus(double major, double minor);

/// The lecture's flag: (W u, H v, D sin(K u + phase)); Su x Sv = H (-K D cos(K u + phase), 0, W).
struct FlagDesc {
  double width = 3, height = 2, depth = 0.2, waves = 8;  ///< W, H, D in metres; K in radians over the width
  Animated<double> phase = 0;                            ///< radians
};
[[nodiscard]] Surface flag(const FlagDesc& desc = {});

}  // namespace luxo
