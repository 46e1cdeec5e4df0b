// SPDX-License-Identifier: Apache-2.0
// What an attempt at a picture lost, and how the next one finds it.
#pragma once

#include <cstdint>
#include <vector>

namespace luxo {

/// Pixels in which the search for a surface was lost. A pixel counts once for every layer. Empty where no surface was
/// searched for.
struct LostPixels {
  std::vector<std::uint32_t> inFlat;   ///< triangles seen flat, by tallySlot()
  std::vector<std::uint32_t> inSteep;  ///< other triangles, by index into Snapshot::nodes

  [[nodiscard]] std::uint64_t count() const;
};

/// How much more care than usual the searches for surfaces take.
struct SearchCare {
  /// By index into Snapshot::nodes: how often the hull's deviation is quartered; where it is, every ray counts as
  /// grazing. Those missing: never.
  std::vector<std::uint8_t> levels;
  /// By tallySlot(): in flat triangles whose slot is not 0 every ray counts as grazing. Empty: in none.
  std::vector<std::uint32_t> lostInFlat;
  /// By index into Snapshot::nodes: what was lost in other triangles when levels were last raised.
  std::vector<std::uint32_t> lostInSteep;
  /// Only the triangles of lostInFlat are drawn: they complete what an attempt has drawn.
  bool completes = false;

  /// Adds to lostInFlat. Whether there was anything to add.
  bool addFlat(const LostPixels& lost);

  /// Raises the levels of nodes that lost pixels in other triangles, unless that did not help before: what more care
  /// did not help is a singular point, which is counted, and left. Whether any was raised.
  bool raiseLevels(const LostPixels& lost);
};

}  // namespace luxo
