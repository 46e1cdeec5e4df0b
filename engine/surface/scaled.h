// SPDX-License-Identifier: Apache-2.0
// A surface whose points are scaled axis by axis, as a formula of its own.
#pragma once

#include "surface/surface.h"

namespace luxo {

/// Every point times `scale`, which is positive; patches and parameters as they are, and the topology at the
/// values for which that of `surface` was found. Where `scale` are powers of two no point is rounded. Cost:
/// that of making the surface.
[[nodiscard]] Surface scaled(const Surface& surface, const Vec3& scale);

}  // namespace luxo
