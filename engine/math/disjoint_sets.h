// SPDX-License-Identifier: Apache-2.0
// Which of many things are one, and which of these are turned over against each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace luxo {

/// Numbers 0 .. count - 1 in sets that grow together (Galler, Fischer, An improved equivalence algorithm,
/// 1964), paths shortened where sets grow. Cost: as good as constant.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count), flipped_(count, false) {
    std::iota(parents_.begin(), parents_.end(), 0U);
  }

  /// The smallest of a number's set, and whether a flip lies between the two.
  struct Root {
    std::uint32_t number = 0;
    bool flipped = false;
  };
  [[nodiscard]] Root find(std::uint32_t i) const {
    bool flipped = false;
    for (; parents_[i] != i; i = parents_[i]) flipped = flipped != flipped_[i];
    return {i, flipped};
  }

  /// With a flip between them, or none; where they are one set already nothing changes.
  void unite(std::uint32_t a, std::uint32_t b, bool flipped = false) {
    const Root rootA = shortened(a), rootB = shortened(b);
    if (rootA.number == rootB.number) return;
    const auto [low, high] = std::minmax(rootA.number, rootB.number);
    parents_[high] = low;
    flipped_[high] = (rootA.flipped != rootB.flipped) != flipped;
  }

  /// How many sets there are.
  [[nodiscard]] std::uint32_t count() const {
    std::uint32_t roots = 0;
    for (std::uint32_t i = 0; i < parents_.size(); ++i) roots += parents_[i] == i;
    return roots;
  }

 private:
  /// All on the way to the root become its children.
  Root shortened(std::uint32_t i) {
    const Root root = find(i);
    bool flipped = root.flipped;
    while (parents_[i] != root.number) {
      const std::uint32_t parent = parents_[i];
      const bool toParent = flipped_[i];
      parents_[i] = root.number;
      flipped_[i] = flipped;
      flipped = flipped != toParent;
      i = parent;
    }
    return root;
  }

  std::vector<std::uint32_t> parents_;
  std::vector<bool> flipped_;  ///< against the parent
};

}  // namespace luxo
