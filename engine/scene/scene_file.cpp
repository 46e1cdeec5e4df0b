// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_file.h"

#include <bit>

namespace luxo {

bool operator==(const Quantity& a, const Quantity& b) {
  if (a.isFormula() != b.isFormula()) return false;
  return a.isFormula() ? a.formula() == b.formula()
                       : std::bit_cast<std::uint64_t>(a.number()) == std::bit_cast<std::uint64_t>(b.number());
}

}  // namespace luxo
