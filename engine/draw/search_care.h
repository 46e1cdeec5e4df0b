// SPDX-License-Identifier: Apache-2.0
// What attempts at a picture lost, and how the next one finds it.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace luxo {

/// Pixels in which an attempt lost the search for a surface. A pixel counts once for every layer.
struct LostPixels {
  std::vector<std::uint32_t> inFlat;  ///< triangles seen flat, by tallySlot(); empty: none were drawn
  std::map<std::uint32_t, std::uint32_t> inSteep;  ///< others, by the nodes that were drawn (Snapshot::nodes)
};

/// A picture that lost pixels is drawn so many times more: mostly nothing but what lost them.
inline constexpr int kMostLessons = 3;

/// How much more care than usual the searches for surfaces take.
class SearchCare {
 public:
  /// After an attempt with this care. Whether more care may find what it lost: flat triangles in which pixels
  /// were lost count as steep from now on, and nodes that lost pixels in steep ones get more digits and a
  /// finer hull, unless that did not help before: what is lost then is a singular point, which is counted,
  /// and left. So is what kMostLessons have not found.
  bool learn(const LostPixels& lost);

  /// The node gets a finer hull, whatever it lost.
  void refine(std::uint32_t node);

  /// Keeps what helps other pictures of nearly the same view: a new picture begins.
  void beginPicture();

  /// How often the deviation of the node's hull is quartered; where it is, every ray counts as grazing, and
  /// the search is one in double, if it can be.
  [[nodiscard]] int level(std::uint32_t node) const { return node < nodes_.size() ? nodes_[node].level : 0; }

  /// Whether pixels were lost in flat triangles of that tallySlot(), ever or by the last attempt.
  [[nodiscard]] bool lostInFlat(std::uint32_t slot) const {
    return slot < lostInFlat_.size() && lostInFlat_[slot];
  }
  [[nodiscard]] bool lostJustNow(std::uint32_t slot) const {
    return slot < lostNow_.size() && lostNow_[slot] > 0;
  }

  /// Whether the node's level became higher with the last lesson.
  [[nodiscard]] bool refined(std::uint32_t node) const {
    return node < nodes_.size() && nodes_[node].refined;
  }

  /// Pixels that the attempts so far have lost, and not found again.
  [[nodiscard]] std::uint64_t lost() const;

  /// Only the flat triangles in which the last attempt lost pixels, and the nodes refined, are drawn: they
  /// complete what the attempts have drawn.
  bool completes = false;

 private:
  bool refineNodes(const LostPixels& lost, bool mayHelp);
  void rememberFlat();

  struct Node {
    std::uint8_t level = 0;
    bool refined = false;
    std::uint32_t lost = 0;
  };
  std::vector<Node> nodes_;
  std::vector<bool> lostInFlat_;
  std::vector<std::uint32_t> lostNow_;  ///< in flat triangles, by the last attempt
  int lessons_ = 0;                     ///< for this picture
};

}  // namespace luxo
