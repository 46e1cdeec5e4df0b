// SPDX-License-Identifier: Apache-2.0
// Dyadic rectangles of a patch: what is split in halves again and again, along u or along v.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "surface/patch.h"

namespace luxo {

/// The parameter at `part`, 0..1, of a range: the ends exactly.
[[nodiscard]] inline double parameterAt(const Interval& range, double part) {
  return part == 1 ? range.hi : range.lo + part * range.width();
}

/// One of 2^levelU x 2^levelV equal rectangles of a patch. Its borders are parts, 0..1, of the patch's sides
/// and exact: dyadic fractions.
struct Tile {
  std::uint32_t levelU = 0, levelV = 0, column = 0, row = 0;

  [[nodiscard]] double lowU() const { return border(column, levelU); }
  [[nodiscard]] double highU() const { return border(column + 1, levelU); }
  [[nodiscard]] double lowV() const { return border(row, levelV); }
  [[nodiscard]] double highV() const { return border(row + 1, levelV); }
  [[nodiscard]] double widthU() const { return border(1, levelU); }
  [[nodiscard]] double widthV() const { return border(1, levelV); }

  [[nodiscard]] std::array<Tile, 2> halves(bool acrossU) const {
    if (acrossU) return {{{levelU + 1, levelV, 2 * column, row}, {levelU + 1, levelV, 2 * column + 1, row}}};
    return {{{levelU, levelV + 1, column, 2 * row}, {levelU, levelV + 1, column, 2 * row + 1}}};
  }

  friend bool operator==(const Tile&, const Tile&) = default;

 private:
  static double border(std::uint32_t index, std::uint32_t level) {
    return std::ldexp(static_cast<double>(index), -static_cast<int>(level));
  }
};

/// The (u, v) of a tile.
[[nodiscard]] inline Domain domainOf(const Tile& tile, const Domain& patch) {
  return {{parameterAt(patch.u, tile.lowU()), parameterAt(patch.u, tile.highU())},
          {parameterAt(patch.v, tile.lowV()), parameterAt(patch.v, tile.highV())}};
}

}  // namespace luxo
