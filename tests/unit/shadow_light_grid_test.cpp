// SPDX-License-Identifier: Apache-2.0
// Whatever stands between a light and a point is listed where the point is looked up, however few texels
// there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "shadow/light_grid.h"
#include "surface/catalogue.h"
#include "surface/library.h"

namespace luxo {
namespace {

CasterCells casterOf(const Surface& surface) {
  return makeCasterCells(surface, {}, CurvatureMap(surface, {}));
}

/// The entries that a fragment reads for a point, as shaders/lib/shadow_fragment.glsl finds them, and how far
/// the point is along the face's axis.
struct Lookup {
  std::span<const LightGrid::Entry> entries;
  double ahead = 0;
};

Lookup lookUp(const LightGrid& grid, bool parallel, const Vec3& point) {
  const Vec3 q = grid.fromLight(point), size = glm::abs(q);
  const int axis = parallel || (size.z >= size.x && size.z >= size.y) ? 2 : size.x >= size.y ? 0 : 1;
  const std::size_t number = 2 * static_cast<std::size_t>(axis) + (q[axis] < 0 && !parallel ? 1 : 0);
  const LightGrid::Face& face = grid.faces[number];
  const double ahead = parallel ? q.z : size[axis];
  if (face.texels.x == 0) return {{}, ahead};
  const Vec2 place = Vec2(q[(axis + 1) % 3], q[(axis + 2) % 3]) / (parallel ? 1 : ahead);
  const Vec2 texel = (place - face.low) * face.texels;
  if (std::min(texel.x, texel.y) < 0 || std::max(texel.x, texel.y) > grid.size) return {{}, ahead};
  const auto whole = [&](double x) { return static_cast<std::size_t>(std::clamp(x, 0.0, grid.size - 1.0)); };
  const std::size_t start =
      face.first + whole(texel.y) * static_cast<std::size_t>(grid.size) + whole(texel.x);
  return {std::span(grid.entries).subspan(grid.starts[start], grid.starts[start + 1] - grid.starts[start]),
          ahead};
}

struct GridCase {
  int size;
  bool parallel;
  double distance;  ///< of the light from the middle, in sizes
};

class LightGrids : public ::testing::TestWithParam<GridCase> {};

TEST_P(LightGrids, ListWhatIsInTheWay) {
  const auto [size, parallel, distance] = GetParam();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(0, 1);
  const auto direction = [&] { return unit(Vec3(part(random), part(random), part(random)) - 0.5); };
  int looked = 0;
  for (const Surface& surface : {torus(2, 0.5), makeSurface("klein"), makeSurface("teapot"),
                                 makeSurface("boy"), sphere(1), rectangle(3, 2)}) {
    const CasterCells caster = casterOf(surface);
    for (int k = 0; k < 4; ++k) {
      const Vec3 way = direction();
      const Vec3 at = caster.bounds.center() + distance * caster.size * way;
      const LightGrid grid = makeLightGrid(caster, parallel ? Vec4(way, 0) : Vec4(at, 1), 0, size);
      for (const CasterCell& cell : caster.cells) {
        const double u = cell.domain.u.lo + part(random) * cell.domain.u.width(),
                     v = cell.domain.v.lo + part(random) * cell.domain.v.width();
        const Vec3 p = surface.position(cell.patch, u, v);
        const Vec3 away = 3.0 * (p - at);  // of a light afar, as far as rounding leaves it behind the point
        const double share = part(random) * std::min(1.0, 1e3 * caster.size / glm::length(away));
        const Vec3 behind = p + (parallel ? -share * caster.size * way : share * away);
        const Lookup found = lookUp(grid, parallel, behind);
        const auto index = static_cast<std::uint32_t>(&cell - caster.cells.data());
        const auto entry = std::ranges::find(found.entries, index, &LightGrid::Entry::cell);
        ASSERT_NE(entry, found.entries.end()) << surface.name() << " " << u << ", " << v;
        ASSERT_LE(entry->nearest, found.ahead + 1e-9 * caster.size);
        ASSERT_TRUE(std::ranges::is_sorted(found.entries, {}, &LightGrid::Entry::nearest));
        ++looked;
      }
    }
  }
  EXPECT_GT(looked, 10'000);
}

INSTANTIATE_TEST_SUITE_P(All, LightGrids,
                         ::testing::Values(GridCase{1, false, 2}, GridCase{64, false, 20},
                                           GridCase{64, false, 0.6}, GridCase{7, false, 0.1},
                                           GridCase{64, false, 0}, GridCase{64, false, 1e6},
                                           GridCase{64, false, 1e15}, GridCase{5, false, 1e17},
                                           GridCase{64, true, 0}, GridCase{3, true, 0}));

TEST(LightGrid, HasNoTexelsWhereTheCasterIsNot) {
  const CasterCells caster = casterOf(sphere(1));
  const LightGrid grid = makeLightGrid(caster, Vec4(0, 30, 0, 1), 0);
  for (std::uint32_t face = 0; face < 6; ++face)
    EXPECT_EQ(grid.faces[face].texels.x > 0, face == LightGrid::kFirstFace) << face;
  // A ball in a square leaves out the corners, and lists two layers elsewhere.
  int empty = 0;
  for (std::size_t i = 0; i < std::size_t{64} * 64; ++i) empty += grid.starts[i] == grid.starts[i + 1];
  EXPECT_GT(empty, 64 * 64 / 10);
  EXPECT_LT(grid.entries.size(), 64U * 64 * 12);
}

/// A convex outline of area A, w wide and h high, in texels, is in A + w + h + 1 of them, on the average over
/// where it is (by Steiner's formula). A box around it has up to twice the area.
TEST(LightGrid, ListsACellWhereItsOutlineIs) {
  const CasterCells caster = casterOf(rectangle(3, 2));
  for (const Vec4& light : {Vec4(0.3, 1, 0.2, 0), Vec4(3, 9, 2, 1), Vec4(-7, 4, 5, 1)}) {
    const bool parallel = light.w == 0;
    const LightGrid grid = makeLightGrid(caster, light, 0, 256);
    const LightGrid::Face& face = grid.faces[LightGrid::kFirstFace];
    double expected = 0;
    for (const CasterCell& cell : caster.cells) {
      std::vector<Vec2> corners;
      for (const Vec3& corner : {cell.a + cell.b, cell.b - cell.a, -cell.a - cell.b, cell.a - cell.b}) {
        const Vec3 p = grid.fromLight(cell.middle + corner);
        corners.push_back(Vec2(p) / (parallel ? 1 : p.z) * face.texels);
      }
      Vec2 low = corners[0], high = low;
      double area = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 &from = corners[i], &to = corners[(i + 1) % 4];
        low = glm::min(low, from);
        high = glm::max(high, from);
        area += 0.5 * (from.x * to.y - from.y * to.x);
      }
      expected += std::abs(area) + high.x - low.x + high.y - low.y + 1;
    }
    // Borders are moved by a sixteenth of a texel, and cells of some twenty texels by what they bend:
    // nothing.
    EXPECT_LT(static_cast<double>(grid.entries.size()), 1.05 * expected);
    EXPECT_GT(static_cast<double>(grid.entries.size()), 0.95 * expected);
  }
}

TEST(LightGrid, HasFewerTexelsWhereThereWouldBeTooManyEntries) {
  const CasterCells caster = casterOf(torus(2, 0.5));
  const LightGrid grid = makeLightGrid(caster, Vec4(0, 1, 0, 0), 0, 4096);
  EXPECT_LT(grid.size, 4096);
  EXPECT_GT(grid.size, 64);
  EXPECT_LE(grid.entries.size(), kMaxGridEntries);
}

}  // namespace
}  // namespace luxo
