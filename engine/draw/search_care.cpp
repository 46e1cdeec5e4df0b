// SPDX-License-Identifier: Apache-2.0
#include "draw/search_care.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace luxo {

bool SearchCare::learn(const LostPixels& lost) {
  for (Node& node : nodes_) node.refined = false;
  bool finer = false;
  for (const auto& [index, count] : lost.inSteep) {
    if (index >= nodes_.size()) nodes_.resize(index + 1);
    Node& node = nodes_[index];
    const std::uint32_t before = std::exchange(node.lost, count);
    node.refined = count > 0 && (node.level == 0 || count < before);
    node.level += node.refined;
    finer = finer || node.refined;
  }
  return learnFlat(lost.inFlat) || finer;
}

void SearchCare::beginPicture() {
  // Finer hulls would cost every picture what few need.
  nodes_.clear();
  completes = false;
}

bool SearchCare::learnFlat(const std::vector<std::uint32_t>& lost) {
  lostNow_ = std::accumulate(lost.begin(), lost.end(), std::uint64_t{0});
  if (lostNow_ == 0) return false;
  // Most would be of views long gone.
  if (std::ranges::count(lostInFlat_, true) > std::ssize(lostInFlat_) / 4) lostInFlat_.clear();
  lostInFlat_.resize(lost.size());
  for (std::size_t slot = 0; slot < lostInFlat_.size(); ++slot)
    if (lost[slot] > 0) lostInFlat_[slot] = true;
  return true;
}

std::uint64_t SearchCare::lost() const {
  std::uint64_t all = lostNow_;
  for (const Node& node : nodes_) all += node.lost;
  return all;
}

}  // namespace luxo
