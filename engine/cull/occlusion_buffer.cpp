// SPDX-License-Identifier: Apache-2.0
#include "cull/occlusion_buffer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace luxo {
namespace {

/// Pixels. Devices move corners to a grid of 1/256.
constexpr double kRoom = 1.0 / 64;
/// Of a depth: more than what floats round.
constexpr float kDepthMargin = 1e-6f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

double crossed(const Vec3& a, const Vec3& b) { return a.x * b.y - a.y * b.x; }

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
  auto [lowX, highX] = std::minmax({t[0].x, t[1].x, t[2].x});
  auto [lowY, highY] = std::minmax({t[0].y, t[1].y, t[2].y});
  lowX = std::max(lowX - room - sample.x, 0.0);
  highX = std::min(highX + room - sample.x, width - 1.0);
  lowY = std::max<double>(lowY - room - sample.y, rows.first);
  highY = std::min(highY + room - sample.y, rows.end - 1.0);
  if (!(lowX <= highX && lowY <= highY)) return true;
  // Where rows begin and end, in samples: from + slope * row, of edges that rows cross.
  struct Edge {
    double slope, from;
  };
  std::array<Edge, 3> begins, ends;
  std::size_t beginCount = 0, endCount = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = t[k], way = t[(k + 1) % 3] - a;
    if (way.y == 0) continue;
    const double slope = way.x / way.y, roomAlongRow = room * std::sqrt(1 + slope * slope);
    const bool begin = (way.y < 0) == (area > 0);
    const double from = a.x + slope * (sample.y - a.y) - sample.x + (begin ? -roomAlongRow : roomAlongRow);
    (begin ? begins[beginCount++] : ends[endCount++]) = {slope, from};
  }
  for (int row = roundedUp(lowY); row <= static_cast<int>(highY); ++row) {
    double low = lowX, high = highX;
    for (std::size_t k = 0; k < beginCount; ++k) low = std::max(low, begins[k].from + begins[k].slope * row);
    for (std::size_t k = 0; k < endCount; ++k) high = std::min(high, ends[k].from + ends[k].slope * row);
    if (!(low <= high)) continue;
    const int first = roundedUp(low), end = static_cast<int>(high) + 1;
    if (first < end && !action(row, first, end)) return false;
  }
  return true;
}

/// The depth of a triangle in its samples: linear, and no other than between its corners'.
class Depth {
 public:
  Depth(const PixelTriangle& t, const Vec2& sample) : corner_(t[0]), sample_(sample) {
    const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
    low_ = static_cast<float>(low);
    high_ = static_cast<float>(high);
    margin_ = kDepthMargin * std::max(std::abs(low_), std::abs(high_));
    const Vec3 a = t[1] - t[0], b = t[2] - t[0];
    const double area = crossed(a, b);
    const double narrow = kRoom * (std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y));
    known_ = std::abs(area) > narrow;
    if (!known_) return;
    perColumn_ = (a.z * b.y - a.y * b.z) / area;
    perRow_ = (a.x * b.z - a.z * b.x) / area;
  }

  /// Calls action(x, near, far) for the samples of a row: the triangle is no nearer and no farther.
  template <typename Action>
  void forEach(int row, int first, int end, const Action& action) const {
    const double right = first + sample_.x - corner_.x, down = row + sample_.y - corner_.y;
    const auto start = static_cast<float>(corner_.z + perColumn_ * right + perRow_ * down);
    const auto step = static_cast<float>(perColumn_);
    for (int x = first; x < end; ++x) {
      const float depth = std::clamp(start + step * static_cast<float>(x - first), low_, high_);
      action(x, (known_ ? depth : low_) - margin_, (known_ ? depth : high_) + margin_);
    }
  }

 private:
  Vec3 corner_;
  Vec2 sample_;
  double perColumn_ = 0, perRow_ = 0;
  float low_, high_, margin_;
  bool known_;  ///< not where the triangle is too narrow to tell
};

}  // namespace

void OcclusionBuffer::clear(int width, const Rows& rows, const Vec2& sample) {
  width_ = width;
  rows_ = rows;
  sample_ = sample;
  const std::size_t count = startOf(rows.end);
  farthest_.assign(count, kInfinity);
  entered_.assign(count, kInfinity);
  enteredRows_ = {rows.end, rows.first};
  firstEnteredColumn_ = width;
  enteredColumnEnd_ = 0;
}

void OcclusionBuffer::beginSlab() {
  for (int row = enteredRows_.first; row < enteredRows_.end; ++row) {
    float* const entered = entered_.data() + startOf(row);
    std::fill(entered + firstEnteredColumn_, entered + enteredColumnEnd_, kInfinity);
  }
  enteredRows_ = {rows_.end, rows_.first};
  firstEnteredColumn_ = width_;
  enteredColumnEnd_ = 0;
}

void OcclusionBuffer::enter(const PixelTriangle& triangle) {
  const Depth depth(triangle, sample_);
  forEachRow(triangle, sample_, width_, rows_, kRoom, [&](int row, int first, int end) {
    enteredRows_ = {std::min(enteredRows_.first, row), std::max(enteredRows_.end, row + 1)};
    firstEnteredColumn_ = std::min(firstEnteredColumn_, first);
    enteredColumnEnd_ = std::max(enteredColumnEnd_, end);
    float* const entered = entered_.data() + startOf(row);
    depth.forEach(row, first, end,
                  [&](int x, float near, float) { entered[x] = std::min(entered[x], near); });
    return true;
  });
}

void OcclusionBuffer::cover(const PixelTriangle& triangle) {
  const Depth depth(triangle, sample_);
  forEachRow(triangle, sample_, width_, rows_, 0, [&](int row, int first, int end) {
    float* const farthest = farthest_.data() + startOf(row);
    const float* const entered = entered_.data() + startOf(row);
    depth.forEach(row, first, end, [&](int x, float, float far) {
      farthest[x] = far < entered[x] ? std::min(farthest[x], far) : farthest[x];
    });
    return true;
  });
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
  const Depth depth(triangle, sample_);
  return forEachRow(triangle, sample_, width_, rows_, kRoom, [&](int row, int first, int end) {
    const float* const farthest = farthest_.data() + startOf(row);
    int seen = 0;
    depth.forEach(row, first, end, [&](int x, float near, float) { seen += !(farthest[x] < near); });
    return seen == 0;
  });
}

}  // namespace luxo
