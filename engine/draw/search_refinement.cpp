// SPDX-License-Identifier: Apache-2.0
#include "draw/search_refinement.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace luxo {
namespace {

std::uint64_t sum(const std::vector<std::uint32_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

}  // namespace

bool SearchRefinement::learn(const LostPixels& lost) {
  const bool mayHelp = refinements_++ < kMaxRefinements;
  const bool finer = refineNodes(lost, mayHelp);
  lostNow_ = lost.transversal;
  if (!mayHelp || sum(lostNow_) == 0) return finer;
  rememberTransversal(lostNow_);
  return true;
}

bool SearchRefinement::refineNodes(const LostPixels& lost, bool mayHelp) {
  for (Node& node : nodes_) node.refined = false;
  bool finer = false;
  for (const auto& [index, count] : lost.grazing) {
    if (index >= nodes_.size()) nodes_.resize(index + 1);
    Node& node = nodes_[index];
    const std::uint32_t before = std::exchange(node.lost, count);
    node.refined = mayHelp && count > 0 && (node.level == 0 || count < before);
    node.level += node.refined;
    finer = finer || node.refined;
  }
  return finer;
}

void SearchRefinement::refine(std::uint32_t node) {
  if (node >= nodes_.size()) nodes_.resize(node + 1);
  ++nodes_[node].level;
}

void SearchRefinement::remember(const LostPixels& lost) {
  if (sum(lost.transversal) > 0) rememberTransversal(lost.transversal);
}

void SearchRefinement::rememberTransversal(const std::vector<std::uint32_t>& lost) {
  // Most would be of views long gone.
  if (std::ranges::count(lostTransversal_, true) > std::ssize(lostTransversal_) / 4) lostTransversal_.clear();
  lostTransversal_.resize(lost.size());
  for (std::size_t slot = 0; slot < lost.size(); ++slot)
    if (lost[slot] > 0) lostTransversal_[slot] = true;
}

void SearchRefinement::beginPicture() {
  // Finer shells would cost every picture what few need.
  nodes_.clear();
  lostNow_.clear();
  refinements_ = 0;
  completes = false;
}

std::uint64_t SearchRefinement::lost() const {
  std::uint64_t all = sum(lostNow_);
  for (const Node& node : nodes_) all += node.lost;
  return all;
}

}  // namespace luxo
