// SPDX-License-Identifier: Apache-2.0
#include "draw/hull_view.h"

#include <cmath>

#include "math/transform.h"

namespace luxo {
HullView::HullView(const View& view, const Transform& worldFromObject, bool tellApart)
    : tellApart_(tellApart) {
  const Mat3 objectFromWorld = glm::inverse(worldFromObject.linear);
  eye_ = view.perspective() ? Vec4(objectFromWorld * (view.eye - worldFromObject.translation), 1)
                            : Vec4(objectFromWorld * -view.forward(), 0);
  // A flattened object has no inside to look from.
  for (int i = 0; i < 4; ++i) tellApart_ = tellApart_ && std::isfinite(eye_[i]);
}

void HullView::append(const Hull& hull, std::uint32_t firstIndex, std::uint32_t count, double side, Seen seen,
                      std::vector<std::uint32_t>& indices) const {
  for (std::uint32_t i = firstIndex; i < firstIndex + count; i += 3) {
    const FacingCone& cone = hull.cones[i / 3];
    bool flat = tellApart_ && cone.sine <= 1, away = flat;
    for (std::uint32_t k = 0; k < 3 && (flat || away); ++k) {
      const Vec3 toEye = Vec3(eye_) - eye_.w * hull.positions[hull.indices[i + k]];
      const double height = side * glm::dot(Vec3(cone.axis), toEye), distance = glm::length(toEye);
      flat = flat && height > cone.sine * distance;
      away = away && height < -cone.sine * distance;
    }
    if (away || flat != (seen == Seen::Flat)) continue;
    const auto triangle = hull.indices.begin() + i;
    indices.insert(indices.end(), triangle, triangle + 3);
  }
}

}  // namespace luxo
