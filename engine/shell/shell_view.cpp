// SPDX-License-Identifier: Apache-2.0
#include "shell/shell_view.h"

#include <algorithm>
#include <cmath>

namespace luxo {

ShellView::ShellView(const Vec4& eye, bool tellApart) : eye_(eye), tellApart_(tellApart) {
  // A flattened object has no inside to look from.
  for (int i = 0; i < 4; ++i) tellApart_ = tellApart_ && std::isfinite(eye_[i]);
}

bool ShellView::transversal(const Shell& shell, std::uint32_t firstIndex, double side) const {
  const NormalCone& cone = shell.cones[firstIndex / 3];
  const double steep = std::max(cone.sine, cone.certain);
  bool all = tellApart_ && cone.sine <= 1;
  for (std::uint32_t k = 0; k < 3 && all; ++k) {
    const Vec3 toEye = Vec3(eye_) - eye_.w * shell.positions[shell.indices[firstIndex + k]];
    all = side * glm::dot(Vec3(cone.axis), toEye) > steep * glm::length(toEye);
  }
  return all;
}

}  // namespace luxo
