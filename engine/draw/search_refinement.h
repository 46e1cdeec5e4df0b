// SPDX-License-Identifier: Apache-2.0
// What attempts at a picture lost, and how the next one finds it.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace luxo {

/// Pixels in which an attempt lost the search for a surface. A pixel counts once for every layer.
struct LostPixels {
  std::vector<std::uint32_t>
      transversal;  ///< transversal triangles, by feedbackSlot(); empty: none were drawn
  std::map<std::uint32_t, std::uint32_t> grazing;  ///< others, by the nodes that were drawn (Snapshot::nodes)
};

/// A picture that lost pixels is drawn so many times more: mostly nothing but what lost them.
inline constexpr int kMaxRefinements = 3;

/// What the searches for surfaces get beyond the usual: finer shells, more digits, curve tracing.
class SearchRefinement {
 public:
  /// After an attempt with this refinement. Whether more of it may find what was lost: transversal triangles
  /// in which pixels were lost count as grazing from now on, and nodes that lost pixels in grazing ones get
  /// more digits and a finer shell, unless that did not help before: what is lost then is a singular point,
  /// which is counted, and left. So is what kMaxRefinements have not found.
  bool learn(const LostPixels& lost);

  /// After an attempt at a picture that is no longer drawn: transversal triangles that lost pixels are likely
  /// to lose some in the next picture, too.
  void remember(const LostPixels& lost);

  /// The node gets a finer shell, whatever it lost.
  void refine(std::uint32_t node);

  /// Keeps what helps other pictures of nearly the same view: a new picture begins.
  void beginPicture();

  /// How often the deviation of the node's shell is quartered; where it is, every ray counts as grazing, and
  /// the search is one in double, if it can be.
  [[nodiscard]] int level(std::uint32_t node) const { return node < nodes_.size() ? nodes_[node].level : 0; }

  /// Whether pixels were lost in transversal triangles of that feedbackSlot(), ever or by the last attempt.
  [[nodiscard]] bool lostTransversal(std::uint32_t slot) const {
    return slot < lostTransversal_.size() && lostTransversal_[slot];
  }
  [[nodiscard]] bool lostJustNow(std::uint32_t slot) const {
    return slot < lostNow_.size() && lostNow_[slot] > 0;
  }

  /// Whether the node's level became higher with the last refinement.
  [[nodiscard]] bool refined(std::uint32_t node) const {
    return node < nodes_.size() && nodes_[node].refined;
  }

  /// Pixels that the attempts so far have lost, and not found again.
  [[nodiscard]] std::uint64_t lost() const;

  /// Only the transversal triangles in which the last attempt lost pixels, and the nodes refined, are drawn:
  /// they complete what the attempts have drawn.
  bool completes = false;

 private:
  bool refineNodes(const LostPixels& lost, bool mayHelp);
  void rememberTransversal(const std::vector<std::uint32_t>& lost);

  struct Node {
    std::uint8_t level = 0;
    bool refined = false;
    std::uint32_t lost = 0;
  };
  std::vector<Node> nodes_;
  std::vector<bool> lostTransversal_;
  std::vector<std::uint32_t> lostNow_;  ///< in transversal triangles, by the last attempt
  int refinements_ = 0;                 ///< for this picture
};

}  // namespace luxo
