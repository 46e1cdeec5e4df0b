// SPDX-License-Identifier: Apache-2.0
// How the triangles of a shell are seen: most rays meet the surface once and steeply enough for a search of
// two steps; where they may graze it a longer search is needed.
#pragma once

#include <cstdint>

#include "math/vec.h"
#include "shell/shell.h"

namespace luxo {

class ShellView {
 public:
  /// Certain: transversal, and rays are so steep that what most of them meet is proven to be the first
  /// without a walk.
  enum class Seen { Grazing, Transversal, Certain };

  /// `eye`: homogeneous, object space; w = 0: the direction toward it, for parallel rays. Unless `tellApart`
  /// is set all is grazing.
  ShellView(const Vec4& eye, bool tellApart);

  /// How all rays through the triangle that begins at that index see the outer (+1) or inner (-1) side of the
  /// surface. Cost: nanoseconds.
  [[nodiscard]] Seen seen(const Shell& shell, std::uint32_t firstIndex, double side) const;

 private:
  Vec4 eye_;
  bool tellApart_;
};

}  // namespace luxo
