// SPDX-License-Identifier: Apache-2.0
#include "shell/shell_view.h"

#include <cmath>

namespace luxo {

ShellView::ShellView(const Vec4& eye, bool tellApart) : eye_(eye), tellApart_(tellApart) {
  // A flattened object has no inside to look from.
  for (int i = 0; i < 4; ++i) tellApart_ = tellApart_ && std::isfinite(eye_[i]);
}

ShellView::Seen ShellView::seen(const Shell& shell, std::uint32_t firstIndex, double side) const {
  const NormalCone& cone = shell.cones[firstIndex / 3];
  bool transversal = tellApart_ && cone.sine <= 1, certain = transversal;
  for (std::uint32_t k = 0; k < 3 && transversal; ++k) {
    const Vec3 toEye = Vec3(eye_) - eye_.w * shell.positions[shell.indices[firstIndex + k]];
    const double height = side * glm::dot(Vec3(cone.axis), toEye), distance = glm::length(toEye);
    transversal = height > cone.sine * distance;
    certain = certain && height > cone.certain * distance;
  }
  return !transversal ? Seen::Grazing : certain ? Seen::Certain : Seen::Transversal;
}

}  // namespace luxo
