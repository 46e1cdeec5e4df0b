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
  /// `eye`: homogeneous, object space; w = 0: the direction toward it, for parallel rays. Unless `tellApart`
  /// is set nothing counts as transversal.
  ShellView(const Vec4& eye, bool tellApart);

  /// Whether the outer (+1) or inner (-1) side of the surface is seen steeply by all rays through the
  /// triangle that begins at that index. Cost: nanoseconds.
  [[nodiscard]] bool transversal(const Shell& shell, std::uint32_t firstIndex, double side) const;

 private:
  Vec4 eye_;
  bool tellApart_;
};

}  // namespace luxo
