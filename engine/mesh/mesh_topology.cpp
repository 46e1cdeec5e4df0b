// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_topology.h"

#include <algorithm>
#include <tuple>

#include "mesh/welding.h"

namespace luxo {

std::vector<std::uint32_t> pointNumbers(std::span<const Vec3f> positions) {
  std::vector<std::uint32_t> numbers(positions.size());
  WeldingTable table([&](std::uint32_t i) { return mixed(0, positions[i]); },
                     [&](std::uint32_t i, std::uint32_t j) { return positions[i] == positions[j]; });
  for (std::uint32_t i = 0; i < positions.size(); ++i) numbers[i] = table.firstEqual(i);
  return numbers;
}

EdgeList::EdgeList(std::span<const std::uint32_t> corners, std::size_t points) : begins_(points + 1, 0) {
  const auto forEachEdge = [&](auto action) {
    for (std::uint32_t corner = 0; corner < corners.size(); ++corner) {
      const std::uint32_t from = corners[corner], to = corners[corner % 3 == 2 ? corner - 2 : corner + 1];
      if (from != to) action(corner, from, to);
    }
  };
  forEachEdge(
      [&](std::uint32_t, std::uint32_t from, std::uint32_t to) { ++begins_[std::min(from, to) + 1]; });
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  uses_.resize(begins_.back());
  std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
  forEachEdge([&](std::uint32_t corner, std::uint32_t from, std::uint32_t to) {
    EdgeUse& use = uses_[next[std::min(from, to)]++];
    use.other = std::max(from, to);
    use.corner = corner;
    use.forward = from < to;
  });
  for (std::size_t i = 0; i + 1 < begins_.size(); ++i)
    std::sort(uses_.begin() + begins_[i], uses_.begin() + begins_[i + 1],
              [](const EdgeUse& a, const EdgeUse& b) {
                return a.other != b.other ? a.other < b.other : a.corner < b.corner;
              });
}

MeshEdges EdgeList::count() const {
  MeshEdges edges;
  forEach([&](std::span<const EdgeUse> uses) {
    const auto forward =
        std::count_if(uses.begin(), uses.end(), [](const EdgeUse& use) { return use.forward; });
    const auto backward = std::ptrdiff_t(uses.size()) - forward;
    edges.border += uses.size() == 1;
    edges.turned += uses.size() == 2 && forward != backward;
    edges.nonManifold += uses.size() > 2;
    edges.unbalanced += forward != backward;
  });
  return edges;
}

}  // namespace luxo
