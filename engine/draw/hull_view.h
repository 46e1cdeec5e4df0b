// SPDX-License-Identifier: Apache-2.0
// How the triangles of a hull are seen: most rays meet the surface once and steeply enough for a search of
// two steps; where they may graze it a longer search is needed.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/view.h"
#include "tessellate/hull.h"

namespace luxo {

enum class Seen { Flat, Steep };

class HullView {
 public:
  /// Unless `tellApart` is set everything counts as steep.
  HullView(const View& view, const Transform& worldFromObject, bool tellApart);

  /// Appends the indices of those of the triangles near which the outer (+1) or inner (-1) side of the
  /// surface is seen that way. Where that side faces away it is not seen. Cost: nanoseconds a triangle.
  void append(const Hull& hull, std::uint32_t firstIndex, std::uint32_t count, double side, Seen seen,
              std::vector<std::uint32_t>& indices) const;

 private:
  Vec4 eye_{0};  ///< homogeneous, object space: a direction for parallel rays
  bool tellApart_;
};

}  // namespace luxo
