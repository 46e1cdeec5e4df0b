// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_file.h"

#include "math/bits.h"

namespace luxo {

bool operator==(const Quantity& a, const Quantity& b) {
  if (a.isFormula() != b.isFormula()) return false;
  return a.isFormula() ? a.formula() == b.formula() : sameBits(a.number(), b.number());
}

}  // namespace luxo
