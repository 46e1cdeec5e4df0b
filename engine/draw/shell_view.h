// SPDX-License-Identifier: Apache-2.0
// How the triangles of a shell are seen: most rays meet the surface once and steeply enough for a search of
// two steps; where they may graze it a longer search is needed.
#pragma once

#include <cstdint>

#include "scene/view.h"
#include "tessellate/shell.h"

namespace luxo {

enum class Seen { Away, Transversal, Grazing };

class ShellView {
 public:
  /// Unless `tellApart` is set everything counts as grazing.
  ShellView(const View& view, const Transform& worldFromObject, bool tellApart);

  /// How the outer (+1) or inner (-1) side of the surface is seen near the triangle that begins at that
  /// index. Cost: nanoseconds.
  [[nodiscard]] Seen seen(const Shell& shell, std::uint32_t firstIndex, double side) const;

 private:
  Vec4 eye_{0};  ///< homogeneous, object space: a direction for parallel rays
  bool tellApart_;
};

}  // namespace luxo
