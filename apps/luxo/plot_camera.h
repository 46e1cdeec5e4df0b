// SPDX-License-Identifier: Apache-2.0
// Where a plot is seen from, so that the surface shows itself.
#pragma once

#include "scene/snapshot.h"

namespace luxo {

/// The direction, from what is seen, that shows most of the surfaces' area: what is hidden behind other parts
/// does not count, and what is seen at a slant of over 66 degrees counts in part. From above, and from
/// kFittedDirection unless another one shows noticeably more. Cost: 20 ms.
[[nodiscard]] Vec3 showingDirection(const Snapshot& snapshot);

/// Degrees about the Y axis, from +Z toward +X.
[[nodiscard]] double azimuthOf(const Vec3& direction);

}  // namespace luxo
