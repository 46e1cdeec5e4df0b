// SPDX-License-Identifier: Apache-2.0
#include "draw/shell_view.h"

#include <cmath>

#include "math/transform.h"

namespace luxo {
ShellView::ShellView(const View& view, const Transform& worldFromObject, bool tellApart)
    : tellApart_(tellApart) {
  const Mat3 objectFromWorld = glm::inverse(worldFromObject.linear);
  eye_ = view.perspective() ? Vec4(objectFromWorld * (view.eye - worldFromObject.translation), 1)
                            : Vec4(objectFromWorld * -view.forward(), 0);
  // A flattened object has no inside to look from.
  for (int i = 0; i < 4; ++i) tellApart_ = tellApart_ && std::isfinite(eye_[i]);
}

Seen ShellView::seen(const Shell& shell, std::uint32_t firstIndex, double side) const {
  const NormalCone& cone = shell.cones[firstIndex / 3];
  bool flat = tellApart_ && cone.sine <= 1, away = flat;
  for (std::uint32_t k = 0; k < 3 && (flat || away); ++k) {
    const Vec3 toEye = Vec3(eye_) - eye_.w * shell.positions[shell.indices[firstIndex + k]];
    const double height = side * glm::dot(Vec3(cone.axis), toEye), distance = glm::length(toEye);
    flat = flat && height > cone.sine * distance;
    away = away && height < -cone.sine * distance;
  }
  return away ? Seen::Away : flat ? Seen::Transversal : Seen::Grazing;
}

}  // namespace luxo
