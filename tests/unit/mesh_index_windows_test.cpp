// SPDX-License-Identifier: Apache-2.0
// Windows of indices hold what they say, in as few as there can be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "mesh/index_windows.h"
#include "support/meshes.h"

namespace luxo::test {
namespace {

/// They follow each other, and every index is in its own.
void expectHeld(const std::vector<std::uint32_t>& indices, const std::vector<IndexWindow>& windows) {
  std::size_t at = 0;
  for (const IndexWindow& window : windows) {
    ASSERT_GT(window.end, at);
    ASSERT_EQ(window.end % 3, 0U);
    for (; at < window.end; ++at) {
      ASSERT_GE(indices[at], window.firstVertex);
      ASSERT_LT(indices[at] - window.firstVertex, kWindowVertices);
    }
  }
  EXPECT_EQ(at, indices.size());
}

/// Over all ways to part them, by the fewest windows of each beginning.
std::size_t fewestWindows(const std::vector<std::uint32_t>& indices) {
  const std::size_t triangles = indices.size() / 3;
  std::vector<std::size_t> fewest(triangles + 1, std::numeric_limits<std::size_t>::max());
  fewest[0] = 0;
  for (std::size_t begin = 0; begin < triangles; ++begin)
    for (std::size_t end = begin + 1; end <= triangles; ++end) {
      const auto [low, high] = std::minmax_element(indices.begin() + std::ptrdiff_t(3 * begin),
                                                   indices.begin() + std::ptrdiff_t(3 * end));
      if (*high - *low < kWindowVertices) fewest[end] = std::min(fewest[end], fewest[begin] + 1);
    }
  return fewest[triangles];
}

TEST(IndexWindows, OfASmallMeshAreOneFromItsFirstVertexOn) {
  const std::vector<std::uint32_t> indices{2, 1, 0, kWindowVertices - 1, 1, 2};
  EXPECT_EQ(indexWindows(indices), (std::vector<IndexWindow>{{6, 0}}));
  EXPECT_TRUE(indexWindows({}).empty());
}

TEST(IndexWindows, AreTheFewestThatHoldRandomTriangles) {
  std::mt19937 random(3);
  int some = 0, none = 0;
  for (int i = 0; i < 200; ++i) {
    // About a place that moves on, mostly.
    std::vector<std::uint32_t> indices;
    const std::uint32_t step = random() % 30'000, width = 1 + random() % 80'000;
    for (std::uint32_t triangle = 0; triangle < 40; ++triangle)
      for (int corner = 0; corner < 3; ++corner) indices.push_back(triangle * step + random() % width);
    const std::vector<IndexWindow> windows = indexWindows(indices);
    if (windows.empty()) {
      ++none;
      continue;
    }
    ++some;
    expectHeld(indices, windows);
    EXPECT_EQ(windows.size(), fewestWindows(indices));
  }
  EXPECT_GT(some, 50);
  EXPECT_GT(none, 20);
}

TEST(IndexWindows, HoldTheClustersOfALargeMesh) {
  const TriangleMesh mesh = icosphere(7);  // 163,842 vertices, and those that two windows share
  const std::vector<std::uint32_t> indices(mesh.indices().begin(), mesh.indices().end());
  const std::vector<IndexWindow> windows = indexWindows(indices);
  expectHeld(indices, windows);
  EXPECT_EQ(windows.size(), 3U);
}

TEST(IndexWindows, AreNoneOfATriangleThatIsTooWideOrOfOnesInAWildOrder) {
  EXPECT_TRUE(indexWindows(std::vector<std::uint32_t>{0, 1, kWindowVertices}).empty());
  std::vector<std::uint32_t> wild;
  for (std::uint32_t i = 0; i < 5; ++i)
    for (const std::uint32_t first : {0U, 2 * kWindowVertices})
      wild.insert(wild.end(), {first, first + 1, first + 2});
  EXPECT_TRUE(indexWindows(wild).empty());
}

}  // namespace
}  // namespace luxo::test
