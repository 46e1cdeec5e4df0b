// SPDX-License-Identifier: Apache-2.0
#include "cull/occlusion_buffer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <experimental/simd>

#include "cull/raster_slack.h"

namespace luxo {
namespace {

/// Of a depth: more than what floats round.
constexpr float kDepthMargin = 1e-6f;
constexpr int kTile = 16;  // samples

double crossed(const Vec3& a, const Vec3& b) { return a.x * b.y - a.y * b.x; }

// Without branches, unlike std::minmax of a list.
double lowest(double a, double b, double c) { return std::min(std::min(a, b), c); }
double highest(double a, double b, double c) { return std::max(std::max(a, b), c); }

/// Of what is not negative.
int roundedUp(double x) {
  const int down = static_cast<int>(x);
  return down + (down < x);
}

/// Calls action(row, first, end) for the samples of each row inside the triangle, `room` beyond its edges
/// counting as inside, until it gives false; gives whether it never did.
template <typename Action>
bool forEachRow(const PixelTriangle& t, const Vec2& sample, int width, const Rows& rows, double room,
                const Action& action) {
  const double area = crossed(t[1] - t[0], t[2] - t[0]);
  if (!std::isfinite(area)) return false;
  double lowX = lowest(t[0].x, t[1].x, t[2].x), highX = highest(t[0].x, t[1].x, t[2].x);
  double lowY = lowest(t[0].y, t[1].y, t[2].y), highY = highest(t[0].y, t[1].y, t[2].y);
  lowX = std::max(lowX - room - sample.x, 0.0);
  highX = std::min(highX + room - sample.x, width - 1.0);
  lowY = std::max<double>(lowY - room - sample.y, rows.first);
  highY = std::min(highY + room - sample.y, rows.end - 1.0);
  if (!(lowX <= highX && lowY <= highY)) return true;
  const int firstRow = roundedUp(lowY), lastRow = static_cast<int>(highY);
  if (firstRow > lastRow || roundedUp(lowX) > static_cast<int>(highX)) return true;
  // Where rows begin and end, in samples: from + slope * row, of edges that rows cross. Of three edges no
  // more than two are begins, or ends.
  struct Edge {
    double slope, from;
  };
  std::array<Edge, 3> begins, ends;
  begins.fill({0, lowX});
  ends.fill({0, highX});
  std::size_t beginCount = 0, endCount = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = t[k], way = t[(k + 1) % 3] - a;
    if (way.y == 0) continue;
    const double slope = way.x / way.y, roomAlongRow = room * std::sqrt(1 + slope * slope);
    const bool begin = (way.y < 0) == (area > 0);
    const double from = a.x + slope * (sample.y - a.y) - sample.x + (begin ? -roomAlongRow : roomAlongRow);
    (begin ? begins[beginCount++] : ends[endCount++]) = {slope, from};
  }
  for (int row = firstRow; row <= lastRow; ++row) {
    const auto at = [&](const Edge& edge) { return edge.from + edge.slope * row; };
    const double low = highest(lowX, at(begins[0]), at(begins[1]));
    const double high = lowest(highX, at(ends[0]), at(ends[1]));
    if (!(low <= high)) continue;
    const int first = roundedUp(low), end = static_cast<int>(high) + 1;
    if (first < end && !action(row, first, end)) return false;
  }
  return true;
}

/// Neighbours in a row, which are looked at together.
constexpr int kBlock = 8;
using Block = std::experimental::fixed_size_simd<float, kBlock>;
using BlockMask = Block::mask_type;
constexpr std::experimental::element_aligned_tag kAnywhere;

Block upward() {
  return Block([](auto k) { return static_cast<float>(k); });
}

/// Calls action(x, mask) for blocks of samples from x on, of which those of the mask are of the row.
template <typename Action>
void forEachBlock(int first, int end, const Action& action) {
  for (int x = first; x < end; x += kBlock) action(x, upward() < static_cast<float>(end - x));
}

/// The depth of a triangle in its samples: linear, and no other than between its corners'.
class Depth {
 public:
  Depth(const PixelTriangle& t, const Vec2& sample) : corner_(t[0]), sample_(sample) {
    const double low = lowest(t[0].z, t[1].z, t[2].z), high = highest(t[0].z, t[1].z, t[2].z);
    low_ = static_cast<float>(low);
    high_ = static_cast<float>(high);
    margin_ = kDepthMargin * std::max(std::abs(low_), std::abs(high_));
    const double area = certainArea(t);
    known_ = area != 0;
    if (!known_) return;
    const Vec3 a = t[1] - t[0], b = t[2] - t[0];
    perColumn_ = (a.z * b.y - a.y * b.z) / area;
    perRow_ = (a.x * b.z - a.z * b.x) / area;
  }

  /// The triangle is no nearer, or no farther, in kBlock samples of a row.
  [[nodiscard]] Block nearest(int row, int first) const { return block(row, first, low_, -margin_); }
  [[nodiscard]] Block farthest(int row, int first) const { return block(row, first, high_, margin_); }

 private:
  [[nodiscard]] Block block(int row, int first, float unknown, float margin) const {
    const double right = first + sample_.x - corner_.x, down = row + sample_.y - corner_.y;
    const float start =
        known_ ? static_cast<float>(corner_.z + perColumn_ * right + perRow_ * down) : unknown;
    const auto step = static_cast<float>(perColumn_);
    return min(max(start + step * upward(), Block(low_)), Block(high_)) + margin;
  }

  Vec3 corner_;
  Vec2 sample_;
  double perColumn_ = 0, perRow_ = 0;
  float low_, high_, margin_;
  bool known_;  ///< not where the triangle is too narrow to tell
};

}  // namespace

void OcclusionBuffer::clear(int width, const Rows& rows, const Vec2& sample) {
  if (width == width_ && rows == rows_) {
    // Most of a picture is behind nothing: what is as it was needs no writing.
    forEachTilePlace([&](Tile& tile, int column, int row) {
      if (tile.covered) fill(farthest_, column, row);
      tile = {};
    });
    sample_ = sample;
    return;
  }
  width_ = width;
  rows_ = rows;
  sample_ = sample;
  tilesAcross_ = (width + kTile - 1) / kTile;
  // The last block may reach beyond its row. An odd number of cache lines apart rows do not evict each other.
  constexpr int kLine = 16;
  stride_ = ((width + kBlock + kLine - 1) / kLine | 1) * kLine;
  const std::size_t count = startOf(rows.end);
  farthest_.assign(count, kInfinity);
  entered_.assign(count, kInfinity);
  const auto tilesDown = static_cast<std::size_t>((rows.end - rows.first + kTile - 1) / kTile);
  tiles_.assign(tilesDown * static_cast<std::size_t>(tilesAcross_), {});
}

OcclusionBuffer::Reach OcclusionBuffer::reachOf(const PixelTriangle& t) const {
  // A sample is less than a pixel from its pixel's corner.
  const double lowY = lowest(t[0].y, t[1].y, t[2].y), highY = highest(t[0].y, t[1].y, t[2].y);
  if (!(highY >= rows_.first - 1 && lowY <= rows_.end + 1)) return {};
  const double lowX = lowest(t[0].x, t[1].x, t[2].x), highX = highest(t[0].x, t[1].x, t[2].x);
  if (!(highX >= -1 && lowX <= width_ + 1)) return {};
  const double near = lowest(t[0].z, t[1].z, t[2].z), far = highest(t[0].z, t[1].z, t[2].z);
  const auto tileAt = [](double place, int last) {
    return std::clamp(static_cast<int>(std::clamp(place, -1.0, 1e6)), 0, last) / kTile;
  };
  const float margin = kDepthMargin * static_cast<float>(std::max(std::abs(near), std::abs(far)));
  return {.left = tileAt(lowX - 2, width_ - 1),
          .right = tileAt(highX + 1, width_ - 1) + 1,
          .top = tileAt(lowY - 2 - rows_.first, rows_.end - rows_.first - 1),
          .bottom = tileAt(highY + 1 - rows_.first, rows_.end - rows_.first - 1) + 1,
          .near = static_cast<float>(near) - margin,
          .far = static_cast<float>(far) + margin};
}

template <typename Action>
void OcclusionBuffer::forEachTile(const Reach& reach, const Action& action) {
  for (int row = reach.top; row < reach.bottom; ++row)
    for (int column = reach.left; column < reach.right; ++column)
      action(tiles_[static_cast<std::size_t>(row * tilesAcross_ + column)]);
}

bool OcclusionBuffer::allNearer(float Tile::*depth, const Reach& reach) const {
  for (int row = reach.top; row < reach.bottom; ++row)
    for (int column = reach.left; column < reach.right; ++column)
      if (!(tiles_[static_cast<std::size_t>(row * tilesAcross_ + column)].*depth < reach.near)) return false;
  return true;
}

void OcclusionBuffer::cover(std::span<const PixelTriangle> leaving, std::span<const PixelTriangle> entering) {
  covering_.clear();
  for (std::uint32_t i = 0; i < leaving.size(); ++i) {
    const Reach reach = reachOf(leaving[i]);
    if (allNearer(&Tile::farthest, reach)) continue;
    covering_.push_back(i);
    forEachTile(reach, [&](Tile& tile) { tile.cover = std::max(tile.cover, reach.far); });
  }
  if (covering_.empty()) return;
  for (const PixelTriangle& triangle : entering) {
    const Reach reach = reachOf(triangle);
    if (allNearer(&Tile::cover, reach)) continue;
    enter(triangle);
    forEachTile(reach, [](Tile& tile) { tile.entered = true; });
  }
  for (const std::uint32_t i : covering_) coverUnlessEntered(leaving[i]);
  forEachTilePlace([&](Tile& tile, int column, int row) { settle(tile, column, row); });
}

template <typename Action>
void OcclusionBuffer::forEachTilePlace(const Action& action) {
  for (std::size_t i = 0; i < tiles_.size(); ++i)
    action(tiles_[i], kTile * (static_cast<int>(i) % tilesAcross_),
           rows_.first + kTile * (static_cast<int>(i) / tilesAcross_));
}

void OcclusionBuffer::fill(std::vector<float>& samples, int column, int row) const {
  for (int y = row; y < std::min(row + kTile, rows_.end); ++y) {
    float* const first = samples.data() + startOf(y);
    std::fill(first + column, first + std::min(column + kTile, width_), kInfinity);
  }
}

void OcclusionBuffer::enter(const PixelTriangle& triangle) {
  const Depth depth(triangle, sample_);
  forEachRow(triangle, sample_, width_, rows_, kMovedPx, [&](int row, int first, int end) {
    float* const entered = entered_.data() + startOf(row);
    forEachBlock(first, end, [&](int x, const BlockMask& inRow) {
      Block nearest(entered + x, kAnywhere);
      const Block near = depth.nearest(row, x);
      where(inRow && near < nearest, nearest) = near;
      nearest.copy_to(entered + x, kAnywhere);
    });
    return true;
  });
}

void OcclusionBuffer::coverUnlessEntered(const PixelTriangle& triangle) {
  const Depth depth(triangle, sample_);
  forEachRow(triangle, sample_, width_, rows_, 0, [&](int row, int first, int end) {
    float* const farthest = farthest_.data() + startOf(row);
    const float* const entered = entered_.data() + startOf(row);
    forEachBlock(first, end, [&](int x, const BlockMask& inRow) {
      Block seen(farthest + x, kAnywhere);
      const Block far = depth.farthest(row, x), before(entered + x, kAnywhere);
      where(inRow && far < before && far < seen, seen) = far;
      seen.copy_to(farthest + x, kAnywhere);
    });
    return true;
  });
}

/// After a slab: makes room for the next, which nothing has entered. The tile begins in that column and row.
void OcclusionBuffer::settle(Tile& tile, int column, int row) {
  const int columnEnd = std::min(column + kTile, width_), rowEnd = std::min(row + kTile, rows_.end);
  if (tile.entered) fill(entered_, column, row);
  if (tile.cover > -kInfinity) {
    std::array<float, kTile> farthest;  // of each column
    farthest.fill(-kInfinity);
    for (int y = row; y < rowEnd; ++y) {
      const float* const samples = farthest_.data() + startOf(y) + column;
      for (int x = 0; x < columnEnd - column; ++x) farthest[x] = std::max(farthest[x], samples[x]);
    }
    tile.farthest = *std::ranges::max_element(farthest);
    tile.covered = true;
  }
  tile.cover = -kInfinity;
  tile.entered = false;
}

std::size_t OcclusionBuffer::samplesIn(const PixelTriangle& triangle) const {
  std::size_t count = 0;
  forEachRow(triangle, sample_, width_, rows_, 0, [&](int, int first, int end) {
    count += static_cast<std::size_t>(end - first);
    return true;
  });
  return count;
}

std::size_t OcclusionBuffer::covered() const {
  return static_cast<std::size_t>(std::ranges::count_if(farthest_, [](float f) { return f < kInfinity; }));
}

bool OcclusionBuffer::hides(const PixelTriangle& triangle) const {
  if (const Reach reach = reachOf(triangle); !reach.empty() && allNearer(&Tile::farthest, reach)) return true;
  const Depth depth(triangle, sample_);
  return forEachRow(triangle, sample_, width_, rows_, kMovedPx, [&](int row, int first, int end) {
    const float* const farthest = farthest_.data() + startOf(row);
    bool hidden = true;
    forEachBlock(first, end, [&](int x, const BlockMask& inRow) {
      hidden = hidden && none_of(inRow && !(Block(farthest + x, kAnywhere) < depth.nearest(row, x)));
    });
    return hidden;
  });
}

}  // namespace luxo
