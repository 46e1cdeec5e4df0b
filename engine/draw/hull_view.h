// SPDX-License-Identifier: Apache-2.0
// How the triangles of a hull are seen: most rays meet the surface once and steeply enough for a search of
// two steps; where they may graze it a longer search is needed.
#pragma once

#include <cstdint>

#include "scene/view.h"
#include "tessellate/hull.h"

namespace luxo {

enum class Seen { Away, Flat, Steep };

class HullView {
 public:
  /// Unless `tellApart` is set everything counts as steep.
  HullView(const View& view, const Transform& worldFromObject, bool tellApart);

  /// How the outer (+1) or inner (-1) side of the surface is seen near the triangle that begins at that
  /// index. Cost: nanoseconds.
  [[nodiscard]] Seen seen(const Hull& hull, std::uint32_t firstIndex, double side) const;

 private:
  Vec4 eye_{0};  ///< homogeneous, object space: a direction for parallel rays
  bool tellApart_;
};

}  // namespace luxo
